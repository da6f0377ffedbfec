// SPDX-License-Identifier: MIT
#pragma once

#include <geometry_msgs/Twist.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/simulation/entity.h"
#include "ros/device_services.h"
#include "ros/odometry_frames.h"
#include "ros/performance_metrics.h"
#include "ros/picture_sender.h"

namespace ardee::node {

/// The topics and services of the robots' devices: publishers of what they measure, subscribers to
/// their commands. They come when a robot is spawned and go when it is removed.
class RobotTopics : public ReadingSink {
 public:
  RobotTopics(OdometryFrames& frames, PerformanceMetrics& metrics, Log log)
      : frames_(frames), metrics_(metrics), log_(std::move(log)) {}

  /// A sensor whose topics cannot be had is taken off the entity, with a message. Throws Error if
  /// those of another device cannot; then none of the entity's is there.
  void add(Entity& entity);
  void remove(const std::string& entity_name);
  /// Tells the devices which of their outputs somebody listens to.
  void update_demand();
  void on_reading(const Output& output, const Reading& reading) override;

 private:
  struct Route {
    Output* output = nullptr;
    const Robot* robot = nullptr;
    std::string sensor;  // its scoped name where a sensor is what measures
    bool is_camera = false;
    ros::Publisher publisher;
    std::unique_ptr<PictureSender> pictures;  // in its place, for pictures

    bool has_listeners() const;
  };
  struct Topics {
    std::vector<Route> routes;
    std::vector<ros::Subscriber> subscribers;
    std::unique_ptr<DeviceServices> services;
  };
  void add(Device& device, const Robot& robot, Topics& topics);
  Route advertise(Output& output, const Robot& robot);
  void count(const Route& route, TimeNs now_ns);
  ros::Subscriber subscribe(const Input& input);
  ros::Subscriber subscribe(const NumberInput& input);
  ros::Subscriber subscribe(const WrenchInput& input);

  OdometryFrames& frames_;
  PerformanceMetrics& metrics_;
  Log log_;
  ros::NodeHandle node_;
  image_transport::ImageTransport images_{node_};
  std::map<std::string, Topics> topics_;
  std::unordered_map<const Output*, const Route*> routes_;
};

}  // namespace ardee::node
