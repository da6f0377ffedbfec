// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {
namespace {

/// A box, or the upright cylinder within it.
struct Region {
  Eigen::Vector3d size_m;
  bool is_round = false;

  /// The position for three numbers in [0, 1], uniform by volume.
  Eigen::Vector3d at(const Eigen::Vector3d& shares) const {
    Eigen::Vector3d place = shares.array() - 0.5;
    if (is_round) {
      const double radius = 0.5 * std::sqrt(shares.x());
      const double turn = 2.0 * M_PI * shares.y();
      place.head<2>() << radius * std::cos(turn), radius * std::sin(turn);
    }
    return place.cwiseProduct(size_m);
  }
};

Region read_region(const Node& population) {
  const auto box = population.child("box");
  const auto cylinder = population.child("cylinder");
  if (box.has_value() == cylinder.has_value()) {
    throw population.error(box ? "found <box> and <cylinder>, expected one of them"
                               : "found no <box> and no <cylinder>, expected one");
  }
  if (cylinder) {
    const double width_m = 2.0 * cylinder->number("radius", 1.0, 0.0);
    return {{width_m, width_m, cylinder->number("length", 1.0, 0.0)}, true};
  }
  const Eigen::Vector3d size_m = box->vector3("size", Eigen::Vector3d::Ones());
  if (size_m.minCoeff() < 0.0) throw box->error("found a size below 0 m, expected 0 or more");
  return {size_m, false};
}

/// Radical inverse of a number: its digits to a base in reverse, behind the point.
double mirrored(int number, int base) {
  double share = 0.0;
  for (double digit = 1.0 / base; number > 0; number /= base, digit /= base) {
    share += digit * (number % base);
  }
  return share;
}

std::vector<Eigen::Vector3d> in_grid(const Node& distribution) {
  const int rows = distribution.integer("rows", 1, 1, kMaxPopulation);
  const int columns = distribution.integer("cols", 1, 1, kMaxPopulation / rows);
  const Eigen::Vector3d step_m = distribution.vector3("step", {0.5, 0.5, 0.0});
  std::vector<Eigen::Vector3d> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back((column - 0.5 * (columns - 1)) * step_m.x(),
                          (row - 0.5 * (rows - 1)) * step_m.y(), 0.0);
    }
  }
  return places;
}

}  // namespace

std::vector<Eigen::Vector3d> read_population(const Node& population) {
  const Region region = read_region(population);
  const Node distribution = population.required("distribution");
  const Node type = distribution.required("type");
  const std::string how = type.required_text();
  if (how == "grid") return in_grid(distribution);
  const int count = population.integer("model_count", 1, 1, kMaxPopulation);
  const CounterRng random(stream_key(0, "population " + population.required_attribute("name")));
  const auto fill = [&](const auto& shares_of) {
    std::vector<Eigen::Vector3d> places;
    for (int k = 0; k < count; ++k) places.push_back(region.at(shares_of(k)));
    return places;
  };
  const auto draw = [&](int k) {
    const auto first = 3 * static_cast<std::uint64_t>(k);
    return Eigen::Vector3d(random.uniform(first), random.uniform(first + 1),
                           random.uniform(first + 2));
  };
  if (how == "random") return fill(draw);
  if (how == "uniform") {
    // Halton, On the Efficiency of Certain Quasi-Random Sequences of Points, 1960; shifted.
    const Eigen::Vector3d shift = draw(0);
    return fill([&](int k) {
      const Eigen::Vector3d sum =
          shift + Eigen::Vector3d(mirrored(k, 2), mirrored(k, 3), mirrored(k, 5));
      return Eigen::Vector3d(sum.array() - sum.array().floor());
    });
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (how != std::string("linear-") + "xyz"[axis]) continue;
    std::vector<Eigen::Vector3d> places;
    for (int k = 0; k < count; ++k) {
      const double share = count > 1 ? static_cast<double>(k) / (count - 1) - 0.5 : 0.0;
      places.push_back(share * region.size_m[axis] * Eigen::Vector3d::Unit(axis));
    }
    return places;
  }
  throw type.error("found '" + how +
                   "', expected random, uniform, grid, linear-x, linear-y or linear-z");
}

}  // namespace ardee
