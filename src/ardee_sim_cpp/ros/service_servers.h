// SPDX-License-Identifier: MIT
#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>

#include <functional>
#include <string>
#include <vector>

namespace ardee::node {

/// The services (and request topics) of a node whose work may throw: an exception becomes success =
/// false with the reason in status_message, or for services without these fields an error for the
/// caller. No exception ends the node.
class ServiceServers {
 public:
  explicit ServiceServers(const ros::NodeHandle& node) : node_(node) {}

  /// The namespace of relative service names.
  const std::string& space() const { return node_.getNamespace(); }

  /// `act` fills the response in and returns the message of success; `label` heads the messages of
  /// failure.
  template <typename Service>
  void add(const std::string& name, const std::string& label,
           std::function<std::string(const typename Service::Request&, typename Service::Response&)>
               act) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    boost::function<bool(Request&, Response&)> serve = [label, act](Request& request,
                                                                    Response& response) {
      try {
        return report(response, true, act(request, response), 0);
      } catch (const std::exception& error) {
        ROS_ERROR_STREAM(label << ": " << error.what());
        return report(response, false, label + ": " + error.what(), 0);
      }
    };
    servers_.push_back(node_.advertiseService(name, serve));
  }

  /// A topic whose messages are requests without answer; errors go to the log.
  template <typename Message>
  void listen(const std::string& topic, const std::string& label,
              std::function<void(const Message&)> act) {
    boost::function<void(const boost::shared_ptr<const Message>&)> on_message =
        [label, act](const boost::shared_ptr<const Message>& message) {
          try {
            act(*message);
          } catch (const std::exception& error) {
            ROS_ERROR_STREAM_THROTTLE(kErrorPeriod_s, label << ": " << error.what());
          }
        };
    subscribers_.push_back(node_.subscribe<Message>(topic, kQueue, on_message));
  }

 private:
  template <typename Response>
  static auto report(Response& response, bool success, const std::string& message, int)
      -> decltype(response.success, bool()) {
    response.success = success;
    response.status_message = message;
    return true;
  }
  template <typename Response>
  static bool report(Response&, bool success, const std::string&, long) {
    return success;
  }

  static constexpr double kErrorPeriod_s = 1.0;
  static constexpr std::uint32_t kQueue = 100;

  ros::NodeHandle node_;
  std::vector<ros::ServiceServer> servers_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace ardee::node
