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

/// Where the readings of an output go.
struct Route {
  devices::Output* output = nullptr;
  const devices::Robot* robot = nullptr;
  std::string sensor;  // its scoped name where a sensor is what measures
  bool is_camera = false;
  ros::Publisher publisher;
  std::unique_ptr<PictureSender> pictures;  // in its place, for pictures

  bool has_listeners() const;
};

/// All outputs that are published now.
using Routes = std::unordered_map<const devices::Output*, Route>;

/// The topics, services, tunings and actions of the ports of a device or of a controller; they are
/// there as long as this is.
class PortTopics {
 public:
  /// `sensor` is the scoped name of a sensor, or empty. Throws Error if a topic cannot be had, and
  /// leaves none behind then. All references outlive this object.
  PortTopics(const ros::NodeHandle& node, devices::Ports& ports, const devices::Robot& robot,
             const std::string& sensor, Routes& routes);
  ~PortTopics();
  PortTopics(const PortTopics&) = delete;
  PortTopics& operator=(const PortTopics&) = delete;

  /// Services that are another's already.
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

/// Says once whose services are another's already, which roscpp would of each.
void warn_of_taken(const std::vector<std::string>& services, const devices::Robot& robot, Log& log);

}  // namespace ardee::node
