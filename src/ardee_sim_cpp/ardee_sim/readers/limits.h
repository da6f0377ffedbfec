// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ardee {

/// Lengths, masses and the like above this are taken for mistakes (metres, kilograms, ...).
constexpr double kAbsurd = 1e9;
/// Of one instance of a model.
constexpr double kMaxScale = 1e6;
constexpr int kMaxLabel = 65535;
/// Models of all <population>s of a world: a line of text asks for as many as it likes.
constexpr int kMaxPopulation = 1'000'000;
/// Static models in a world, at any depth; each takes some 250 bytes.
constexpr std::size_t kMaxPlacements = 2'000'000;
/// Links of a model that moves, and of all such models of a world.
constexpr std::size_t kMaxLinks = 100'000;
/// Of a file of a world, a model or a robot.
constexpr std::size_t kMaxXmlBytes = std::size_t{1} << 30;
/// Of one model with all that is merged into it.
constexpr std::size_t kMaxModelBytes = std::size_t{1} << 28;

}  // namespace ardee
