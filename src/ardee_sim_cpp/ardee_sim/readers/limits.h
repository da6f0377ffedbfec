// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ardee {

/// Limit for one instance of a model.
constexpr double kMaxScale = 1e6;
constexpr int kMaxLabel = 65535;
/// Models of all <population>s of a world: one line of text can ask for any number.
constexpr int kMaxPopulation = 1'000'000;
/// Static models in a world, at any depth; each takes some 250 bytes.
constexpr std::size_t kMaxPlacements = 2'000'000;
/// Number of links of a moving model, and of all moving models of a world.
constexpr std::size_t kMaxLinks = 100'000;
/// Size of a file of a world, a model or a robot.
constexpr std::size_t kMaxXmlBytes = std::size_t{1} << 30;
/// Size of one model with all models merged into it.
constexpr std::size_t kMaxModelBytes = std::size_t{1} << 28;

}  // namespace ardee
