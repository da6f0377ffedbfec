// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/wheel_publisher.h"

namespace ardee::devices {

WheelPublisher::Params read_wheel_publisher_params(Parameters& parameters,
                                                   const std::vector<std::size_t>& joints,
                                                   const std::string& robot_namespace,
                                                   const DeviceContext& context,
                                                   WithoutPrefix without_prefix) {
  WheelPublisher::Params params;
  for (const std::size_t joint : joints) {
    const Joint& described = context.robot.model().joints[joint];
    params.wheels.push_back(
        {joint, resolve_frame(described.parent, robot_namespace, context, without_prefix),
         resolve_frame(described.child, robot_namespace, context, without_prefix)});
  }
  params.has_transforms = parameters.boolean("publishWheelTF", false);
  params.has_states = parameters.boolean("publishWheelJointState", false);
  params.topic = resolve_topic("joint_states", robot_namespace);
  return params;
}

WheelPublisher::WheelPublisher(const Params& params, double rate_hz, Ports& ports, Robot& robot)
    : params_(params), robot_(robot) {
  if (params.has_states) {
    output_ = &ports.add_output(params.topic, reading_kind<JointStateReading>(), rate_hz);
  }
  if (params.has_transforms) {
    tf_output_ = &ports.add_output("/tf", reading_kind<TransformReading>(), rate_hz);
  }
}

void WheelPublisher::publish(TimeNs now_ns, ReadingSink& sink) const {
  JointStateReading states;
  states.header.stamp_ns = now_ns;
  for (const Wheel& wheel : params_.wheels) {
    const Joint& joint = robot_.model().joints[wheel.joint];
    states.names.push_back(joint.name);
    states.positions.push_back(robot_.dynamics().joint_position(wheel.joint));
    states.velocities.push_back(robot_.dynamics().joint_velocity(wheel.joint));
    if (!tf_output_) continue;
    const Pose X_WP = robot_.link_pose(robot_.link_index(joint.parent, joint.source));
    const Pose X_WC = robot_.link_pose(robot_.link_index(joint.child, joint.source));
    sink.on_reading(
        *tf_output_,
        TransformReading{{now_ns, wheel.parent_frame}, wheel.frame, X_WP.inverse() * X_WC});
  }
  if (output_ && output_->demanded) sink.on_reading(*output_, states);
}

}  // namespace ardee::devices
