// SPDX-License-Identifier: MIT
#pragma once

#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "ardee_sim/simulation/simulation.h"
#include "ros/far_plants.h"
#include "ros/marker_shapes.h"

namespace ardee::node {

/// /ardee/scenery: the static models near the moving ones, for rviz; latched, frame `world`.
/// Without a moving model, those near the point that the world's camera looks at. It costs nothing
/// without subscribers. With `show_collisions`, collision bodies are in namespaces of their own.
class SceneryMarkers {
 public:
  SceneryMarkers(const Simulation& simulation, double radius_m, bool show_collisions);

  /// Publishes anew if a model has moved far enough or the scenery has changed.
  void update();

 private:
  using MarkerId = std::pair<std::string, int>;
  struct Standing {
    std::uint32_t entity = 0;
    Pose pose;
  };

  std::vector<Eigen::Vector3d> eyes() const;
  Eigen::Vector3d default_eye() const;
  bool eyes_moved(const std::vector<Eigen::Vector3d>& eyes) const;
  bool scenery_changed();
  void publish();
  void append(const Entity& entity, visualization_msgs::MarkerArray& message);
  void append_shape(const MarkerShape& shape, const Placement& placement, const MarkerId& id,
                    visualization_msgs::MarkerArray& message);
  void append_shapes(const Entity& entity, bool collisions,
                     visualization_msgs::MarkerArray& message);
  const std::vector<MarkerShape>& shapes_of(const std::shared_ptr<const Model>& model,
                                            bool collisions);

  const Simulation& simulation_;
  double radius_m_;
  bool show_collisions_;
  ros::Publisher publisher_;
  std::vector<Eigen::Vector3d> eyes_;
  std::vector<Standing> standing_;
  std::set<MarkerId> shown_;
  std::map<std::pair<std::shared_ptr<const Model>, bool>, std::vector<MarkerShape>> shapes_;
  FarPlants far_plants_;
  visualization_msgs::Marker far_;  // of the entity that is being appended
};

}  // namespace ardee::node
