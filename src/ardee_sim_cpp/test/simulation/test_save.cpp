// SPDX-License-Identifier: MIT
// A simulation goes on from a saved state with the same bytes.
#include <gtest/gtest.h>

#include "all_devices.h"
#include "ardee_sim/controllers/ros_control.h"
#include "reading_bytes.h"

namespace ardee {
using namespace devices;
namespace {

const Pose kOnWheels = Pose::from_xyz_rpy({0, 0, 0.151}, {0, 0, 0});
const std::string kScene = ground_plane() + static_box("wall", "3 0 1 0 0 0", "0.2 4 2");

/// All that is measured in `duration_s`, and where all links of models are in the end.
std::map<std::string, std::string> run(TestWorld& world, double duration_s) {
  BytesByTopic sink;
  world->set_sink(&sink);
  world.run(duration_s);
  auto all = sink.take();
  for (const auto& entity : world->entities()) {
    StateArchive archive;
    for (std::size_t link = 0; link < entity->instance.model->links.size(); ++link) {
      Pose X_WL = entity->robot->link_pose(link);
      archive(X_WL);
    }
    all[entity->name()] = archive.bytes();
  }
  return all;
}

void expect_equal(const std::map<std::string, std::string>& first,
                  const std::map<std::string, std::string>& again, const std::string& what) {
  EXPECT_EQ(first.size(), again.size()) << what;
  for (const std::string& topic : differing(first, again)) {
    ADD_FAILURE() << what << ": other bytes on " << topic;
  }
}

/// Has the simulation repeat what follows now: after a detour, after the loss of `robot`, and in
/// `other`, a second simulation of the same world.
void expect_goes_on(TestWorld& world, double duration_s, const std::string& robot,
                    TestWorld& other) {
  const SimulationState state = world->save();
  const auto first = run(world, duration_s);
  run(world, 0.3);
  world->restore(state);
  EXPECT_EQ(world->now_ns(), state.now_ns);
  expect_equal(first, run(world, duration_s), "after a detour");
  world->remove(robot);
  run(world, 0.1);
  world->restore(state);
  expect_equal(first, run(world, duration_s), "after a loss");
  run(other, 0.1);
  other->restore(state);
  expect_equal(first, run(other, duration_s), "in another simulation");
}

TEST(Save, GoesOnWithTheBytesOfEachDevice) {
  TestWorld world(kScene, 0.005), other(kScene, 0.005);
  Entity& robot = world.spawn(rover_with(all_devices()), "rover", kOnWheels);
  world.run(0.203);
  command_all(robot);
  world.run(0.304);
  expect_goes_on(world, 0.6, "rover", other);
}

TEST(Save, HoldsWhatWasTuned) {
  TestWorld world(kScene, 0.005), other(kScene, 0.005);
  Entity& robot = world.spawn(rover_with(all_devices()), "rover", kOnWheels);
  for (const auto& device : robot.devices) {
    for (const ParameterGroup& tuning : device->ports().all<ParameterGroup>()) {
      for (const TunableParameter& each : tuning.parameters) {
        each.set(each.get() == each.high ? each.low : each.high);
      }
    }
  }
  world.run(0.1);
  expect_goes_on(world, 0.5, "rover", other);
}

std::string heap() {
  std::string models = ground_plane();
  const std::vector<std::string> shapes = {
      "<box><size>0.2 0.3 0.1</size></box>", "<sphere><radius>0.15</radius></sphere>",
      "<cylinder><radius>0.1</radius><length>0.3</length></cylinder>"};
  for (int k = 0; k < 12; ++k) {
    models += "<model name='m" + std::to_string(k) + "'><pose>" + std::to_string(0.05 * k) + " 0 " +
              std::to_string(0.3 + 0.3 * k) +
              " 0.3 0.2 0.1</pose><link name='link'><inertial><mass>1</mass><inertia>"
              "<ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision "
              "name='c'><geometry>" +
              shapes[static_cast<std::size_t>(k) % 3] + "</geometry></collision></link></model>";
  }
  return models;
}

TEST(Save, GoesOnWithAHeapThatFallsAndWithOneAtRest) {
  for (const double until_s : {0.5, 1.5, 6.0}) {
    TestWorld world(heap(), 0.002), other(heap(), 0.002);
    world.run(until_s);
    expect_goes_on(world, 1.0, "m4", other);
  }
}

TEST(Save, HoldsPropertiesCommandsLightsAndPlaces) {
  const std::string scene = kScene + heap();
  TestWorld world(scene, 0.002), other(scene, 0.002);
  Entity& box = *world->find("m0");
  LinkProperties heavy = box.robot->dynamics().link_properties(0);
  heavy.inertial->mass_kg = 3.0;
  box.robot->dynamics().set_link_properties(0, heavy);
  PhysicsParams physics = world->physics();
  physics.gravity_m_per_s2 = {0, 0, -3.7};
  world->set_physics(physics);
  Light light;
  light.name = "lamp";
  world->add_light(light);
  world->set_state("wall", {Pose::from_xyz_rpy({0.5, 0.5, 1}, {0, 0, 0.4}), {}}, "");
  Wrench wrench;
  wrench.robot = world->find("m3")->robot.get();
  wrench.force_W = {4, 1, 0};
  wrench.duration_ns = nanoseconds(0.8);
  world->wrenches().add(wrench);
  world.run(0.4);
  const SimulationState state = world->save();
  expect_goes_on(world, 1.0, "m3", other);
  world->set_physics({});
  world->remove_light("lamp");
  world->set_state("wall", {}, "");
  world->restore(state);
  EXPECT_EQ(world->physics().gravity_m_per_s2.z(), -3.7);
  EXPECT_EQ(world->lights().back().name, "lamp");
  EXPECT_EQ(world->find("wall")->robot->pose().p.x(), 0.5);
  EXPECT_EQ(world->find("m0")->robot->dynamics().link_properties(0).inertial->mass_kg, 3.0);
}

TEST(Save, RemovesLaterModelsAndBringsTheLatestReadingsBack) {
  TestWorld world(kScene, 0.005);
  Entity& robot = world.spawn(rover_with(all_devices()), "rover", kOnWheels);
  const auto port = world->reading_port<OdometryReading>("odom");
  command_all(robot);
  world.run(0.5);
  const double x_m = world->latest(port)->pose.p.x();
  const SimulationState state = world->save();
  world.spawn(rover_with({}), "later", Pose::from_xyz_rpy({0, 3, 0.151}, {0, 0, 0}));
  world.run(0.5);
  EXPECT_NE(world->latest(port)->pose.p.x(), x_m);
  world->restore(state);
  EXPECT_EQ(world->find("later"), nullptr);
  EXPECT_EQ(world->latest(port)->pose.p.x(), x_m);
  world.spawn(rover_with({}), "later", Pose::from_xyz_rpy({0, 3, 0.151}, {0, 0, 0}));
}

TEST(Save, OfTheFirstStateIsWhatAResetGives) {
  TestWorld world(kScene, 0.005);
  Entity& robot = world.spawn(rover_with(all_devices()), "rover", kOnWheels);
  const SimulationState state = world->save();
  const auto drive = [&] {
    command_all(*world->find("rover"));
    return run(world, 0.5);
  };
  EXPECT_EQ(&robot, world->find("rover"));
  const auto first = drive();
  world->reset_simulation();
  expect_equal(first, drive(), "after a reset");
  world->restore(state);
  expect_equal(first, drive(), "restored");
}

TEST(Save, HoldsWhichControllersAreLoadedAndRun) {
  const Setting::Map effort{
      {"type", Setting("/a/type", "effort_controllers/JointEffortController")},
      {"joint", Setting("/a/joint", "flag_joint")}};
  SimulationOptions options;
  options.parameter = [&](const std::string& name) {
    return name == "/a" || name == "/b" ? Setting(name, effort) : no_parameter(name);
  };
  TestWorld world(kScene, 0.005, options), other(kScene, 0.005, options);
  Entity& robot = world.spawn(rover_with(drive_devices()), "rover", kOnWheels);
  const auto manager = [](Entity& of) -> control::Manager& {
    for (const auto& device : of.devices) {
      if (auto* found = dynamic_cast<control::RosControl*>(device.get())) return found->manager();
    }
    throw Error("no controllers");
  };
  manager(robot).load("b");
  manager(robot).load("a");
  manager(robot).switch_controllers({{"a"}, {}});
  manager(robot).find("a")->ports().all<Input>().at(0).get().on_command(0.002);
  world.run(0.1);
  const SimulationState state = world->save();
  expect_goes_on(world, 0.5, "rover", other);
  manager(*world->find("rover")).unload_all();
  world->restore(state);
  const auto list = manager(*world->find("rover")).list();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].name + list[0].state, "binitialized");
  EXPECT_EQ(list[1].name + list[1].state, "arunning");
}

TEST(Save, OfAnotherWorldIsRefused) {
  TestWorld world(kScene, 0.005);
  world.spawn(rover_with(drive_devices()), "rover", kOnWheels);
  const SimulationState state = world->save();
  const auto expect_refused = [&](const std::function<void(SimulationState&)>& change) {
    SimulationState changed = state;
    change(changed);
    EXPECT_THROW(world->restore(changed), Error);
  };
  expect_refused([](SimulationState& other) { other.entities.back().devices.resize(3); });
  expect_refused([](SimulationState& other) { other.entities.back().devices += "more"; });
  expect_refused([](SimulationState& other) { other.dynamics.resize(30); });
  expect_refused([](SimulationState& other) { other.dynamics += "more"; });
  expect_refused([](SimulationState& other) { other.commands[0] = 1; });
  world->restore(state);
  EXPECT_EQ(world->save().dynamics, state.dynamics);
}

TEST(Simulations, ShareAWorld) {
  Loader loader(ResourceLocator::from_environment(), Log(nullptr));
  const auto world = std::make_shared<const World>(loader.load_world_text(
      "<sdf version='1.6'><world name='w'>" + heap() + "</world></sdf>", "w.world"));
  Simulation one(world, {}, nullptr), two(world, {}, nullptr);
  EXPECT_EQ(&one.world(), &two.world());
  for (int i = 0; i < 500; ++i) {
    one.step();
    if (i % 2 == 0) two.step();
  }
  for (int i = 0; i < 250; ++i) two.step();
  EXPECT_EQ(one.save().dynamics, two.save().dynamics);
}

}  // namespace
}  // namespace ardee
