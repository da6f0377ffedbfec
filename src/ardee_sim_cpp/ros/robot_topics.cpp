// SPDX-License-Identifier: MIT
#include "ros/robot_topics.h"

#include <ros/console.h>
#include <ros/names.h>
#include <std_msgs/Float64.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/sensor.h"
#include "ros/conversions.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kOutputQueue = 100;  // faster than real time, messages come in bursts
constexpr std::uint32_t kImageQueue = 5;     // a picture is large
constexpr std::uint32_t kCommandQueue = 10;
constexpr double kWarningPeriod_s = 5.0;

template <std::size_t kKind>
using MessageOf = decltype(to_message(std::declval<std::variant_alternative_t<kKind, Reading>>()));

template <std::size_t... kKinds>
ros::Publisher advertise_kind(ros::NodeHandle& node, const Output& output,
                              std::index_sequence<kKinds...>) {
  ros::Publisher publisher;
  const auto try_kind = [&](auto kind) {
    if (output.kind == kind) {
      publisher = node.advertise<MessageOf<kind>>(output.topic, kOutputQueue, output.latched);
    }
  };
  (try_kind(std::integral_constant<std::size_t, kKinds>()), ...);
  return publisher;
}

/// Odometry is measured at all times: OdometryFrames reads it.
bool always_demanded(const Output& output) {
  return output.kind == reading_kind<OdometryReading>() ||
         output.kind == reading_kind<TransformReading>();
}

bool is_picture(const Output& output) { return output.kind == reading_kind<ImageReading>(); }

void require_valid(const std::string& topic) {
  std::string why;
  if (!ros::names::validate(topic, why)) {
    throw Error("found '" + topic + "' as a topic or service, expected a valid name: " + why);
  }
}

/// Warns at once, and then not again for a while of wall time. ROS's own throttle counts simulated
/// time, and says nothing in its first seconds.
class Complaint {
 public:
  void say(const std::string& text) {
    const ros::WallTime now = ros::WallTime::now();
    if (!last_.isZero() && (now - last_).toSec() < kWarningPeriod_s) return;
    last_ = now;
    ROS_WARN_STREAM(text);
  }

 private:
  ros::WallTime last_;
};

/// "model::link::sensor", or nothing for a device that is no sensor.
std::string sensor_name(const Device& device, const Robot& robot) {
  const auto* sensor = dynamic_cast<const Sensor*>(&device);
  if (!sensor) return "";
  return robot.name() + "::" + robot.model().links[sensor->link()].name + "::" + device.name();
}

/// roscpp would say so of each, and not whose they are.
void warn_of_taken(const std::vector<std::string>& services, const Robot& robot, Log& log) {
  if (services.empty()) return;
  const std::size_t others = services.size() - 1;
  log.warn(robot.model().source.to_string() + ": service " + services.front() +
           (others > 0 ? " and " + std::to_string(others) + " more are" : " is") +
           " there already and " + (others > 0 ? "stay what they were" : "stays what it was") +
           "; a namespace of its own gives a robot its own");
}

template <typename Message, typename OnMessage>
ros::Subscriber subscribe_to(ros::NodeHandle& node, const std::string& topic,
                             const OnMessage& on_message) {
  require_valid(topic);
  ros::Subscriber subscriber = node.subscribe<Message>(
      topic, kCommandQueue, on_message, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  if (!subscriber) throw Error("topic " + topic + " is already subscribed to with another type");
  return subscriber;
}

}  // namespace

bool RobotTopics::Route::has_listeners() const {
  return publisher ? publisher.getNumSubscribers() > 0 : pictures->has_listeners();
}

RobotTopics::Route RobotTopics::advertise(Output& output, const Robot& robot) {
  require_valid(output.topic);
  Route route{&output, &robot, "", false, {}, nullptr};
  if (is_picture(output)) {
    const image_transport::Publisher pictures = images_.advertise(output.topic, kImageQueue);
    if (pictures) route.pictures = std::make_unique<PictureSender>(pictures, kImageQueue);
  } else {
    route.publisher =
        advertise_kind(node_, output, std::make_index_sequence<std::variant_size_v<Reading>>());
  }
  if (!route.publisher && !route.pictures) {
    throw Error("topic " + output.topic + " is already published with another type");
  }
  return route;
}

ros::Subscriber RobotTopics::subscribe(const Input& input) {
  const auto on_message =
      [input, complaint = Complaint()](const geometry_msgs::Twist::ConstPtr& message) mutable {
        const Twist command = from_ros(*message);
        if (is_finite(command)) {
          input.on_command(command);
        } else {
          complaint.say(input.topic + ": found a command that is not finite; it is ignored");
        }
      };
  return subscribe_to<geometry_msgs::Twist>(node_, input.topic, on_message);
}

ros::Subscriber RobotTopics::subscribe(const NumberInput& input) {
  const auto on_message =
      [input, complaint = Complaint()](const std_msgs::Float64::ConstPtr& message) mutable {
        if (message->data >= input.low && message->data <= input.high) {
          input.on_number(message->data);
        } else {
          std::ostringstream text;
          text << input.topic << ": found " << message->data << ", expected a number in ["
               << input.low << ", " << input.high << "]; it is ignored";
          complaint.say(text.str());
        }
      };
  return subscribe_to<std_msgs::Float64>(node_, input.topic, on_message);
}

ros::Subscriber RobotTopics::subscribe(const WrenchInput& input) {
  const auto on_message =
      [input, complaint = Complaint()](const geometry_msgs::Wrench::ConstPtr& message) mutable {
        try {
          input.on_wrench(from_ros(*message));
        } catch (const Error& error) {
          complaint.say(std::string(error.what()) + "; it is ignored");
        }
      };
  return subscribe_to<geometry_msgs::Wrench>(node_, input.topic, on_message);
}

void RobotTopics::add(Device& device, const Robot& robot, Topics& topics) {
  for (const Service& service : device.services()) require_valid(service.name);
  for (const Trigger& trigger : device.triggers()) require_valid(trigger.topic);
  std::vector<Route> routes;
  std::vector<ros::Subscriber> subscribers;
  const auto& outputs = device.outputs();
  const bool is_camera = std::any_of(outputs.begin(), outputs.end(), is_picture);
  for (Output& output : device.outputs()) {
    routes.push_back(advertise(output, robot));
    routes.back().sensor = sensor_name(device, robot);
    routes.back().is_camera = is_camera;
  }
  for (const Input& input : device.inputs()) subscribers.push_back(subscribe(input));
  for (const NumberInput& input : device.number_inputs()) subscribers.push_back(subscribe(input));
  for (const WrenchInput& input : device.wrench_inputs()) subscribers.push_back(subscribe(input));
  topics.services->add(device);
  std::move(routes.begin(), routes.end(), std::back_inserter(topics.routes));
  std::move(subscribers.begin(), subscribers.end(), std::back_inserter(topics.subscribers));
}

void RobotTopics::add(Entity& entity) {
  Topics topics;
  topics.services = std::make_unique<DeviceServices>(node_);
  std::set<const Device*> left_out;
  for (const auto& device : entity.devices) {
    try {
      add(*device, *entity.robot, topics);
    } catch (const Error& error) {
      const Error placed(entity.robot->model().source,
                         "plugin '" + device->name() + "': " + error.what());
      if (!device->is_dispensable()) throw placed;
      log_.error(std::string(placed.what()) + "; it is left out");
      left_out.insert(device.get());
    }
  }
  auto& devices = entity.devices;
  devices.erase(std::remove_if(devices.begin(), devices.end(),
                               [&](const auto& device) { return left_out.count(device.get()); }),
                devices.end());
  warn_of_taken(topics.services->taken(), *entity.robot, log_);
  const Topics& kept = topics_[entity.name()] = std::move(topics);
  for (const Route& route : kept.routes) routes_[route.output] = &route;
}

void RobotTopics::remove(const std::string& entity_name) {
  const auto found = topics_.find(entity_name);
  if (found == topics_.end()) return;
  for (const Route& route : found->second.routes) routes_.erase(route.output);
  topics_.erase(found);
  frames_.forget(entity_name);
}

void RobotTopics::update_demand() {
  for (const auto& [name, topics] : topics_) {
    for (const Route& route : topics.routes) {
      route.output->demanded =
          always_demanded(*route.output) || route.output->latched || route.has_listeners();
    }
  }
}

void RobotTopics::count(const Route& route, TimeNs now_ns) {
  if (route.sensor.empty() || !metrics_.has_listeners()) return;
  metrics_.on_measured(route.sensor, route.is_camera, now_ns);
}

void RobotTopics::on_reading(const Output& output, const Reading& reading) {
  const auto found = routes_.find(&output);
  if (found == routes_.end()) return;
  const Route& route = *found->second;
  std::visit(
      [&](const auto& measured) {
        frames_.on_reading(*route.robot, measured);
        count(route, measured.header.stamp_ns);
        if (!output.latched && !route.has_listeners()) return;
        if (route.publisher) {
          route.publisher.publish(to_message(measured));
        } else if constexpr (std::is_same_v<std::decay_t<decltype(measured)>, ImageReading>) {
          route.pictures->send(boost::make_shared<sensor_msgs::Image>(to_message(measured)));
        }
      },
      reading);
}

}  // namespace ardee::node
