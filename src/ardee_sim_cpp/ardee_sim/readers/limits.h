// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ardee {

/// Files of a newer SDF version are read as this one.
constexpr double kNewestSdf = 1.7;
/// Lengths, masses and the like above this are taken for mistakes (metres, kilograms, ...).
constexpr double kAbsurd = 1e9;
/// Of one instance of a model.
constexpr double kMaxScale = 1e6;
constexpr int kMaxLabel = 65535;
/// Models of all <population>s of a world: a line of text asks for as many as it likes.
constexpr int kMaxPopulation = 1'000'000;
/// Static models in a world, at any depth.
constexpr std::size_t kMaxPlacements = 20'000'000;

}  // namespace ardee
