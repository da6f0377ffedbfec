// SPDX-License-Identifier: MIT
// Tests that each element of SDF that is listed as acting does act: a world behaves differently
// with another value.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "../readers/specification.h"
#include "../test_data.h"
#include "cameras.h"
#include "effects.h"
#include "reading_bytes.h"

namespace ardee {
using namespace devices;
namespace {

/// Elements with a test of their own, by a closed form or a file.
struct OtherTest {
  const char* element;
  const char* file;
  const char* test;
};
constexpr OtherTest kTestedElsewhere[] = {
    {"include/static", "readers/test_sdf_include.cpp", "TakesPoseNameAndStatic"},
    {"include/pose", "readers/test_sdf_include.cpp", "TakesPoseNameAndStatic"},
    {"include/@merge", "readers/test_sdf_include.cpp", "AMergedIncludeKeepsItsNames"},
    {"gui/camera/pose", "readers/test_sdf_world.cpp", "ReadsListingA15sSettings"},
    {"limit/effort", "physics/test_joints.cpp", "EffortOfTheDescriptionBoundsAppliedEfforts"},
    {"limit/velocity", "physics/test_joints.cpp", "BeyondTheLimitOfVelocity"},
    {"joint/physics/provide_feedback", "simulation/test_force_torque.cpp",
     "OfAnOffsetMassHasTheMomentOfItsArm"},
    {"joint/physics/ode/provide_feedback", "simulation/test_force_torque.cpp",
     "OfAnOffsetMassHasTheMomentOfItsArm"},
    {"distortion/center", "simulation/test_effects.cpp", "TheMiddleOfADistortionIsThePictures"},
};

std::string filled(const Effect& effect, const std::string& value) {
  const std::string name = effect.element.substr(effect.element.rfind('/') + 1);
  const std::string text = name[0] == '@' ? name.substr(1) + "='" + value + "'"
                                          : "<" + name + ">" + value + "</" + name + ">";
  std::string world = effect.world;
  for (std::size_t at = world.find("{}"); at != std::string::npos; at = world.find("{}", at)) {
    world.replace(at, 2, text);
    at += text.size();
  }
  return world;
}

/// Results of a while of a world: the clock, poses and velocities of links, readings.
class Course {
 public:
  explicit Course(const std::string& world) {
    const LogSink sink = [this](LogLevel level, const std::string& text) {
      if (level != LogLevel::kInfo) said_ += text + "\n";
    };
    Loader loader(ResourceLocator{}, Log(sink));
    Simulation simulation(
        loader.load_world_text("<sdf version='1.7'><world name='w'>" + world + "</world></sdf>",
                               "effect.world"),
        {}, sink);
    BytesByTopic readings;
    simulation.set_sink(&readings);
    for (int step = 0; step < 100; ++step) simulation.step();
    put(simulation.physics().real_time_update_rate_hz);
    put(static_cast<double>(simulation.now_ns()));
    for (const auto& entity : simulation.entities()) {
      const Robot& robot = *entity->robot;
      for (std::size_t link = 0; link < robot.model().links.size(); ++link) put(robot, link);
    }
    for (const auto& [topic, bytes] : readings.take()) bytes_ += topic + bytes;
  }

  const std::string& bytes() const { return bytes_; }
  /// Warnings and errors.
  const std::string& said() const { return said_; }

 private:
  void put(double number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof(number)); }
  void put(const Robot& robot, std::size_t link) {
    const Pose pose = robot.link_pose(link);
    const Twist twist = robot.link_twist(link);
    for (int i = 0; i < 3; ++i) put(pose.p[i]), put(twist.linear[i]), put(twist.angular[i]);
    for (int i = 0; i < 4; ++i) put(pose.q.coeffs()[i]);
  }

  std::string bytes_;
  std::string said_;
};

TEST(Effects, EachElementThatActsMakesADifference) {
  for (const Effect& effect : effects()) {
    SCOPED_TRACE(effect.element);
    try {
      const Course one(filled(effect, effect.one));
      const Course other(filled(effect, effect.other));
      EXPECT_TRUE(one.bytes() != other.bytes())
          << effect.one << " does what " << effect.other << " does";
      EXPECT_EQ(one.said() + other.said(), "");
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(Effects, EachNumberOfTheSpecificationThatActsIsTested) {
  std::set<std::string> tested;
  for (const Effect& effect : effects()) tested.insert(effect.element);
  for (const auto& [element, file, test] : kTestedElsewhere) {
    std::ifstream source(test_data("../") + file);
    std::ostringstream text;
    text << source.rdbuf();
    EXPECT_NE(text.str().find(test), std::string::npos) << file << " has no test " << test;
    tested.insert(element);
  }
  for (const std::string& version : SpecificationWalk::versions()) {
    const SpecificationWalk walk(version);
    for (const std::string& element : walk.acting_numbers()) {
      EXPECT_TRUE(tested.count(element))
          << element << " of SDF " << version << " acts, as the table says, and no test shows it";
    }
  }
}

TEST(Effects, TheMiddleOfADistortionIsThePictures) {
  for (const auto& [center, devices] : {std::pair("0.5 0.5", 1u), std::pair("0.4 0.5", 0u)}) {
    TestWorld world("");
    const std::string distortion =
        "<distortion><k1>-0.1</k1><center>" + std::string(center) + "</center></distortion>";
    const Entity& post =
        world.spawn(camera_post("camera", camera_block(64, 48, 1.1, distortion)), "post");
    EXPECT_EQ(post.devices.size(), devices) << center;
  }
}

}  // namespace
}  // namespace ardee
