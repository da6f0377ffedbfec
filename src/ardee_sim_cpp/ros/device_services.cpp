// SPDX-License-Identifier: MIT
#include "ros/device_services.h"

#include <control_msgs/QueryTrajectoryState.h>
#include <hector_gazebo_plugins/SetBias.h>
#include <hector_gazebo_plugins/SetReferenceGeoPose.h>
#include <ros/service_manager.h>
#include <std_srvs/Empty.h>

#include <utility>

#include "ros/command_subscription.h"
#include "ros/conversions.h"

namespace ardee::node {
namespace {

devices::GeoPose from_ros_geo(const geographic_msgs::GeoPose& message) {
  geometry_msgs::Pose pose;
  pose.orientation = message.orientation;
  return {message.position.latitude, message.position.longitude, message.position.altitude,
          from_ros(pose).q};
}

}  // namespace

bool is_free_service(const std::string& name) {
  return !ros::ServiceManager::instance()->lookupServicePublication(name);
}

bool DeviceServices::is_free(const std::string& name) {
  if (is_free_service(name)) return true;
  taken_.push_back(name);
  return false;
}

void DeviceServices::add(const devices::ParameterGroup& tuning) {
  if (!is_free(TuningServer::service_of(tuning))) return;
  tunings_.push_back(std::make_unique<TuningServer>(node_, tuning));
}

void DeviceServices::add(const devices::Service& service) {
  using control_msgs::QueryTrajectoryState;
  using hector_gazebo_plugins::SetBias;
  using hector_gazebo_plugins::SetReferenceGeoPose;
  using std_srvs::Empty;
  require_valid(service.name);
  if (!is_free(service.name)) return;
  if (const auto* act = std::get_if<std::function<void()>>(&service.act)) {
    servers_.add<Empty>(service.name, service.name,
                        [act = *act](const Empty::Request&, Empty::Response&) {
                          act();
                          return std::string();
                        });
  } else if (const auto* set =
                 std::get_if<std::function<void(const Eigen::Vector3d&)>>(&service.act)) {
    servers_.add<SetBias>(service.name, service.name,
                          [set = *set](const SetBias::Request& request, SetBias::Response&) {
                            set(from_ros(request.bias));
                            return std::string();
                          });
  } else if (const auto* state_at =
                 std::get_if<std::function<devices::TrajectoryState(double)>>(&service.act)) {
    servers_.add<QueryTrajectoryState>(
        service.name, service.name,
        [state_at = *state_at](const QueryTrajectoryState::Request& request,
                               QueryTrajectoryState::Response& response) {
          devices::TrajectoryState state = state_at(request.time.toSec());
          response.name = std::move(state.names);
          response.position = std::move(state.positions);
          response.velocity = std::move(state.velocities);
          response.acceleration = std::move(state.accelerations);
          return std::string();
        });
  } else {
    servers_.add<SetReferenceGeoPose>(
        service.name, service.name,
        [place = std::get<std::function<void(const devices::GeoPose&)>>(service.act)](
            const SetReferenceGeoPose::Request& request, SetReferenceGeoPose::Response&) {
          place(from_ros_geo(request.geo_pose));
          return std::string();
        });
  }
}

}  // namespace ardee::node
