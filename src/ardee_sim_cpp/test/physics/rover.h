// SPDX-License-Identifier: MIT
#pragma once

#include "models.h"

namespace ardee::test {
using namespace physics;

/// Four-wheeled robot with legs on torsional springs, in the dimensions of a small field robot:
/// wheels of 97 mm, legs of 160 mm, 100 N m/rad, 12 kg in all. Forward is x. Joints: leg and wheel
/// of front left, front right, rear left, rear right.
struct RoverShape {
  double wheel_radius_m = 0.097;
  double wheel_width_m = 0.038;
  double half_track_m = 0.2159;
  double half_base_m = 0.15;
  bool legs = true;
  double mu = 0.8;
  double mass_kg = 8.0;
  double mass_forward_m = 0.0;  // the base's centre of mass
  double mass_left_m = 0.0;
  Eigen::Vector3d fdir1{0, 0, 1};
  bool friction_cone = Surface{}.friction_cone;
};

inline Link rover_wheel(const std::string& name, const RoverShape& shape) {
  Inertial inertial;
  inertial.mass_kg = 0.5;
  inertial.inertia_kg_m2.diagonal() = Eigen::Vector3d(0.00124, 0.00235, 0.00124);
  Link wheel = link(name, inertial);
  Surface rubber;
  rubber.mu = rubber.mu2 = shape.mu;
  rubber.fdir1 = shape.fdir1;
  rubber.friction_cone = shape.friction_cone;
  rubber.kp_n_per_m = 1e6;
  rubber.kd_n_s_per_m = 100.0;
  rubber.max_correcting_velocity_m_per_s = 0.1;
  wheel.collisions.push_back(
      collision(Cylinder{shape.wheel_radius_m, shape.wheel_width_m}, rubber));
  wheel.collisions[0].X_LC = Pose::from_xyz_rpy({0, 0, 0}, {M_PI / 2, 0, 0});
  return wheel;
}

inline Joint rover_joint(const std::string& parent, const std::string& child, JointType type) {
  Joint joint;
  joint.name = child + "_joint";
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.axis.axis = {0, 1, 0};
  return joint;
}

inline void add_rover_corner(Model& rover, const std::string& name, double forward, double left,
                             const RoverShape& shape) {
  // Legs point outwards from the middle of the side: a load turns the front ones up about -y, the
  // rear ones about +y.
  const double leg_x = forward * (shape.half_base_m - 0.13);
  const Eigen::Vector3d hub(forward * shape.half_base_m, left * shape.half_track_m, 0);
  std::string carrier = "base";
  if (shape.legs) {
    Link leg = link(name + "_leg", box_inertial(0.19, {0.16, 0.045, 0.017}));
    leg.X_ML.p = {leg_x, left * 0.18, 0.09};
    leg.inertial->X_LI.p = {forward * 0.065, 0, -0.045};
    Collision bar = collision(Box{{0.15, 0.02, 0.017}});
    bar.X_LC = Pose::from_xyz_rpy({forward * 0.065, 0, -0.045}, {0, forward * 0.6, 0});
    leg.collisions.push_back(bar);
    rover.links.push_back(leg);
    rover.joints.push_back(rover_joint("base", leg.name, JointType::kRevolute));
    JointAxis& axis = rover.joints.back().axis;
    axis.spring_stiffness = 100.0;
    axis.damping = 1.0;
    axis.lower = forward > 0 ? -0.682 : 0.0;
    axis.upper = forward > 0 ? 0.0 : 0.682;
    carrier = leg.name;
  }
  Link wheel = rover_wheel(name + "_wheel", shape);
  wheel.X_ML.p = hub;
  rover.links.push_back(wheel);
  rover.joints.push_back(rover_joint(carrier, wheel.name, JointType::kContinuous));
}

/// Returns the model; its origin is between the hubs, at their height.
inline std::shared_ptr<Model> rover_model(const RoverShape& shape = {}) {
  Link base = link("base", box_inertial(shape.mass_kg, {0.5, 0.3, 0.13}));
  base.inertial->X_LI.p = {shape.mass_forward_m, shape.mass_left_m, 0.1};
  base.collisions.push_back(collision(Box{{0.5, 0.3, 0.13}}));
  base.collisions[0].X_LC.p = {0, 0, 0.12};
  auto rover = model(base);
  add_rover_corner(*rover, "front_left", 1, 1, shape);
  add_rover_corner(*rover, "front_right", 1, -1, shape);
  add_rover_corner(*rover, "rear_left", -1, 1, shape);
  add_rover_corner(*rover, "rear_right", -1, -1, shape);
  return rover;
}

/// Returns the index of a wheel joint in the order front left, front right, rear left, rear right.
inline std::size_t wheel_joint(const RoverShape& shape, std::size_t corner) {
  return shape.legs ? 2 * corner + 1 : corner;
}

/// Turns the wheels of both sides [rad/s], each with at most the given torque.
inline void drive(PhysicsModel& rover, const RoverShape& shape, double left, double right,
                  double torque_n_m = 10.0) {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    rover.set_joint_motor(wheel_joint(shape, corner), corner % 2 == 0 ? left : right, torque_n_m);
  }
}

}  // namespace ardee::test
