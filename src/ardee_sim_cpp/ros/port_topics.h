// SPDX-License-Identifier: MIT
#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/devices/ports.h"
#include "ardee_sim/devices/robot.h"
#include "ros/action_servers.h"
#include "ros/device_services.h"
#include "ros/picture_sender.h"

namespace ardee::node {

/// Destination of an output's readings.
struct Route {
  devices::Output* output = nullptr;
  const devices::Robot* robot = nullptr;
  std::string sensor;  // scoped name of the sensor, or empty
  bool is_camera = false;
  ros::Publisher publisher;
  std::unique_ptr<PictureSender> pictures;  // replaces the publisher for pictures

  bool has_listeners() const;
};

/// All published outputs.
using Routes = std::unordered_map<const devices::Output*, Route>;

/// The topics, services, tunings and actions of the ports of a device or of a controller; they
/// exist as long as this object.
class PortTopics {
 public:
  /// `sensor` is the scoped name of a sensor, or empty. Throws Error if a topic cannot be created,
  /// and leaves none behind then. All references outlive this object.
  PortTopics(const ros::NodeHandle& node, devices::Ports& ports, const devices::Robot& robot,
             const std::string& sensor, Routes& routes);
  ~PortTopics();
  PortTopics(const PortTopics&) = delete;
  PortTopics& operator=(const PortTopics&) = delete;

  /// Names of services that were not advertised because they are taken.
  const std::vector<std::string>& taken() const { return services_.taken(); }

 private:
  Route advertise(devices::Output& output, const devices::Robot& robot);

  ros::NodeHandle node_;
  image_transport::ImageTransport images_{node_};
  devices::Ports& ports_;
  Routes& routes_;
  std::vector<ros::Subscriber> subscribers_;
  DeviceServices services_;
  ActionServers actions_;
};

/// Warns once of a robot's services that are taken; roscpp would warn of each.
void warn_of_taken(const std::vector<std::string>& services, const devices::Robot& robot, Log& log);

}  // namespace ardee::node
