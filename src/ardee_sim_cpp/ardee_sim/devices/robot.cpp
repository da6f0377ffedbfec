// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/robot.h"

#include <algorithm>

#include "ardee_sim/core/nearest_names.h"

namespace ardee::devices {
namespace {

/// Finds an item by its name, within the plugin's scope or the model, or with the robot's name
/// before it, as Gazebo does.
template <typename Item>
std::size_t index_of(const std::vector<Item>& items, const std::string& name, const char* what,
                     const Source& source, const std::string& scope, const std::string& robot) {
  const std::string prefix = robot + "::";
  const bool is_prefixed = name.compare(0, prefix.size(), prefix) == 0;
  const std::string inner = is_prefixed ? name.substr(prefix.size()) : name;
  for (const std::string& full_name : {scope + name, name, inner}) {
    const auto found = std::find_if(items.begin(), items.end(), [&full_name](const Item& item) {
      return item.name == full_name;
    });
    if (found != items.end()) return static_cast<std::size_t>(found - items.begin());
  }
  std::vector<std::string> known;
  for (const Item& item : items) known.push_back(item.name);
  throw Error(source, "found " + std::string(what) + " '" + name +
                          "', expected one of: " + nearest_names(name, known) +
                          (known.empty() ? ", as the model has none" : ""));
}

}  // namespace

physics::PhysicsModel& Robot::dynamics() const {
  if (!dynamics_)
    throw Error(model_->source, "model '" + name_ + "' is static, expected one that moves");
  return *dynamics_;
}

Pose Robot::link_pose(std::size_t link) const {
  return dynamics_ ? dynamics_->link_pose(link) : fixed_pose_ * model_->links[link].X_ML;
}

Twist Robot::link_twist(std::size_t link) const {
  return dynamics_ ? dynamics_->link_twist(link) : Twist{};
}

Twist Robot::twist() const {
  if (!dynamics_) return {};
  const auto& links = model_->links;
  std::size_t link = links.size() - 1;
  while (link > 0 && links[link].name != model_->canonical_link) --link;
  Twist twist_W = link_twist(link);
  twist_W.linear += twist_W.angular.cross(pose().p - link_pose(link).p);
  return twist_W;
}

Twist Robot::planar_twist() const {
  const Twist twist_W = twist();
  const double yaw = rpy_from_quaternion(pose().q).z();
  const Eigen::AngleAxisd to_heading(-yaw, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d level(twist_W.linear.x(), twist_W.linear.y(), 0.0);
  return {to_heading * level, {0.0, 0.0, twist_W.angular.z()}};
}

std::size_t Robot::link_index(const std::string& link_name, const Source& source,
                              const std::string& scope) const {
  return index_of(model_->links, link_name, "link", source, scope, name_);
}

std::size_t Robot::joint_index(const std::string& joint_name, const Source& source,
                               const std::string& scope) const {
  return index_of(model_->joints, joint_name, "joint", source, scope, name_);
}

}  // namespace ardee::devices
