// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "cameras.h"

namespace ardee {
using namespace devices;
namespace {

/// Returns a white board in front of a camera, with a ball that casts its shadow on it; `lights`
/// are the only lights.
std::string stage(const std::string& lights) {
  return "<scene><ambient>0 0 0 1</ambient><background>0 0 0 1</background></scene>" + lights +
         "<model name='board'><static>true</static><pose>2 0 0 0 0 0</pose><link name='l'>"
         "<visual name='board'><geometry><box><size>0.1 4 4</size></box></geometry><material>"
         "<diffuse>1 1 1 1</diffuse></material></visual><visual name='ball'><pose>-0.5 0 0 0 0 0"
         "</pose><geometry><sphere><radius>0.2</radius></sphere></geometry></visual></link>"
         "</model>";
}

/// Returns a light from behind the camera, a little from above.
std::string lamp(const std::string& diffuse, const std::string& direction = "1 0 -0.2") {
  return "<light name='sun' type='directional'><cast_shadows>true</cast_shadows><diffuse>" +
         diffuse + " 1</diffuse><direction>" + direction + "</direction></light>";
}

std::vector<std::uint8_t> next_picture(TestWorld& world) {
  world.recorder().clear();
  world.run(0.1);
  return world.recorder().on<ImageReading>("/cam/image_raw").at(0).data;
}

/// World with its camera, which has taken a picture already.
class Studio {
 public:
  explicit Studio(const std::string& lights) : world_(stage(lights)) {
    Entity& post = world_.spawn(camera_post("camera", camera_block(64, 48, 1.0)), "post");
    listen_to(post, {"/cam/image_raw"});
    before_ = next_picture(world_);
  }
  TestWorld& world() { return world_; }
  const std::vector<std::uint8_t>& before() const { return before_; }

 private:
  TestWorld world_;
  std::vector<std::uint8_t> before_;
};

TEST(Lights, ThatChangeAreThoseOfAWorldThatWasWrittenSo) {
  Studio changed(lamp("1 1 1"));
  Light light = changed.world()->lights().at(0);
  light.diffuse = Color(1.0f, 0.0f, 0.0f, 1.0f);
  light.direction = Eigen::Vector3d(1, 0.3, -0.2).normalized();
  changed.world()->set_light(light);
  const auto after = next_picture(changed.world());
  EXPECT_NE(after, changed.before());
  EXPECT_EQ(after, Studio(lamp("1 0 0", "1 0.3 -0.2")).before());
  std::size_t red = 0;
  for (std::size_t pixel = 0; pixel < after.size(); pixel += 3) {
    red += after[pixel] > 100 && after[pixel + 1] == 0 && after[pixel + 2] == 0;
  }
  EXPECT_GT(red, 1000u) << "of 3072";
}

TEST(Lights, ThatAreTakenAwayLeaveTheRest) {
  Studio changed(lamp("1 1 1"));
  changed.world()->remove_light("sun");
  EXPECT_TRUE(changed.world()->lights().empty());
  EXPECT_EQ(next_picture(changed.world()), Studio("").before());
}

TEST(Lights, StayAsTheyWereSetWhenTheWorldIsReset) {
  Studio studio(lamp("1 1 1"));
  Light light = studio.world()->lights().at(0);
  light.diffuse = Color(0.0f, 0.0f, 1.0f, 1.0f);
  studio.world()->set_light(light);
  const auto blue = next_picture(studio.world());
  studio.world()->reset_simulation();
  EXPECT_EQ(next_picture(studio.world()), blue);
}

TEST(Lights, OfUnknownNamesAreRefused) {
  Studio studio(lamp("1 1 1"));
  Light moon;
  moon.name = "moon";
  EXPECT_THROW(studio.world()->set_light(moon), Error);
  EXPECT_THROW(studio.world()->remove_light("moon"), Error);
  EXPECT_EQ(next_picture(studio.world()), studio.before());
}

TEST(Lights, ThatAreAddedAreThoseOfAWorldThatWasWrittenSo) {
  Studio lit(lamp("1 0 0"));
  Light light = lit.world()->lights().at(0);
  EXPECT_THROW(lit.world()->add_light(light), Error);
  Studio dark("");
  dark.world()->add_light(light);
  EXPECT_EQ(next_picture(dark.world()), lit.before());
  dark.world()->reset_simulation();
  EXPECT_EQ(next_picture(dark.world()), lit.before());
  light.name = "lost";
  light.pose.p.x() = NAN;
  EXPECT_THROW(dark.world()->add_light(light), Error);
  EXPECT_EQ(dark.world()->lights().size(), 1u);
}

}  // namespace
}  // namespace ardee
