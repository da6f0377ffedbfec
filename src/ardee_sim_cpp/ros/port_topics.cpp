// SPDX-License-Identifier: MIT
#include "ros/port_topics.h"

#include <algorithm>
#include <utility>

#include "ardee_sim/core/error.h"
#include "ros/command_subscription.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kOutputQueue = 100;  // messages come in bursts if faster than real time
constexpr std::uint32_t kImageQueue = 5;     // a picture is large

template <std::size_t kKind>
using MessageOf =
    decltype(to_message(std::declval<std::variant_alternative_t<kKind, devices::Reading>>()));

template <std::size_t... kKinds>
ros::Publisher advertise_kind(ros::NodeHandle& node, const devices::Output& output,
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

bool is_picture(const devices::Output& output) {
  return output.kind == devices::reading_kind<devices::ImageReading>();
}

}  // namespace

bool Route::has_listeners() const {
  return publisher ? publisher.getNumSubscribers() > 0 : pictures->has_listeners();
}

PortTopics::PortTopics(const ros::NodeHandle& node, devices::Ports& ports,
                       const devices::Robot& robot, const std::string& sensor, Routes& routes)
    : node_(node), ports_(ports), routes_(routes), services_(node) {
  std::vector<Route> made;
  ports.visit([&](devices::Output& output) { made.push_back(advertise(output, robot)); },
              [&](const devices::Input& input) { subscribers_.push_back(subscribe(node_, input)); },
              [&](const devices::Service& service) { services_.add(service); },
              [&](const devices::ParameterGroup& tuning) { services_.add(tuning); },
              [&](const devices::Action& action) { actions_.add(node_, action); });
  const bool is_camera = std::any_of(made.begin(), made.end(),
                                     [](const Route& route) { return is_picture(*route.output); });
  for (Route& route : made) {
    route.sensor = sensor;
    route.is_camera = is_camera;
    const devices::Output* output = route.output;
    routes_.emplace(output, std::move(route));
  }
}

PortTopics::~PortTopics() {
  for (const devices::Output& output : ports_.all<devices::Output>()) routes_.erase(&output);
}

Route PortTopics::advertise(devices::Output& output, const devices::Robot& robot) {
  require_valid(output.topic);
  Route route{&output, &robot, "", false, {}, nullptr};
  if (is_picture(output)) {
    const image_transport::Publisher pictures = images_.advertise(output.topic, kImageQueue);
    if (pictures) route.pictures = std::make_unique<PictureSender>(pictures, kImageQueue);
  } else {
    route.publisher = advertise_kind(
        node_, output, std::make_index_sequence<std::variant_size_v<devices::Reading>>());
  }
  if (!route.publisher && !route.pictures) {
    throw Error("topic " + output.topic + " is already published with another type");
  }
  return route;
}

void warn_of_taken(const std::vector<std::string>& services, const devices::Robot& robot,
                   Log& log) {
  if (services.empty()) return;
  const std::size_t others = services.size() - 1;
  log.warn(robot.model().source.to_string() + ": service " + services.front() +
           (others > 0 ? " and " + std::to_string(others) + " more are" : " is") +
           " there already and " + (others > 0 ? "stay what they were" : "stays what it was") +
           "; a namespace of its own gives a robot its own");
}

}  // namespace ardee::node
