// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/odometry_publisher.h"

namespace ardee::devices {

OdometryPublisher::Params read_odometry_params(Parameters& parameters,
                                               const std::string& robot_namespace,
                                               const DeviceContext& context, const char* base_frame,
                                               WithoutPrefix without_prefix) {
  OdometryPublisher::Params params;
  params.topic = resolve_topic(parameters.text("odometryTopic", "odom"), robot_namespace);
  params.frame =
      plugin_frame(parameters, "odometryFrame", "odom", robot_namespace, context, without_prefix);
  params.base_frame = plugin_frame(parameters, "robotBaseFrame", base_frame, robot_namespace,
                                   context, without_prefix);
  return params;
}

bool reads_wheels(Parameters& parameters) {
  const std::string source = parameters.text("odometrySource", "world");
  if (source == "world" || source == "1") return false;
  if (source == "encoder" || source == "0") return true;
  throw parameters.error("odometrySource", "expected world or encoder");
}

OdometryPublisher::OdometryPublisher(const Params& params, Ports& ports, Robot& robot)
    : params_(params), robot_(robot), timer_(params.rate_hz) {
  if (params.wheels) wheels_.emplace(*params.wheels, robot);
  if (params.has_message) {
    output_ = &ports.add_output(params.topic, reading_kind<OdometryReading>(), params.rate_hz,
                                params.frame);
  }
  if (params.has_transform) {
    tf_output_ =
        &ports.add_output("/tf", reading_kind<TransformReading>(), params.rate_hz, params.frame);
  }
}

OdometryReading OdometryPublisher::measure(TimeNs now_ns) {
  OdometryReading reading;
  reading.header = {now_ns, params_.frame};
  reading.child_frame_id = params_.base_frame;
  reading.pose_covariance = params_.pose_covariance;
  reading.twist_covariance = params_.twist_covariance;
  if (wheels_) {
    wheels_->update();
    reading.pose = wheels_->pose();
    reading.twist = wheels_->twist();
  } else {
    reading.pose = robot_.pose();
    reading.twist = robot_.planar_twist();
  }
  return reading;
}

void OdometryPublisher::publish(TimeNs now_ns, ReadingSink& sink) {
  OdometryReading reading = measure(now_ns);
  if (tf_output_) {
    sink.on_reading(*tf_output_,
                    TransformReading{reading.header, reading.child_frame_id, reading.pose, true});
  }
  if (output_ && output_->demanded) {
    if (params_.is_level) reading.pose.p.z() = 0.0;
    sink.on_reading(*output_, reading);
  }
}

void OdometryPublisher::reset(TimeNs now_ns) {
  timer_.start_at(now_ns + 1);
  if (wheels_) wheels_->reset();
}

}  // namespace ardee::devices
