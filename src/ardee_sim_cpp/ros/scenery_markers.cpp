// SPDX-License-Identifier: MIT
#include "ros/scenery_markers.h"

#include <ros/node_handle.h>

#include <algorithm>
#include <limits>

#include "ardee_sim/description/collision_bodies.h"
#include "ros/conversions.h"
#include "ros/ground_marker.h"

namespace ardee::node {
namespace {

using visualization_msgs::Marker;

constexpr double kMove_m = 1.5;  // motion of a model after which the markers are renewed
constexpr double kFine_m = 1.5;  // plants farther than this from all models are drawn coarsely
constexpr char kFrame[] = "world";
constexpr char kFar[] = " (far)";  // suffix of an entity's name: the marker of its far plants
constexpr char kCollisions[] = " (collision)";  // suffix: the markers of collision bodies

}  // namespace

SceneryMarkers::SceneryMarkers(const Simulation& simulation, double radius_m, bool show_collisions)
    : simulation_(simulation), radius_m_(radius_m), show_collisions_(show_collisions) {
  publisher_ =
      ros::NodeHandle().advertise<visualization_msgs::MarkerArray>("/ardee/scenery", 1, true);
}

void SceneryMarkers::update() {
  if (publisher_.getNumSubscribers() == 0) return;
  const bool changed = scenery_changed();
  std::vector<Eigen::Vector3d> now = eyes();
  if (!changed && !eyes_moved(now)) return;
  if (changed) shapes_.clear();
  eyes_ = std::move(now);
  publish();
}

std::vector<Eigen::Vector3d> SceneryMarkers::eyes() const {
  std::vector<Eigen::Vector3d> eyes;
  for (const auto& entity : simulation_.entities()) {
    if (!entity->is_static()) eyes.push_back(entity->robot->pose().p);
  }
  if (eyes.empty()) eyes.push_back(default_eye());
  return eyes;
}

Eigen::Vector3d SceneryMarkers::default_eye() const {
  constexpr double kFarthest_m = 50.0;
  if (const auto& camera = simulation_.world().gui_camera) {
    const Eigen::Vector3d view = camera->q * Eigen::Vector3d::UnitX();
    const double distance_m = view.z() < 0.0 ? -camera->p.z() / view.z() : 0.0;
    const bool materials_down = distance_m > 0.0 && distance_m < kFarthest_m;
    return materials_down ? Eigen::Vector3d(camera->p + distance_m * view) : camera->p;
  }
  Eigen::AlignedBox3d bounds;
  for (const auto& entity : simulation_.entities()) {
    for (const Placement& placement : entity->placements) bounds.extend(placement.X_WM.p);
  }
  return bounds.isEmpty() ? Eigen::Vector3d::Zero().eval() : bounds.center().eval();
}

bool SceneryMarkers::eyes_moved(const std::vector<Eigen::Vector3d>& eyes) const {
  if (eyes.size() != eyes_.size()) return true;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    if ((eyes[i] - eyes_[i]).head<2>().norm() > kMove_m) return true;
  }
  return false;
}

bool SceneryMarkers::scenery_changed() {
  std::vector<Standing> standing;
  for (const auto& entity : simulation_.entities()) {
    if (!entity->is_static()) continue;
    standing.push_back({entity->robot->entity(), entity->robot->pose()});
  }
  const auto same = [](const Standing& a, const Standing& b) {
    return a.entity == b.entity && a.pose.p == b.pose.p && a.pose.q.coeffs() == b.pose.q.coeffs();
  };
  const bool changed =
      !std::equal(standing.begin(), standing.end(), standing_.begin(), standing_.end(), same);
  standing_ = std::move(standing);
  return changed;
}

void SceneryMarkers::publish() {
  visualization_msgs::MarkerArray message;
  for (const auto& entity : simulation_.entities()) {
    if (entity->is_static()) append(*entity, message);
  }
  std::set<MarkerId> shown;
  for (const Marker& marker : message.markers) shown.emplace(marker.ns, marker.id);
  for (const MarkerId& gone : shown_) {
    if (shown.count(gone) > 0) continue;
    Marker marker;
    marker.header.frame_id = kFrame;
    marker.action = Marker::DELETE;
    marker.ns = gone.first;
    marker.id = gone.second;
    message.markers.push_back(marker);
  }
  shown_ = std::move(shown);
  publisher_.publish(message);
}

void SceneryMarkers::append(const Entity& entity, visualization_msgs::MarkerArray& message) {
  far_ = Marker();
  far_.header.frame_id = kFrame;
  far_.ns = entity.name() + kFar;
  far_.type = Marker::TRIANGLE_LIST;
  far_.pose.orientation.w = 1.0;
  far_.scale = to_vector(Eigen::Vector3d::Ones());
  far_.color.a = 1.0f;
  append_shapes(entity, false, message);
  if (!far_.points.empty()) message.markers.push_back(std::move(far_));
  if (show_collisions_) append_shapes(entity, true, message);
}

void SceneryMarkers::append_shapes(const Entity& entity, bool collisions,
                                   visualization_msgs::MarkerArray& message) {
  const std::string name = entity.name() + (collisions ? kCollisions : "");
  int id = 0;  // a placement keeps its ids as long as it exists
  for (const Placement& placement : entity.placements) {
    for (const MarkerShape& shape : shapes_of(placement.model, collisions)) {
      append_shape(shape, placement, {name, id++}, message);
    }
  }
}

void SceneryMarkers::append_shape(const MarkerShape& shape, const Placement& placement,
                                  const MarkerId& id, visualization_msgs::MarkerArray& message) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& eye : eyes_) {
    distance_m = std::min(distance_m, (eye - placement.X_WM.p).head<2>().norm());
  }
  if (!(distance_m <= radius_m_ + placement.scale * shape.reach_m)) return;
  const Pose X_WS = placement.X_WM * Pose{placement.scale * shape.X_MS.p, shape.X_MS.q};
  if (distance_m > kFine_m && !shape.coarse_path.empty()) {
    const Eigen::Vector3d scale = placement.scale * from_ros(shape.marker.scale);
    far_plants_.append(shape.coarse_path, X_WS, scale, far_);
    return;
  }
  Marker marker = shape.marker;
  if (shape.heightmap) {
    append_ground(*shape.heightmap, X_WS, placement.scale, eyes_, radius_m_, marker);
    if (marker.points.empty()) return;
  }
  marker.header.frame_id = kFrame;
  marker.ns = id.first;
  marker.id = id.second;
  marker.action = Marker::ADD;
  marker.pose = to_ros(X_WS);
  marker.scale = to_vector(placement.scale * from_ros(marker.scale));
  message.markers.push_back(std::move(marker));
}

const std::vector<MarkerShape>& SceneryMarkers::shapes_of(const std::shared_ptr<const Model>& model,
                                                          bool collisions) {
  const auto found = shapes_.find({model, collisions});
  if (found != shapes_.end()) return found->second;
  std::vector<MarkerShape>& shapes = shapes_[{model, collisions}];
  shapes = marker_shapes(collisions ? *collision_bodies(*model) : *model);
  if (collisions) {
    for (MarkerShape& shape : shapes) shape.coarse_path.clear();  // it has the plant's colours
  }
  return shapes;
}

}  // namespace ardee::node
