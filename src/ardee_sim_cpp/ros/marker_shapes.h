// SPDX-License-Identifier: MIT
#pragma once

#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "ardee_sim/description/model.h"

namespace ardee::node {

/// One marker that a description needs, before it is placed.
struct MarkerShape {
  visualization_msgs::Marker marker;  // type, scale, colour, mesh, points; in the shape's frame
  Pose X_MS;                          // shape in the model
  double reach_m = 0.0;               // about the model's origin; infinite: seen from everywhere
  std::string coarse_path;            // mesh file with fewer triangles, for far plants; empty: none
  const Heightmap* heightmap = nullptr;  // set: the marker shows the ground near the models
};

/// The visuals of a model's links as rviz can show them. Visuals that together show all of one mesh
/// file become one mesh marker; a part of a file becomes a list of triangles.
std::vector<MarkerShape> marker_shapes(const Model& model);

/// file:// URI of a path, as resource_retriever wants it.
std::string file_uri(const std::string& path);

}  // namespace ardee::node
