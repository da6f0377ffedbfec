// SPDX-License-Identifier: MIT
#include <ardee_msgs/SetLight.h>
#include <gazebo_msgs/DeleteLight.h>
#include <gazebo_msgs/GetLightProperties.h>
#include <gazebo_msgs/SetLightProperties.h>

#include "ardee_sim/core/limits.h"
#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

constexpr double kMostAttenuation = 1e9;
constexpr double kLongest = 1e9;  // bound of a direction's length, which has no meaning

const Light& require_light(const ServiceContext& context, const std::string& name) {
  for (const Light& light : context.simulation.lights()) {
    if (light.name == name) return light;
  }
  throw Error("Requested light " + name + " not found!");
}

std_msgs::ColorRGBA to_ros(const Color& color) {
  std_msgs::ColorRGBA message;
  message.r = color[0];
  message.g = color[1];
  message.b = color[2];
  message.a = color[3];
  return message;
}

Color checked_color(const char* field, const std_msgs::ColorRGBA& message) {
  const Color color(message.r, message.g, message.b, message.a);
  for (const float channel : color) checked(field, static_cast<double>(channel), 0.0, 1.0);
  return color;
}

std::string get_light(ServiceContext& context, const std::string& name,
                      gazebo_msgs::GetLightPropertiesResponse& response) {
  const Light& light = require_light(context, name);
  response.diffuse = to_ros(light.diffuse);
  response.attenuation_constant = light.attenuation_constant;
  response.attenuation_linear = light.attenuation_linear;
  response.attenuation_quadratic = light.attenuation_quadratic;
  return "GetLightProperties: got properties";
}

bool is_filled_in(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0;
}

/// A script older than the fields for shadows, specular colour, direction and pose leaves them
/// empty. An empty direction and pose are invalid for a light, so all four keep their values then.
std::string set_light(ServiceContext& context,
                      const gazebo_msgs::SetLightPropertiesRequest& request) {
  Light light = require_light(context, request.light_name);
  light.diffuse = checked_color("diffuse", request.diffuse);
  light.attenuation_constant =
      checked("attenuation_constant", request.attenuation_constant, 0.0, kMostAttenuation);
  light.attenuation_linear =
      checked("attenuation_linear", request.attenuation_linear, 0.0, kMostAttenuation);
  light.attenuation_quadratic =
      checked("attenuation_quadratic", request.attenuation_quadratic, 0.0, kMostAttenuation);
  const Color specular = checked_color("specular", request.specular);
  const Eigen::Vector3d direction = from_ros(request.direction);
  for (const double part : direction) checked("direction", part, -kLongest, kLongest);
  const Pose pose = from_ros(request.pose);
  for (const double part_m : pose.p) {
    checked("pose", part_m, -limits::kFarthest_m, limits::kFarthest_m);
  }
  const bool has_direction = direction.norm() > 0.0;
  if (has_direction) light.direction = direction.normalized();
  if (is_filled_in(request.pose)) light.pose = pose;
  if (has_direction || is_filled_in(request.pose)) {
    light.specular = specular;
    light.cast_shadows = request.cast_shadows;
  }
  context.simulation.set_light(light);
  return "SetLightProperties: light set";
}

}  // namespace

void add_light_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::GetLightProperties>("get_light_properties", "GetLightProperties",
                                               [&context](const auto& request, auto& response) {
                                                 return get_light(context, request.light_name,
                                                                  response);
                                               });
  servers.add<gazebo_msgs::SetLightProperties>(
      "set_light_properties", "SetLightProperties",
      [&context](const auto& request, auto&) { return set_light(context, request); });
  servers.add<gazebo_msgs::DeleteLight>(
      "delete_light", "DeleteLight", [&context](const auto& request, auto&) {
        require_light(context, request.light_name);
        context.simulation.remove_light(request.light_name);
        return "DeleteLight: " + request.light_name + " successfully deleted";
      });
  servers.add<ardee_msgs::SetLight>(
      "/ardee/set_light", "SetLight", [&context](const auto& request, auto&) {
        context.simulation.set_daylight(
            {request.azimuth_deg, request.elevation_deg, request.turbidity, request.cloud});
        return "SetLight: light of sun and sky set";
      });
}

}  // namespace ardee::node
