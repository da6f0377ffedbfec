// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/devices/camera_formats.h"
#include "ardee_sim/devices/ray_block.h"
#include "ardee_sim/devices/ray_sensor.h"
#include "ardee_sim/readers/loader.h"

namespace ardee {
using namespace render;
using namespace devices;
namespace {

class RayBlockTest : public testing::Test {
 protected:
  /// Returns the first sensor of a model.
  SensorDescription sensor(const std::string& body) {
    Loader loader(ResourceLocator{}, log_);
    const auto model = loader.load_model_text(
        "<sdf version='1.6'><model name='m'><link name='l'><sensor name='s' type='ray'>" + body +
            "<plugin name='p' filename='libgazebo_ros_laser.so'/></sensor></link></model></sdf>",
        "test.sdf");
    return model->links.at(0).sensors.at(0);
  }
  RayBlock block(const std::string& horizontal, const std::string& vertical = "") {
    return read_ray_block(
        sensor("<ray><scan><horizontal>" + horizontal +
               "<min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>" + vertical +
               "</scan><range><min>0.1</min><max>10</max></range></ray>"),
        log_);
  }
  std::string error_of(const std::string& horizontal, const std::string& vertical = "") {
    try {
      block(horizontal, vertical);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::string said_;
  Log log_{[this](LogLevel, const std::string& text) { said_ += text + "\n"; }};
};

TEST_F(RayBlockTest, CutsSamplesToAWholeNumberAndSaysSo) {
  EXPECT_EQ(block("<samples>640.0</samples>").columns, 640);
  EXPECT_EQ(said_, "");
  EXPECT_EQ(block("<samples>719.5</samples>").columns, 719);
  EXPECT_NE(said_.find("<samples>: found '719.5', expected a whole number: it is cut to 719"),
            std::string::npos)
      << said_;
  EXPECT_NE(error_of("<samples>0.9</samples>"), "");
  EXPECT_NE(error_of("<samples>-3</samples>"), "");
}

TEST_F(RayBlockTest, TakesTwoMillionRaysButNotAnyNumber) {
  const std::string rows =
      "<samples>1000</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>";
  EXPECT_EQ(block("<samples>2000</samples>", "<vertical>" + rows + "</vertical>").rays(), 2000000u);
  EXPECT_NE(error_of("<samples>5000</samples>", "<vertical>" + rows + "</vertical>")
                .find("found 5000 x 1000 rays, expected up to 4194304"),
            std::string::npos);
  EXPECT_NE(error_of("<samples>100000</samples><resolution>100</resolution>")
                .find("expected up to 4194304 rays"),
            std::string::npos);
}

TEST_F(RayBlockTest, AnEmptyRateIsNoLimit) {
  const auto rate_hz = [&](const std::string& of_sensor, const std::string& of_plugin) {
    const SensorDescription made =
        sensor(of_sensor + "<plugin name='p' filename='f'>" + of_plugin + "</plugin>");
    Parameters keys(made.plugins.at(0).element);
    return read_rate_hz(made, keys, 10.0);
  };
  EXPECT_EQ(rate_hz("<update_rate/>", "<updateRate/>"), 0.0);
  EXPECT_EQ(rate_hz("<update_rate/>", "<updateRate>5</updateRate>"), 5.0);
  EXPECT_EQ(rate_hz("<update_rate>20</update_rate>", "<updateRate></updateRate>"), 20.0);
  EXPECT_EQ(rate_hz("", ""), 10.0);
}

TEST_F(RayBlockTest, FormatsOfPicturesHaveManyNames) {
  for (const char* name : {"R8G8B8", "RGB_INT8", "RGB8", "rgb8"}) {
    EXPECT_EQ(read_pixel_format(name, {}, log_), PixelFormat::kRgb8) << name;
  }
  for (const char* name : {"B8G8R8", "BGR_INT8", "BGR8", "bgr8"}) {
    EXPECT_EQ(read_pixel_format(name, {}, log_), PixelFormat::kBgr8) << name;
  }
  for (const char* name : {"L8", "L_INT8", "mono8"}) {
    EXPECT_EQ(read_pixel_format(name, {}, log_), PixelFormat::kMono8) << name;
  }
  for (const char* name : {"L16", "L_INT16", "L_UINT16", "mono16"}) {
    EXPECT_EQ(read_pixel_format(name, {}, log_), PixelFormat::kMono16) << name;
  }
  EXPECT_EQ(said_, "");
  EXPECT_EQ(read_pixel_format("RGBA_INT8", Source{"f", 3, "format"}, log_), PixelFormat::kRgb8);
  EXPECT_NE(said_.find("f:3: <format>: found format 'RGBA_INT8', expected one of: "),
            std::string::npos)
      << said_;
  EXPECT_THROW(read_pixel_format("R3", {}, log_), Error);
}

}  // namespace
}  // namespace ardee
