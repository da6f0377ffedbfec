// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/hardware_sensors.h"

namespace ardee::control {
namespace {

/// Whether the physics has the joint, so that something acts through it.
bool has_wrench(physics::PhysicsModel& physics, const Joint& joint, std::size_t index) {
  if (joint.type != JointType::kFixed) return true;
  try {
    physics.want_joint_wrench(index);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

HardwareSensors::HardwareSensors(devices::DeviceContext& context)
    : robot_(context.robot), gravity_m_per_s2_(context.world_info.gravity_m_per_s2) {
  const Model& model = robot_.model();
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const SensorDescription& sensor : model.links[link].sensors) {
      if (sensor.type != "imu" || handles_.imus.count(sensor.name) > 0) continue;
      ImuHandle& handle = handles_.imus[sensor.name];
      handle.frame = model.links[link].name;
      imus_.push_back(
          {&handle, link, sensor.X_LS, devices::InertialMotion(robot_, link, sensor.X_LS)});
    }
  }
  for (std::size_t index = 0; index < model.joints.size(); ++index) {
    const Joint& joint = model.joints[index];
    if (!has_wrench(robot_.dynamics(), joint, index)) continue;
    ForceTorqueHandle& handle = handles_.force_torques[joint.name];
    handle.frame = joint.child;
    wrenches_.push_back({&handle, index, robot_.link_index(joint.child, joint.source)});
  }
}

void HardwareSensors::reset(TimeNs now_ns) {
  for (Imu& imu : imus_) imu.motion.reset(now_ns);
}

void HardwareSensors::serialize(StateArchive& state) {
  for (Imu& imu : imus_) {
    state(imu.motion, imu.handle->orientation, imu.handle->angular_velocity,
          imu.handle->linear_acceleration);
  }
  for (JointWrench& each : wrenches_) state(each.handle->wrench, each.handle->is_wanted);
}

void HardwareSensors::on_set_state() {
  for (Imu& imu : imus_) imu.motion.on_set_state();
}

void HardwareSensors::begin_step(TimeNs now_ns) {
  for (Imu& imu : imus_) imu.motion.begin_step(now_ns);
  for (JointWrench& each : wrenches_) {
    if (each.handle->is_wanted) robot_.dynamics().want_joint_wrench(each.joint);
  }
}

void HardwareSensors::end_step(TimeNs now_ns) {
  for (Imu& imu : imus_) imu.motion.end_step(now_ns, gravity_m_per_s2_());
}

void HardwareSensors::read() {
  for (Imu& imu : imus_) {
    const devices::InertialMotion::Mean mean = imu.motion.take();
    imu.handle->orientation = (robot_.link_pose(imu.link) * imu.X_LS).q;
    imu.handle->angular_velocity = mean.angular_velocity;
    imu.handle->linear_acceleration = mean.specific_force();
  }
  for (JointWrench& each : wrenches_) {
    if (!each.handle->is_wanted) continue;
    const physics::ForceTorque wrench_W = robot_.dynamics().joint_wrench(each.joint);
    const Eigen::Quaterniond q_CW = robot_.link_pose(each.child).q.conjugate();
    each.handle->wrench = {q_CW * wrench_W.force, q_CW * wrench_W.torque};
  }
}

}  // namespace ardee::control
