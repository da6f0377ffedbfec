// SPDX-License-Identifier: MIT
#include "ardee_sim/description/shape_fault.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

using Fault = std::optional<ShapeFault>;

constexpr double kShortestNormal = 1e-9;
constexpr const char* kPositive = "a positive number";

bool is_positive(double size) { return std::isfinite(size) && size > 0.0; }

template <typename Vector>
bool are_positive(const Vector& sizes) {
  return sizes.allFinite() && sizes.minCoeff() > 0.0;
}

bool is_complete(const HeightGrid& grid) {
  return grid.columns >= 2 && grid.rows >= 2 &&
         grid.heights_m.size() ==
             static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows) &&
         std::all_of(grid.heights_m.begin(), grid.heights_m.end(),
                     [](float height_m) { return std::isfinite(height_m); });
}

struct FindFault {
  Fault operator()(const Box& box) const {
    if (are_positive(box.size_m)) return {};
    return ShapeFault{"size", "three positive numbers"};
  }
  Fault operator()(const Sphere& sphere) const {
    if (is_positive(sphere.radius_m)) return {};
    return ShapeFault{"radius", kPositive};
  }
  Fault operator()(const Cylinder& cylinder) const {
    if (!is_positive(cylinder.radius_m)) return ShapeFault{"radius", kPositive};
    if (!is_positive(cylinder.length_m)) return ShapeFault{"length", kPositive};
    return {};
  }
  Fault operator()(const Plane& plane) const {
    if (!plane.normal.allFinite() || plane.normal.norm() <= kShortestNormal) {
      return ShapeFault{"normal", "a direction"};
    }
    if (!are_positive(plane.size_m)) return ShapeFault{"size", "two positive numbers"};
    return {};
  }
  Fault operator()(const Mesh& mesh) const {
    if (!mesh.file) return ShapeFault{"uri", "a mesh that is loaded"};
    if (!mesh.scale.allFinite() || mesh.scale.cwiseAbs().minCoeff() <= 0.0) {
      return ShapeFault{"scale", "three numbers other than zero"};
    }
    return {};
  }
  Fault operator()(const Heightmap& heightmap) const {
    if (!heightmap.grid || !is_complete(*heightmap.grid)) {
      return ShapeFault{"uri", "at least 2 x 2 heights that are finite"};
    }
    if (!are_positive(heightmap.grid->size_m)) return ShapeFault{"size", "positive x and y"};
    return {};
  }
};

}  // namespace

std::string ShapeFault::message() const {
  return "found an invalid " + std::string(field) + ", expected " + expected;
}

std::optional<ShapeFault> find_fault(const Geometry& geometry) {
  return std::visit(FindFault{}, geometry);
}

}  // namespace ardee
