// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "../statistics.h"
#include "ardee_sim/devices/geodesy.h"
#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr const char* kReference =
    "<referenceLatitude>40.1</referenceLatitude><referenceLongitude>-88.2</referenceLongitude>"
    "<referenceAltitude>220</referenceAltitude>";

std::string gps(const std::string& keys) { return plugin("hector_gazebo_ros_gps", keys); }

std::vector<FixReading> fixes(TestWorld& world) { return world.recorder().on<FixReading>("/fix"); }

Vector3d local(const FixReading& fix, double heading_deg = 0.0) {
  const LocalFrame frame({40.1, -88.2, 220.0}, heading_deg * kDegree,
                         LocalFrame::Projection::kFlat);
  return frame.to_local({fix.latitude_deg, fix.longitude_deg, fix.altitude_m});
}

TEST(Gps, tells_where_it_is_to_a_millimetre_over_a_kilometre) {
  for (const double heading_deg : {0.0, 90.0}) {
    TestWorld world(free_space(0.0), 0.01);
    world.spawn(still(gps(kReference + std::string("<bodyName>nose</bodyName><referenceHeading>") +
                          std::to_string(heading_deg) + "</referenceHeading>")),
                "ball", Pose::from_xyz_rpy({999, 1000, -3}, {0, 0, 0}));
    world.run(1.0);
    ASSERT_EQ(fixes(world).size(), 4u);  // hector's default of 4 Hz
    const FixReading fix = fixes(world).back();
    EXPECT_LE((local(fix, heading_deg) - Vector3d(1000, 1000, -3)).norm(), 1e-3);
    EXPECT_GT(fix.latitude_deg, 40.1);
    EXPECT_EQ(fix.longitude_deg > -88.2, heading_deg == 90.0);  // y is west, x is east
    EXPECT_EQ(fix.status, 0);
    EXPECT_EQ(fix.header.frame_id, "world");
  }
}

TEST(Gps, velocity_is_north_west_up) {
  for (const double heading_deg : {0.0, 90.0}) {
    TestWorld world(free_space(0.0), 0.01);
    world.spawn(ball(gps("<updateRate>10</updateRate><referenceHeading>" +
                         std::to_string(heading_deg) + "</referenceHeading>")),
                "ball");
    world->set_state("ball", {Pose{}, {{2, 1, 0.5}, {0, 0, 0}}}, "world");
    world.run(0.5);
    const Vector3d expected = heading_deg == 0.0 ? Vector3d(2, 1, 0.5) : Vector3d(1, -2, 0.5);
    expect_near(world.recorder().on<VectorReading>("/fix_velocity").back().vector, expected, 1e-9);
  }
}

TEST(Gps, antenna_on_an_arm_moves_with_it) {
  TestWorld world(free_space(0.0), 0.001);
  world.spawn(ball(gps("<bodyName>nose</bodyName><updateRate>0</updateRate>")), "ball");
  world->set_state("ball", {Pose{}, {{0, 0, 0}, {0, 0, 2.0}}}, "world");
  world.run(0.002);
  expect_near(world.recorder().on<VectorReading>("/fix_velocity").back().vector, {0, 2, 0}, 0.02);
}

TEST(Gps, noise_has_its_deviation_and_covariance) {
  const std::size_t count = 20000;
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(gps(kReference + std::string("<updateRate>10</updateRate><offset>3 0 0</offset>"
                                                 "<gaussianNoise>0.5 0.1 1</gaussianNoise>"))),
              "ball");
  for (std::size_t i = 0; i < count; ++i) world->step();
  std::vector<double> x, y;
  for (const FixReading& fix : fixes(world)) {
    x.push_back(local(fix).x());
    y.push_back(local(fix).y());
  }
  ASSERT_EQ(x.size(), count);
  const double root = std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(mean_of(x), 3.0, kFourSigma * 0.5 / root);
  EXPECT_NEAR(std_of(x) / 0.5, 1.0, kFourSigma / (root * M_SQRT2));
  EXPECT_NEAR(std_of(y) / 0.1, 1.0, kFourSigma / (root * M_SQRT2));
  const FixReading fix = fixes(world).back();
  // The order is east, north, up: x is north at heading 0.
  EXPECT_NEAR(fix.covariance[0], 0.01, 1e-9);
  EXPECT_NEAR(fix.covariance[1], 0.25, 1e-9);
  EXPECT_NEAR(fix.covariance[2], 1.0, 1e-9);
}

TEST(Gps, exact_drift_is_correlated_over_its_time) {
  const std::size_t count = 50000;
  TestWorld world(free_space(0.0), 0.2);
  world.spawn(still(gps(kReference + std::string("<updateRate>5</updateRate><drift>1.37</drift>"
                                                 "<driftFrequency>0.0833333</driftFrequency>"
                                                 "<noiseMode>exact</noiseMode>"))),
              "ball");
  for (std::size_t i = 0; i < count; ++i) world->step();
  std::vector<double> x;
  for (const FixReading& fix : fixes(world)) x.push_back(local(fix).x());
  const double phi = std::exp(-0.2 / 12.0);
  const double independent = static_cast<double>(count) * (1 - phi * phi) / (1 + phi * phi);
  EXPECT_NEAR(std_of(x) / 1.37, 1.0, kFourSigma / std::sqrt(2.0 * independent));
  // After 12 s a correlation of 1/e remains; Bartlett's variance of it is at most that of
  // independent / 2 values.
  EXPECT_NEAR(correlation_at(x, 60), std::exp(-1.0), kFourSigma * std::sqrt(2.0 / independent));
}

TEST(Gps, drift_of_the_velocity_moves_the_position) {
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(
      still(gps(kReference + std::string("<updateRate>10</updateRate>"
                                         "<velocityDrift>0.5</velocityDrift>"
                                         "<velocityDriftFrequency>0</velocityDriftFrequency>"
                                         "<driftFrequency>0</driftFrequency>"))),
      "ball");
  world.run(5.0);
  const auto velocity = world.recorder().on<VectorReading>("/fix_velocity").back().vector;
  const auto readings = fixes(world);
  const Vector3d moved = local(readings[readings.size() - 1]) - local(readings[0]);
  EXPECT_GT(velocity.norm(), 0.01);
  expect_near(moved, velocity * 4.9, 1e-6);
}

TEST(Gps, reference_from_the_world) {
  TestWorld world(free_space(0.0) +
                      "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
                      "<latitude_deg>52</latitude_deg><longitude_deg>6</longitude_deg>"
                      "<elevation>12</elevation><heading_deg>0</heading_deg>"
                      "</spherical_coordinates>",
                  0.01);
  world.spawn(still(gps("<useWorldSphericalCoordinates>true</useWorldSphericalCoordinates>")),
              "ball", Pose::from_xyz_rpy({100, 0, 0}, {0, 0, 0}));
  world.run(0.5);
  EXPECT_NEAR(fixes(world).back().latitude_deg, 52.0, 1e-9);
  EXPECT_GT(fixes(world).back().longitude_deg, 6.001);  // x is east
  EXPECT_NEAR(fixes(world).back().altitude_m, 12.0, 1e-6);
}

TEST(Gps, prefers_the_worlds_reference_where_there_is_one) {
  const std::string keys =
      std::string(kReference) +
      "<preferWorldSphericalCoordinates>true</preferWorldSphericalCoordinates>";
  TestWorld world(free_space(0.0) +
                      "<spherical_coordinates><latitude_deg>52</latitude_deg>"
                      "<longitude_deg>6</longitude_deg></spherical_coordinates>",
                  0.01);
  world.spawn(still(gps(keys)), "ball");
  world.run(0.5);
  EXPECT_NEAR(fixes(world).back().latitude_deg, 52.0, 1e-9);
  EXPECT_NEAR(fixes(world).back().longitude_deg, 6.0, 1e-9);

  TestWorld elsewhere(free_space(0.0), 0.01);
  elsewhere.spawn(still(gps(keys)), "ball");
  elsewhere.run(0.5);
  EXPECT_NEAR(fixes(elsewhere).back().latitude_deg, 40.1, 1e-9);
  EXPECT_NEAR(fixes(elsewhere).back().longitude_deg, -88.2, 1e-9);
  EXPECT_TRUE(elsewhere.messages().empty());  // that there is none is no fault
}

TEST(Gps, reference_is_set_by_the_service_with_its_radii) {
  TestWorld world(free_space(0.0), 0.01);
  Entity& robot =
      world.spawn(still(gps(kReference)), "ball", Pose::from_xyz_rpy({0, 1000, 0}, {0, 0, 0}));
  const auto& set_reference = std::get<std::function<void(const GeoPose&)>>(
      service(robot, "/fix/set_reference_geopose").act);
  GeoPose place{60.0, 25.0, 7.0, Eigen::Quaterniond::Identity()};  // x is east
  set_reference(place);
  world.run(0.5);
  // Radius of the meridian at 60 degrees: a (1 - e^2) / (1 - e^2 sin^2)^1.5 = 6383453.857 m.
  EXPECT_NEAR(fixes(world).back().latitude_deg, 60.0 + 1000.0 / 6383453.857 / kDegree, 1e-9);
  EXPECT_NEAR(fixes(world).back().longitude_deg, 25.0, 1e-9);
  place.latitude_deg = 90.0;
  EXPECT_THROW(set_reference(place), Error);
  place.latitude_deg = NAN;
  EXPECT_THROW(set_reference(place), Error);
}

TEST(Gps, status_is_tuned_as_gnss) {
  TestWorld world(free_space(0.0), 0.01);
  Entity& robot = world.spawn(still(gps("<service>1</service>")), "ball");
  const ParameterGroup& status = tuning(robot, "/fix/status");
  set(status, "STATUS_SBAS_FIX", 1.0);
  set(status, "SERVICE_GALILEO", 1.0);
  world.run(0.3);
  EXPECT_EQ(fixes(world).back().status, 1);
  EXPECT_EQ(fixes(world).back().service, 9);
  set(status, "STATUS_FIX", 0.0);
  set(status, "SERVICE_GPS", 0.0);
  world.run(0.3);
  EXPECT_EQ(fixes(world).back().status, -1);
  EXPECT_EQ(fixes(world).back().service, 8);
}

TEST(Gps, times_come_from_rate_or_period_and_offset) {
  const auto stamps = [](const std::string& keys) {
    TestWorld world(free_space(0.0), 0.01);
    world.spawn(still(gps(keys)), "ball");
    world.run(1.0);
    std::vector<TimeNs> found;
    for (const FixReading& fix : fixes(world)) found.push_back(fix.header.stamp_ns / 1000000);
    return found;
  };
  using Times = std::vector<TimeNs>;
  EXPECT_EQ(stamps("<updateRate>2</updateRate>"), (Times{500, 1000}));
  EXPECT_EQ(stamps("<updateRate>9</updateRate><updatePeriod>0.4</updatePeriod>"),
            (Times{400, 800}));
  EXPECT_EQ(stamps("<updatePeriod>0.4</updatePeriod><updateOffset>0.1</updateOffset>"),
            (Times{100, 500, 900}));
  EXPECT_EQ(stamps("<updateRate>0</updateRate>").size(), 100u);
}

TEST(Gps, bad_values_leave_it_out_and_say_where) {
  for (const char* each :
       {"<referenceLatitude>91</referenceLatitude>", "<bodyName>wing</bodyName>",
        "<drift>-1</drift>", "<updateRate>often</updateRate>", "<projection>mercator</projection>",
        "<status>7</status>", "<velocityGaussianNoise>nan</velocityGaussianNoise>"}) {
    TestWorld world(free_space(0.0));
    EXPECT_TRUE(world.spawn(ball(gps(each)), "ball").devices.empty()) << each;
    ASSERT_EQ(world.messages().size(), 1u) << each;
    EXPECT_NE(world.messages()[0].find("ball.urdf:1"), std::string::npos) << world.messages()[0];
  }
}

TEST(Magnetometer, field_in_the_body) {
  TestWorld world(free_space(0.0), 0.01);
  world.spawn(still(plugin("hector_gazebo_ros_magnetic", "")), "ball");
  world.spawn(still(plugin("hector_gazebo_ros_magnetic",
                           "<topicName>east</topicName><referenceHeading>90</referenceHeading>"
                           "<magnitude>5e-5</magnitude><inclination>0</inclination>"
                           "<useMagneticFieldMsgs>true</useMagneticFieldMsgs>")),
              "other", Pose::from_xyz_rpy({0, 0, 0}, {0, 0, 90.0 * kDegree}));
  world.spawn(still(plugin("hector_gazebo_ros_magnetic",
                           "<topicName>declined</topicName><declination>30</declination>"
                           "<inclination>0</inclination><bodyName>nose</bodyName>")),
              "third");
  world.run(0.05);
  expect_near(world.recorder().on<VectorReading>("/magnetic").back().vector,
              {0.5, 0, -std::sqrt(0.75)}, 1e-12);
  // x is east, y north; the robot is turned to the north.
  expect_near(world.recorder().on<MagneticFieldReading>("/east").back().field_T, {5e-5, 0, 0},
              1e-12);
  // The direction is 30 degrees to the east of x = north; the nose's -z is its left.
  expect_near(world.recorder().on<VectorReading>("/declined").back().vector,
              {std::sqrt(0.75), 0, 0.5}, 1e-12);
}

TEST(Gps, receivers_of_one_name_err_independently) {
  const std::size_t count = 2000;
  const auto receiver = [](const std::string& topic) {
    return gps(kReference +
               std::string("<updateRate>10</updateRate><gaussianNoise>1</gaussianNoise>"
                           "<topicName>") +
               topic + "</topicName>");
  };
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(receiver("left") + receiver("right")), "ball");
  for (std::size_t i = 0; i < count; ++i) world->step();
  const auto left = world.recorder().on<FixReading>("/left");
  const auto right = world.recorder().on<FixReading>("/right");
  ASSERT_EQ(left.size() + right.size(), 2 * count);
  double products = 0.0;
  for (std::size_t i = 0; i < count; ++i) products += local(left[i]).x() * local(right[i]).x();
  EXPECT_NEAR(products / static_cast<double>(count), 0.0,
              kFourSigma / std::sqrt(static_cast<double>(count)));
}

TEST(GroundTruth, pose_and_velocity_of_a_link) {
  const auto truth = [](const std::string& keys) {
    return plugin("gazebo_ros_p3d", "<bodyName>nose</bodyName><updateRate>10</updateRate>" + keys);
  };
  TestWorld world(free_space(0.0), 0.01);
  world.spawn(ball(truth("<topicName>world</topicName><xyzOffset>0 0 5</xyzOffset>") +
                   truth("<topicName>local</topicName><local_twist>true</local_twist>") +
                   truth("<topicName>seen</topicName><frameName>body</frameName>")),
              "ball");
  const Pose turned = Pose::from_xyz_rpy({1, 2, 3}, {0, 0, 90.0 * kDegree});
  world->set_state("ball", {turned, {{0.5, 0, 0}, {0, 0, 0}}}, "world");
  world.run(1.0);
  const auto last = [&world](const char* topic) {
    const auto readings = world.recorder().on<OdometryReading>(topic);
    EXPECT_EQ(readings.size(), 10u);
    return readings.back();
  };
  const OdometryReading in_world = last("/world");
  expect_near(in_world.pose.p, {1.5, 3, 8}, 1e-9);
  expect_near(in_world.twist.linear, {0.5, 0, 0}, 1e-9);
  EXPECT_EQ(in_world.header.frame_id, "world");
  EXPECT_EQ(in_world.child_frame_id, "nose");
  EXPECT_FALSE(in_world.in_odometry_frame);
  // The nose has x forwards (world's y), y up, z to its right (world's x).
  expect_near(last("/local").twist.linear, {0, 0, 0.5}, 1e-9);
  const OdometryReading seen = last("/seen");
  expect_near(seen.pose.p, {1, 0, 0}, 1e-9);
  expect_near(seen.twist.linear, {0, 0, 0}, 1e-9);
  EXPECT_EQ(seen.header.frame_id, "body");
}

TEST(GroundTruth, noise_is_on_the_velocities) {
  TestWorld world(free_space(0.0), 0.01);
  world.spawn(still(plugin("gazebo_ros_p3d",
                           "<bodyName>body</bodyName><topicName>truth</topicName>"
                           "<gaussianNoise>0.2</gaussianNoise>")),
              "ball");
  for (int i = 0; i < 20000; ++i) world->step();
  std::vector<double> speed, turn;
  for (const OdometryReading& each : world.recorder().on<OdometryReading>("/truth")) {
    speed.push_back(each.twist.linear.x());
    turn.push_back(each.twist.angular.z());
    EXPECT_EQ(each.pose.p, Vector3d::Zero());
    EXPECT_NEAR(each.twist_covariance[0], 0.04, 1e-12);
  }
  const double relative = kFourSigma / std::sqrt(2.0 * 20000.0);
  EXPECT_NEAR(std_of(speed) / 0.2, 1.0, relative);
  EXPECT_NEAR(std_of(turn) / 0.2, 1.0, relative);
}

}  // namespace
}  // namespace ardee
