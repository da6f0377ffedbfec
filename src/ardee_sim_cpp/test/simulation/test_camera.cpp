// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "../temp_folder.h"
#include "ardee_sim/render/lens.h"
#include "cameras.h"

namespace ardee {
using namespace render;
using namespace devices;
namespace {

const Pose kOneMetreUp = Pose::from_xyz_rpy({0, 0, 1}, {0, 0, 0});
constexpr double kBoard_m = 2.0;   // in front of the camera
constexpr double kSquare_m = 0.2;  // one of 8 x 6
constexpr int kColumns = 8, kRows = 6;

/// Returns the white squares of a checkerboard; the background is black.
std::string checkerboard() {
  std::string xml = "<scene><ambient>0 0 0 1</ambient><background>0 0 0 1</background></scene>";
  for (int k = 0; k < kColumns * kRows; ++k) {
    const int column = k % kColumns, row = k / kColumns;
    if ((column + row) % 2 == 0) continue;
    const double y = (kColumns / 2.0 - column - 0.5) * kSquare_m;
    const double z = 1.0 + (kRows / 2.0 - row - 0.5) * kSquare_m;
    xml += glowing_box("square" + std::to_string(k),
                       std::to_string(kBoard_m + 1e-5) + " " + std::to_string(y) + " " +
                           std::to_string(z) + " 0 0 0",
                       "2e-5 0.2 0.2", 1.0);
  }
  return xml;
}

bool is_white(const ImageReading& image, int column, int row) {
  return image.data[static_cast<std::size_t>(row) * image.step +
                    3 * static_cast<std::size_t>(column)] > 127;
}

/// Returns where black meets white about `near` on a line of pixels.
template <typename White>
double edge(int near, const White& white) {
  for (int reach = 0; reach < 4; ++reach) {
    for (const int k : {near + reach, near - 1 - reach}) {
      if (white(k) != white(k + 1)) return k + 0.5;
    }
  }
  return std::nan("");
}

/// Returns the errors [px] of the board's inner corners against their places by camera_info.
std::vector<double> corner_errors(const ImageReading& image, const CameraInfoReading& info) {
  Lens lens;
  lens.fx_px = info.K[0];
  lens.fy_px = info.K[4];
  lens.cx_px = info.K[2];
  lens.cy_px = info.K[5];
  lens.skew_px = info.K[1];
  lens.D = info.D;
  std::vector<double> errors;
  for (int column = 1; column < kColumns; ++column) {
    for (int row = 1; row < kRows; ++row) {
      const Eigen::Vector2d plane((column - kColumns / 2.0) * kSquare_m / kBoard_m,
                                  (row - kRows / 2.0) * kSquare_m / kBoard_m);
      const Eigen::Vector2d at = lens.to_pixel(plane);
      // Pixels that one pixel along the edges moves across them.
      const Eigen::Vector2d down = lens.to_pixel(plane + Eigen::Vector2d(0, 1e-4)) - at;
      const Eigen::Vector2d right = lens.to_pixel(plane + Eigen::Vector2d(1e-4, 0)) - at;
      const int u = static_cast<int>(std::lround(at.x()));
      const int v = static_cast<int>(std::lround(at.y()));
      for (const int aside : {-4, -3, 3, 4}) {
        const double x = at.x() + (v + aside - at.y()) * down.x() / down.y();
        const double y = at.y() + (u + aside - at.x()) * right.y() / right.x();
        errors.push_back(edge(u, [&](int k) { return is_white(image, k, v + aside); }) - x);
        errors.push_back(edge(v, [&](int k) { return is_white(image, u + aside, k); }) - y);
      }
    }
  }
  return errors;
}

/// Checks the corners in the first pictures.
void expect_corners_in_place(const TestWorld& world) {
  const auto images = world.recorder().on<ImageReading>("/cam/image_raw");
  const auto infos = world.recorder().on<CameraInfoReading>("/cam/camera_info");
  ASSERT_EQ(images.size(), 1u);
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(images[0].header.stamp_ns, infos[0].header.stamp_ns);
  const std::vector<double> errors = corner_errors(images[0], infos[0]);
  double sum = 0.0;
  for (const double error : errors) {
    ASSERT_LE(std::abs(error), 0.52);  // a pixel is half white or not; the edge bends a little
    sum += error;
  }
  EXPECT_LT(std::abs(sum / static_cast<double>(errors.size())), 0.2);
}

void expect_corners_in_place(const std::string& camera, const std::string& keys = "") {
  TestWorld world(checkerboard());
  world.spawn(camera_post("camera", camera, keys), "post", kOneMetreUp);
  world.run(0.1);
  expect_corners_in_place(world);
}

/// Returns a <lens> with <intrinsics>.
std::string lens_block(const std::string& intrinsics, const std::string& more = "") {
  return "<lens>" + more + "<intrinsics>" + intrinsics + "</intrinsics></lens>";
}

CameraInfoReading info_of(const std::string& camera, const std::string& keys,
                          std::vector<std::string>* messages = nullptr) {
  TestWorld world("");
  world.spawn(camera_post("camera", camera, keys), "post");
  world.run(0.1);
  if (messages) *messages = world.messages();
  return world.recorder().on<CameraInfoReading>("/cam/camera_info").at(0);
}

TEST(CameraPlugin, SeesACheckerboardWhereCameraInfoSays) {
  expect_corners_in_place(camera_block(640, 480, 1.1));
}

TEST(CameraPlugin, BendsThePictureAsItsDistortionSays) {
  expect_corners_in_place(camera_block(
      640, 480, 1.1,
      "<distortion><k1>-0.25</k1><k2>0.08</k2><p1>0.002</p1><p2>-0.001</p2></distortion>"));
  expect_corners_in_place(camera_block(640, 480, 1.1),
                          "<autoDistortion>true</autoDistortion><distortionK1>0.2</distortionK1>"
                          "<distortionT2>0.003</distortionT2>");
}

TEST(CameraPlugin, TakesThePictureWithTheIntrinsicsOfThePlugin) {
  expect_corners_in_place(camera_block(640, 480, 1.1),
                          "<focalLength>500</focalLength><Cx>330.25</Cx><Cy>228.5</Cy>");
}

TEST(CameraPlugin, TakesThePictureWithTheIntrinsicsOfItsLens) {
  const std::string intrinsics = "<fx>480</fx><fy>505.5</fy><cx>331.25</cx><cy>221</cy><s>30</s>";
  expect_corners_in_place(camera_block(640, 480, 1.1, lens_block(intrinsics)));
  expect_corners_in_place(camera_block(
      640, 480, 1.1,
      lens_block(intrinsics) + "<distortion><k1>-0.2</k1><p1>0.002</p1></distortion>"));
  const auto info = info_of(camera_block(640, 480, 1.1, lens_block(intrinsics)), "");
  EXPECT_EQ(info.K, (std::array<double, 9>{480, 30, 331.25, 0, 505.5, 221, 0, 0, 1}));
  EXPECT_EQ(info.P, (std::array<double, 12>{480, 30, 331.25, 0, 0, 505.5, 221, 0, 0, 0, 1, 0}));
}

TEST(CameraPlugin, WhatIntrinsicsDoNotSayFollowsFromTheFieldOfView) {
  std::vector<std::string> messages;
  const auto info =
      info_of(camera_block(640, 480, M_PI / 2, lens_block("<fx>300</fx>")), "", &messages);
  EXPECT_TRUE(messages.empty());
  EXPECT_EQ(info.K[0], 300.0);
  EXPECT_NEAR(info.K[4], 320.0, 1e-3);
  EXPECT_EQ(info.K[2], 319.5);
  EXPECT_EQ(info.K[5], 239.5);
}

TEST(CameraPlugin, APluginThatContradictsTheLensIsWarned) {
  std::vector<std::string> messages;
  const auto info = info_of(camera_block(640, 480, 1.1, lens_block("<fx>480</fx><fy>480</fy>")),
                            "<focalLength>500</focalLength>", &messages);
  EXPECT_EQ(info.K[0], 480.0);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("other than the <intrinsics>"), std::string::npos) << messages[0];
}

TEST(CameraPlugin, OtherProjectionsAreSaidOnce) {
  std::vector<std::string> messages;
  const auto info =
      info_of(camera_block(640, 480, 1.1,
                           lens_block("<fx>480</fx>",
                                      "<type>custom</type><scale_to_hfov>true</scale_to_hfov>"
                                      "<custom_function><c1>1</c1></custom_function>"
                                      "<projection><p_fx>9</p_fx></projection>")),
              "", &messages);
  EXPECT_EQ(info.K[0], 480.0);
  EXPECT_EQ(info.P[0], 480.0);
  EXPECT_FALSE(std::signbit(info.P[3]));
  ASSERT_EQ(messages.size(), 3u);
  for (const char* part : {"<custom_function>: has no effect", "<projection>: has no effect",
                           "found <type> custom, expected gnomonical"}) {
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
      return message.find(part) != std::string::npos;
    })) << part;
  }
}

TEST(CameraPlugin, ZoomsToTheFieldOfViewThatItIsTold) {
  TestWorld world(checkerboard());
  Entity& post = world.spawn(camera_post("camera",
                                         camera_block(640, 480, 1.5,
                                                      "<distortion><k1>-0.1</k1></distortion>" +
                                                          lens_block("<cx>330</cx>")),
                                         "<horizontalFovMin>0.5</horizontalFovMin>"),
                             "post", kOneMetreUp);
  ASSERT_EQ(post.devices.at(0)->ports().all<Input>().size(), 1u);
  const Input& zoom = post.devices[0]->ports().all<Input>()[0];
  EXPECT_EQ(zoom.topic, "/cam/set_hfov");
  EXPECT_EQ(zoom.low, 0.5);
  EXPECT_GT(zoom.high, 3.0);
  zoom.on_command(0.9);
  world.run(0.1);
  expect_corners_in_place(world);
  const auto info = world.recorder().on<CameraInfoReading>("/cam/camera_info").at(0);
  EXPECT_NEAR(info.K[0], 320.0 / std::tan(0.45), 1e-9);
  EXPECT_NEAR(info.K[4], info.K[0], 1e-9);
  EXPECT_EQ(info.K[2], 330.0);
  EXPECT_EQ(info.P[0], info.K[0]);
  post.devices[0]->reset(world->now_ns());
  world.run(0.1);
  EXPECT_NEAR(world.recorder().on<CameraInfoReading>("/cam/camera_info").at(1).K[0],
              320.0 / std::tan(0.75), 1e-9);
}

TEST(CameraPlugin, TellsItsCalibration) {
  TestWorld world("");
  world.spawn(camera_post("camera", camera_block(640, 480, M_PI / 2),
                          "<hackBaseline>0.07</hackBaseline><distortionK1>0.1</distortionK1>"
                          "<distortionK3>0.3</distortionK3><distortionT1>0.01</distortionT1>"),
              "post");
  world.run(0.1);
  const auto info = world.recorder().on<CameraInfoReading>("/cam/camera_info").at(0);
  const auto near = [](double value, double expected) { return std::abs(value - expected) < 1e-3; };
  EXPECT_EQ(info.header.frame_id, "optical");
  EXPECT_TRUE(near(info.K[0], 320) && near(info.K[4], 320) && info.K[2] == 319.5 &&
              info.K[5] == 239.5 && info.K[8] == 1.0);
  EXPECT_TRUE(near(info.P[0], 320) && near(info.P[5], 320) && info.P[2] == 319.5 &&
              info.P[6] == 239.5 && info.P[10] == 1.0);
  EXPECT_NEAR(info.P[3], -320 * 0.07, 1e-3);
  EXPECT_EQ(info.D, (std::array<double, 5>{0.1, 0, 0.01, 0, 0.3}));
}

TEST(CameraPlugin, AMulticameraHasALeftAndARightEye) {
  TestWorld world("<scene><background>0 0 0 1</background></scene>" +
                  glowing_box("mark", "2.05 0 0 0 0 0", "0.1 0.02 0.04", 1.0));
  const auto eye = [](const std::string& name, const std::string& pose) {
    std::string block = camera_block(320, 240, 1.0, "<pose>" + pose + "</pose>");
    return block.replace(0, 7, "<camera name='" + name + "'");
  };
  Entity& post = world.spawn(
      camera_post("multicamera", eye("left", "0 0.1 0 0 0 0") + eye("right", "0 -0.1 0 0 0 0"),
                  "<hackBaseline>0.2</hackBaseline>", "multicamera"),
      "post");
  ASSERT_EQ(post.devices.size(), 1u);
  world.run(0.1);
  const auto left = world.recorder().on<ImageReading>("/cam/left/image_raw");
  const auto right = world.recorder().on<ImageReading>("/cam/right/image_raw");
  const auto info = world.recorder().on<CameraInfoReading>("/cam/right/camera_info");
  ASSERT_EQ(left.size() + right.size() + info.size(), 3u);
  // Twice the half baseline at 2 m: the mark is f * 0.1 / 2 off the middle, to either side.
  const auto middle = [](const ImageReading& image) {
    double sum = 0.0, count = 0.0;
    for (int k = 0; k < 320; ++k) {
      if (!is_white(image, k, 119)) continue;
      sum += k;
      count += 1.0;
    }
    return sum / count;
  };
  const double f = info[0].K[0];
  EXPECT_NEAR(middle(left[0]), 159.5 + f * 0.1 / 2.0, 0.5);
  EXPECT_NEAR(middle(right[0]), 159.5 - f * 0.1 / 2.0, 0.5);
  EXPECT_NEAR(info[0].P[3], -0.2 * f, 1e-6);
  EXPECT_NEAR(world.recorder().on<CameraInfoReading>("/cam/left/camera_info").at(0).P[3], 0, 0);
}

// "left_front" and "left_rear" are both the left eye to Gazebo, whose topics have no other names.
TEST(CameraPlugin, AMulticameraWithTwoOfOneTopicIsLeftOut) {
  TestWorld world("");
  const std::string eyes = "<camera name='left_front'/><camera name='left_rear'/>";
  EXPECT_TRUE(
      world.spawn(camera_post("multicamera", eyes, "", "multicamera"), "post").devices.empty());
  ASSERT_EQ(world.messages().size(), 1u);
  const std::string said = "found a second camera of topic /cam/left/image_raw, expected names";
  EXPECT_NE(world.messages()[0].find(said), std::string::npos) << world.messages()[0];
}

TEST(CameraPlugin, WhatNobodyWantsIsNotMade) {
  TestWorld world("");
  Entity& post = world.spawn(
      camera_post("camera", camera_block(64, 48, 1.0), "<segmentation>true</segmentation>"),
      "post");
  listen_to(post, {});
  world.run(0.3);
  listen_to(post, {"/cam/camera_info"});
  world.run(0.3);
  EXPECT_EQ(world.recorder().on<CameraInfoReading>("/cam/camera_info").size(), 3u);
  EXPECT_TRUE(world.recorder().on<ImageReading>("/cam/image_raw").empty());
  listen_to(post, {"/cam/segmentation/label"});
  world.run(0.1);
  EXPECT_EQ(world.recorder().on<ImageReading>("/cam/segmentation/label").size(), 1u);
  EXPECT_TRUE(world.recorder().on<ImageReading>("/cam/image_raw").empty());
}

TEST(CameraPlugin, WaitsForItsTrigger) {
  TestWorld world("");
  Entity& post = world.spawn(
      camera_post("camera", camera_block(8, 8, 1.0), "<triggered>true</triggered>"), "post");
  ASSERT_EQ(post.devices.at(0)->ports().all<Input>().size(), 2u);  // zoom, trigger
  EXPECT_EQ(post.devices[0]->ports().all<Input>().back().get().topic, "/cam/image_trigger");
  world.run(0.5);
  EXPECT_TRUE(world.recorder().on<ImageReading>("/cam/image_raw").empty());
  post.devices[0]->ports().all<Input>().back().get().on_command(Trigger{});
  world.run(0.5);
  EXPECT_EQ(world.recorder().on<ImageReading>("/cam/image_raw").size(), 1u);
}

TEST(CameraPlugin, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto picture = [](int threads) {
    SimulationOptions options;
    options.rays.threads = threads;
    TestWorld world(checkerboard() + room(), 0.001, options);
    world.spawn(camera_post("camera",
                            camera_block(100, 70, 1.3,
                                         "<noise><type>gaussian</type><stddev>0.05</stddev></noise>"
                                         "<distortion><k1>-0.2</k1></distortion>")),
                "post", kOneMetreUp);
    world.run(0.2);
    return world.recorder().on<ImageReading>("/cam/image_raw").at(1).data;
  };
  const auto one = picture(1);
  EXPECT_EQ(one, picture(2));
  EXPECT_EQ(one, picture(5));
}

TEST(CameraPlugin, SegmentationNamesWhatIsSeen) {
  const TempFolder folder;
  folder.write_model(
      "wall",
      "<static>true</static><link name='l'><visual name='v'><geometry><box><size>1 4 "
      "9</size></box></geometry></visual></link>");
  const std::string plain = static_box("ignored", "3.5 -9 0 0 0 0", "1 4 9");
  TestWorld world(plain + "<include><uri>file://" + folder.path() +
                  "/wall</uri><pose>3.5 2 0 0 0 0</pose><ardee:label>7</ardee:label></include>");
  world.spawn(camera_post("camera", camera_block(65, 49, 1.0), "<segmentation>true</segmentation>"),
              "post");
  world.run(0.1);
  const auto image = world.recorder().on<ImageReading>("/cam/segmentation/instance").at(0);
  EXPECT_EQ(image.encoding, "32SC1");
  const auto id = [&](std::size_t column) {
    return value_at<std::int32_t>(image.data, 24 * image.step + 4 * column);
  };
  EXPECT_EQ(id(60), 0);  // y < 0: nothing
  EXPECT_EQ(id(4), static_cast<int>(world->find("wall")->robot->entity()) + 1);
  const auto labels = world.recorder().on<ImageReading>("/cam/segmentation/label").at(0);
  EXPECT_EQ(labels.encoding, "16UC1");
  const auto label = [&](std::size_t column) {
    return value_at<std::uint16_t>(labels.data, 24 * labels.step + 2 * column);
  };
  EXPECT_EQ(label(60), 0);
  EXPECT_EQ(label(4), 7);
}

class BadCamera : public testing::TestWithParam<std::array<const char*, 3>> {};

TEST_P(BadCamera, IsLeftOutWithOneMessage) {
  const auto [block, keys, expected] = GetParam();
  TestWorld world("");
  const std::string camera = "<camera>" + std::string(block) + "</camera>";
  Entity& post = world.spawn(camera_post("openni_kinect", camera, keys), "post");
  EXPECT_TRUE(post.devices.empty());
  ASSERT_EQ(world.messages().size(), 1u);
  EXPECT_NE(world.messages()[0].find(expected), std::string::npos) << world.messages()[0];
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCamera,
    testing::Values(
        std::array<const char*, 3>{"<image><width>8000</width><height>8000</height></image>", "",
                                   "found 8000 x 8000 pixels, expected at most 16777216"},
        std::array<const char*, 3>{"<image><width>0</width><height>4</height></image>", "",
                                   "found 0, expected a number in [1, 8192]"},
        std::array<const char*, 3>{"<horizontal_fov>3.2</horizontal_fov>", "", "less than pi"},
        std::array<const char*, 3>{"<horizontal_fov>0</horizontal_fov>", "", "more than 0"},
        std::array<const char*, 3>{"<clip><near>2</near><far>1</far></clip>", "",
                                   "expected more than <near>"},
        std::array<const char*, 3>{"<noise><type>gaussian</type><stddev>-1</stddev></noise>", "",
                                   "found -1"},
        std::array<const char*, 3>{"<image><width>4</width><height>4</height><format>R3</format>"
                                   "</image>",
                                   "", "found format 'R3', expected one of: "},
        std::array<const char*, 3>{"<lens><intrinsics><fx>0</fx></intrinsics></lens>", "",
                                   "found 0, expected a number in [0.001"},
        std::array<const char*, 3>{
            "", "<horizontalFovMin>1</horizontalFovMin><horizontalFovMax>0.9</horizontalFovMax>",
            "expected at least <horizontalFovMin>"},
        std::array<const char*, 3>{"", "<whiteBalance>3000</whiteBalance>",
                                   "expected off, auto, a colour temperature of 4000"},
        std::array<const char*, 3>{"", "<exposureTime>2</exposureTime>", "found 2, expected"},
        std::array<const char*, 3>{"", "<readoutTime>-1</readoutTime>", "found -1, expected"},
        std::array<const char*, 3>{"", "<depthNoiseLinear>-0.1</depthNoiseLinear>", "found -0.1"},
        std::array<const char*, 3>{"", "<pointCloudCutoffMax>0.1</pointCloudCutoffMax>",
                                   "expected more than <pointCloudCutoff>"},
        std::array<const char*, 3>{"<horizontal_fov>wide</horizontal_fov>", "", "found 'wide'"}));

}  // namespace
}  // namespace ardee
