// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "cameras.h"

namespace ardee {
using namespace devices;
namespace {

// A camera 0.5 m to the left of a body that turns and drives: it sees a thin mark at its side lean.
TEST(CameraPlugin, ItsShutterSeesTheMotionOfItsBody) {
  const auto lean_px = [](const std::string& keys) {
    TestWorld world("<gravity>0 0 0</gravity><scene><background>0 0 0 1</background></scene>" +
                    glowing_box("mark", "2.005 0.5 0 0 0 0", "0.01 0.02 9", 1.0));
    std::string post = camera_post(
        "camera", camera_block(320, 240, 1.0, "<pose>0 0.5 0 0 0 0</pose>"), keys, "camera", 100.0);
    post.erase(post.find("<static>"), std::string("<static>true</static>").size());
    const std::size_t link =
        post.find("<link name='mast'>") + std::string("<link name='mast'>").size();
    post.insert(link,
                "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz>"
                "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>");
    world.spawn(post, "post");
    world->set_state("post", {Pose{}, {{0, 0.3, 0}, {0, 0, 0.2}}}, "world");
    world.run(0.011);
    const auto image = world.recorder().on<ImageReading>("/cam/image_raw").at(0);
    const auto middle = [&](int row) {
      double sum = 0.0, bright = 0.0;
      for (int x = 0; x < 320; ++x) {
        const double value = image.data[static_cast<std::size_t>(row) * image.step + 3 * x];
        sum += x * value;
        bright += value;
      }
      return sum / bright;
    };
    return middle(238) - middle(2);
  };
  EXPECT_NEAR(lean_px(""), 0.0, 0.1);
  const double focal_px = 160.0 / std::tan(0.5);
  const double moved_px = focal_px * (0.3 / 2.0 + std::tan(0.2 * 0.1) / 0.1) * 0.1 * 236 / 240;
  EXPECT_NEAR(lean_px("<readoutTime>0.1</readoutTime>"), moved_px, 1.0);
  EXPECT_NEAR(lean_px("<readoutTime>0.1</readoutTime><exposureTime>0.05</exposureTime>"), moved_px,
              1.0);
}

}  // namespace
}  // namespace ardee
