// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "ardee_sim/core/error.h"
#include "joints.h"
#include "rover.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::vector<Placement> plants(int rows, int columns) {
  const auto stalk = static_model(Cylinder{0.012, 1.8});
  std::vector<Placement> result;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 0.15 * (column - columns / 2), y = 0.76 * (row - rows / 2 + 0.5);
      result.push_back(placement(stalk, at(x, y, 0.9), 1.0 + 0.001 * (column % 7)));
    }
  }
  return result;
}

void hash_in(std::uint64_t& hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * 0x100000001B3ULL;
}

std::uint64_t drive_hash(PhysicsParams::Solver solver, bool with_company) {
  PhysicsParams wanted = params(0.002);
  wanted.solver = solver;
  PhysicsWorld world(wanted, silent());
  PhysicsWorld other(wanted, silent());
  if (with_company) {
    add_ground(other);
    for (int i = 0; i < 9; ++i)
      other.add_model(box_model(1, {1, 1, 0.1}), at(0, 0, 0.1 + 0.11 * i));
  }
  const auto grid =
      height_grid(65, 20.0, [](double x, double y) { return 0.03 * std::sin(2 * x + y); });
  world.add_scenery({placement(static_model(heightmap(grid)))});
  world.add_scenery(plants(4, 60));
  world.reset_random(7);
  const RoverShape shape;
  PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.2));
  // The pile is too large for the direct solver.
  for (int i = 0; i < 16; ++i) {
    world.add_model(box_model(1, {0.3, 0.2, 0.1}), at(1 + 0.01 * (i % 3), 0, 0.2 + 0.11 * i));
  }
  drive(rover, shape, 4.0, 5.0);
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  int iterated = 0;
  for (int i = 0; i < 600; ++i) {
    world.step();
    if (with_company) other.step();
    iterated += world.stats().solved_directly ? 0 : 1;
    for (const double value : rover.pose().p) hash_in(hash, value);
    for (const double value : rover.link_twist(3).angular) hash_in(hash, value);
  }
  if (solver == PhysicsParams::Solver::kQuick) {
    EXPECT_GT(iterated, 100);
  }
  return hash;
}

TEST(PhysicsWorld, SameInputsGiveTheSameBytes) {
  for (const auto solver : {PhysicsParams::Solver::kQuick, PhysicsParams::Solver::kWorld}) {
    const std::uint64_t hash = drive_hash(solver, false);
    EXPECT_EQ(drive_hash(solver, false), hash);
    EXPECT_EQ(drive_hash(solver, true), hash) << "two worlds in a process do not touch each other";
  }
}

TEST(PhysicsWorld, CostOfAStepDoesNotDependOnTheSizeOfTheField) {
  std::size_t tested[2], built[2];
  const int columns[2] = {50, 5000};
  for (int i = 0; i < 2; ++i) {
    PhysicsWorld world(params(0.001), silent());
    add_ground(world);
    world.add_scenery(plants(10, columns[i]));
    const RoverShape shape;
    PhysicsModel& rover = world.add_model(rover_model(shape), at(0, 0, 0.1));
    drive(rover, shape, 5.0, 5.0);
    run(world, 0.5);
    tested[i] = world.stats().scenery_tested;
    built[i] = world.stats().scenery_built;
  }
  EXPECT_EQ(tested[0], tested[1]);
  EXPECT_EQ(built[0], built[1]);
  EXPECT_GT(tested[0], 0u);
  EXPECT_LT(tested[0], 100u);
}

TEST(PhysicsWorld, RemovedSceneryAndModelsLeaveNothing) {
  PhysicsWorld world(params(0.001), silent());
  const auto box = static_model(Box{{2, 2, 0.2}});
  const auto floor = world.add_scenery({placement(box)});
  add_ground(world);
  PhysicsModel& lower = world.add_model(box_model(1, {0.2, 0.2, 0.2}), at(0, 0, 0.2));
  PhysicsModel& upper = world.add_model(box_model(1, {0.2, 0.2, 0.2}), at(0, 0, 0.4));
  run(world, 0.4);  // too short a time to fall asleep
  EXPECT_NEAR(upper.pose().p.z(), 0.4, 3e-3);
  EXPECT_EQ(world.stats().contacts, 8u);
  world.remove_model(lower);
  run(world, 0.4);
  EXPECT_NEAR(upper.pose().p.z(), 0.2, 3e-3) << "it fell on the floor";
  EXPECT_EQ(world.stats().contacts, 4u);
  world.remove_scenery(floor);
  run(world, 1.0);
  EXPECT_NEAR(upper.pose().p.z(), 0.1, 3e-3) << "it fell on the ground";
  EXPECT_EQ(world.stats().scenery_built, 1u);
  world.remove_model(upper);
  run(world, 0.1);
  EXPECT_EQ(world.stats().contacts, 0u);
  EXPECT_NE(error_of([&] { world.remove_scenery(floor); }), "");
}

TEST(PhysicsWorld, ShapesFarBehindAreDropped) {
  PhysicsWorld world(params(0.005), silent());
  world.add_scenery(plants(2, 2000));
  PhysicsParams weightless_params = weightless(0.005);
  world.set_params(weightless_params);
  PhysicsModel& body = world.add_model(box_model(1, {0.3, 0.3, 0.3}), at(-140, 0, 0.5));
  body.set_twist({{10, 0, 0}, {0, 0, 0}});
  run(world, 28.0);
  EXPECT_NEAR(body.pose().p.x(), 140.0, 0.1);
  EXPECT_LT(world.stats().scenery_built, 1500u);
}

TEST(PhysicsWorld, FailedModelLeavesNothingBehind) {
  PhysicsWorld world(params(0.001), silent());
  add_ground(world);
  auto massless = box_model(0.0, {0.1, 0.1, 0.1});
  EXPECT_NE(error_of([&] { world.add_model(massless, at(0, 0, 0.05)); }).find("link 'box'"),
            std::string::npos);
  auto huge = box_model(1.0, {0.1, 0.1, 0.1});
  huge->links[0].inertial->inertia_kg_m2 *= 1e30;
  EXPECT_NE(error_of([&] { world.add_model(huge, at(0, 0, 0.05)); }).find("principal moments"),
            std::string::npos);
  auto rover = rover_model();
  rover->joints.back().child = "nothing";
  EXPECT_NE(error_of([&] { world.add_model(rover, at(0, 0, 0.05)); }).find("found link 'nothing'"),
            std::string::npos);
  rover = rover_model();
  rover->links.back().collisions[0].geometry = Sphere{-1.0};
  EXPECT_NE(error_of([&] { world.add_model(rover, at(0, 0, 0.05)); }).find("an invalid radius"),
            std::string::npos);
  auto screw = jointed_model(JointType::kScrew, wheel_inertial(1, 1), axis_along({0, 0, 1}));
  EXPECT_NE(error_of([&] { world.add_model(screw, Pose{}); }).find("screw"), std::string::npos);
  auto empty = std::make_shared<Model>();
  EXPECT_NE(error_of([&] { world.add_model(empty, Pose{}); }).find("no link"), std::string::npos);
  auto zero_axis = jointed_model(JointType::kRevolute, wheel_inertial(1, 1), axis_along({0, 0, 0}));
  EXPECT_NE(error_of([&] { world.add_model(zero_axis, Pose{}); }).find("axis of no length"),
            std::string::npos);
  run(world, 0.1);
  EXPECT_EQ(world.stats().contacts, 0u);
}

TEST(PhysicsWorld, FailedSceneryLeavesNothingBehind) {
  PhysicsWorld world(params(0.001), silent());
  const auto good = static_model(Box{{1, 1, 1}});
  const auto bad = static_model(Box{{1, -1, 1}});
  EXPECT_NE(error_of([&] { world.add_scenery({placement(good), placement(bad)}); }), "");
  EXPECT_NE(error_of([&] { world.add_scenery({placement(good, at(kNan, 0, 0))}); }), "");
  EXPECT_NE(error_of([&] { world.add_scenery({placement(good, {}, 0.0)}); }), "");
  EXPECT_NE(error_of([&] { world.add_scenery({placement(static_model(Heightmap{}))}); }), "");
  EXPECT_NE(error_of([&] { world.add_scenery({placement(static_model(Mesh{}))}); }), "");
  world.add_model(box_model(1, {1, 1, 1}), Pose{});
  world.step();
  EXPECT_EQ(world.stats().contacts, 0u);
}

TEST(PhysicsWorld, StateThatIsNotValidIsRefusedOrNamed) {
  PhysicsWorld world(params(0.001), silent());
  PhysicsModel& body = world.add_model(box_model(1, {1, 1, 1}), Pose{});
  EXPECT_NE(error_of([&] { body.apply_wrench(0, {kNan, 0, 0}, {0, 0, 0}, {0, 0, 0}); }), "");
  EXPECT_NE(error_of([&] { body.set_state(at(0, kNan, 0), {}); }), "");
  world.step();
  EXPECT_NE(error_of([&] { body.apply_wrench(0, {1e300, 0, 0}, {0, 0, 0}, {0, 0, 0}); }), "");
  EXPECT_NE(error_of([&] { body.set_twist({{2e9, 0, 0}, {0, 0, 0}}); }), "");
  EXPECT_NE(error_of([&] { body.set_twist({{0, 0, 0}, {8e8, 8e8, 0}}); }), "");
  EXPECT_NE(error_of([&] { body.set_state(at(5, 0, 0), {{2e9, 0, 0}, {0, 0, 0}}); }), "");
  EXPECT_EQ(body.pose().p.x(), 0.0);
  EXPECT_EQ(body.link_twist(0).linear.x(), 0.0);
}

TEST(PhysicsWorld, OutlivesWhatTheEngineCannotSolve) {
  // A force at the end of a board of 1e9 m would turn its light middle faster than a number can
  // hold.
  PhysicsWorld world(params(0.02), silent());
  world.add_scenery({Placement{static_model(Plane{}), Pose{}}});
  const auto board = box_model(0.1, {0.4, 1e9, 0.4});
  board->links[0].inertial->inertia_kg_m2 = 1e-4 * Eigen::Matrix3d::Identity();
  PhysicsModel& kept = world.add_model(box_model(1, {1, 1, 1}), at(0, 0, 10), "kept");
  for (int i = 0; i < 5; ++i) {
    PhysicsModel& added = world.add_model(board, Pose{}, "board");
    for (const LostModel& lost : world.step()) EXPECT_EQ(lost.model, &added);
    world.remove_model(added);
  }
  EXPECT_NEAR(kept.link_twist(0).linear.z(), -kGravity * 5 * 0.02, 1e-9);
}

TEST(PhysicsWorld, ModelsThatLeaveTheWorldAreNamedAndNoOthers) {
  PhysicsWorld world(params(0.001), silent());
  PhysicsModel& one = world.add_model(box_model(1, {1, 1, 1}), Pose{});
  PhysicsModel& kept = world.add_model(box_model(1, {1, 1, 1}), at(10, 0, 0));
  PhysicsModel& other = world.add_model(box_model(1, {1, 1, 1}), at(20, 0, 0));
  EXPECT_TRUE(world.step().empty());
  one.set_twist({{9e8, 0, 0}, {0, 0, 0}});
  other.set_twist({{0, 9e8, 0}, {0, 0, 0}});
  std::vector<LostModel> lost;
  for (int i = 0; i < 10 && lost.empty(); ++i) lost = world.step();
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0].model, &one);
  EXPECT_EQ(lost[1].model, &other);
  EXPECT_NE(lost[0].why.find("model 'model', link 'box': found a position or velocity beyond the "
                             "world's range"),
            std::string::npos)
      << lost[0].why;
  const double before = kept.pose().p.z();
  EXPECT_EQ(world.step().size(), 2u) << "they are named until they are gone";
  EXPECT_EQ(kept.pose().p.z(), before);
  world.remove_model(one);
  world.remove_model(other);
  EXPECT_TRUE(world.step().empty());
  EXPECT_LT(kept.pose().p.z(), before);
}

TEST(PhysicsWorld, FixedLinksMoveAsOneAndKeepTheirFrames) {
  auto description = box_model(2.0, {0.4, 0.4, 0.1});
  Link mast = link("mast", box_inertial(1.0, {0.05, 0.05, 1.0}));
  mast.X_ML = Pose::from_xyz_rpy({0.1, 0, 0.5}, {0, 0, 0.6});
  Link frame;  // without mass
  frame.name = "frame";
  frame.X_ML.p = {0, 0, 1};
  description->links.push_back(mast);
  description->links.push_back(frame);
  for (const char* name : {"mast", "frame"}) {
    Joint joint;
    joint.name = name;
    joint.parent = "box";
    joint.child = name;
    description->joints.push_back(joint);
  }
  PhysicsWorld world(weightless(0.001), silent());
  const Pose X_WM = Pose::from_xyz_rpy({1, 2, 3}, {0.3, 0.2, 0.1});
  PhysicsModel& body = world.add_model(description, X_WM);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((body.link_pose(i).p - (X_WM * description->links[i].X_ML).p).norm(), 1e-12);
  }
  body.set_twist({{0, 0, 0}, {0, 0, 1}});
  const Eigen::Vector3d arm = body.link_pose(2).p - X_WM.p;
  EXPECT_LT((body.link_twist(2).linear - Eigen::Vector3d::UnitZ().cross(arm)).norm(), 1e-12);
  // A push at the common centre of mass does not turn it.
  body.set_twist({});
  const Eigen::Vector3d com = X_WM * Eigen::Vector3d((1.0 * mast.X_ML.p) / 3.0);
  body.apply_wrench(2, {0, 30, 0}, com, {0, 0, 0});
  world.step();
  EXPECT_LT(body.link_twist(0).angular.norm(), 1e-12);
  EXPECT_NEAR(body.link_twist(0).linear.y(), 10.0 * 0.001, 1e-12);
}

TEST(PhysicsWorld, AnImpossibleInertiaIsTheNearestPossibleOne) {
  // A body with the second moments of mass p has the principal moments p_j + p_k; smaller ones are
  // raised to those of a ball of water of its mass.
  const double a = 0.02;
  const double ball = 0.2 * std::pow(1.0 / (4.0 / 3.0 * M_PI * 1000.0), 2.0 / 3.0);
  for (const auto& [given, expected] :
       {std::pair(Eigen::Vector3d(a, a, 0), Eigen::Vector3d(a + ball, a + ball, 2 * ball)),
        std::pair(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2 * ball, 2 * ball, 2 * ball)),
        std::pair(Eigen::Vector3d(-a, a, 2 * a),
                  Eigen::Vector3d(2 * ball, 2 * a + ball, 2 * a + ball))}) {
    auto flat = box_model(1.0, {0.1, 0.1, 0.1});
    flat->links[0].inertial->inertia_kg_m2 = given.asDiagonal();
    PhysicsWorld world(weightless(0.001), silent());
    PhysicsModel& body = world.add_model(flat, Pose{});
    for (int i = 0; i < 3; ++i) {
      body.set_state(Pose{}, {});
      body.apply_wrench(0, {0, 0, 0}, {0, 0, 0}, 1e-3 * Eigen::Vector3d::Unit(i));
      world.step();
      const double moment = 1e-3 * 0.001 / body.link_twist(0).angular[i];
      EXPECT_NEAR(moment, expected[i], 1e-6) << given.transpose() << ", axis " << i;
    }
  }
}

TEST(PhysicsWorld, AnImpossibleInertiaCountsInTheSumOfWhatItIsFixedTo) {
  auto description = box_model(4.0, {0.3, 0.3, 0.1});
  description->links[0].inertial->inertia_kg_m2 = 0.05 * Eigen::Matrix3d::Identity();
  Link lid = link("lid", box_inertial(2.0, {0.1, 0.1, 0.1}));
  lid.inertial->inertia_kg_m2 << 0.02, 0.02, 0, 0.02, 0.02, 0.02, 0, 0.02, 0.02;
  description->links.push_back(lid);
  Joint joint;
  joint.name = "screwed";
  joint.parent = "box";
  joint.child = "lid";
  description->joints.push_back(joint);
  PhysicsWorld world(weightless(0.001), silent());
  PhysicsModel& body = world.add_model(description, Pose{});
  body.apply_wrench(0, {0, 0, 0}, {0, 0, 0}, {1, 0, 0});
  world.step();
  Eigen::Matrix3d sum = lid.inertial->inertia_kg_m2 + 0.05 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d expected = 0.001 * sum.inverse() * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((body.link_twist(0).angular - expected).norm(), 1e-6);
}

TEST(PhysicsWorld, LinksFarApartAndWideFloorsCostNoMoreThanWhatIsThere) {
  PhysicsWorld world(weightless(0.001), silent());
  std::vector<Placement> posts;
  const auto post = static_model(Box{{0.1, 0.1, 1}});
  for (int i = 0; i < 2000; ++i) posts.push_back(placement(post, at(3.0 * i, 3.0 * i, 5)));
  world.add_scenery(posts);
  auto pair = box_model(1, {0.2, 0.2, 0.2});
  Link far = pair->links[0];
  far.name = "far";
  far.X_ML.p = {20e3, 20e3, 0};
  pair->links.push_back(far);
  world.add_model(pair, Pose{});
  world.step();
  EXPECT_LT(world.stats().scenery_tested, 10u) << "what lies between the links is not looked at";
  PhysicsWorld wide(weightless(0.001), silent());
  wide.add_scenery(posts);
  wide.add_model(box_model(1e6, {1e5, 1e5, 0.1}), Pose{});
  wide.step();  // 10^10 cells, of which 2,000 are occupied
  EXPECT_LE(wide.stats().scenery_tested, 4u * 2000u);
  EXPECT_EQ(wide.stats().scenery_built, 0u);
}

TEST(PhysicsWorld, GravityAndKinematicArePerLink) {
  PhysicsWorld world(params(0.001), silent());
  auto floating = box_model(1, {0.1, 0.1, 0.1});
  floating->links[0].gravity = false;
  PhysicsModel& still = world.add_model(floating, at(0, 0, 1));
  auto held = box_model(1, {0.1, 0.1, 0.1});
  held->links[0].kinematic = true;
  PhysicsModel& kinematic = world.add_model(held, at(1, 0, 1));
  kinematic.set_twist({{0.5, 0, 0}, {0, 0, 0}});
  PhysicsModel& rider = world.add_model(box_model(1, {0.05, 0.05, 0.05}), at(1, 0, 1.075));
  run(world, 1.0);
  EXPECT_NEAR(still.pose().p.z(), 1.0, 1e-12);
  EXPECT_NEAR(kinematic.pose().p.x(), 1.5, 1e-9);
  EXPECT_NEAR(kinematic.pose().p.z(), 1.0, 1e-12);
  EXPECT_NEAR(rider.pose().p.x(), 1.5, 0.02) << "friction carries it along";
}

}  // namespace
}  // namespace ardee::test
