// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "ardee_sim/core/limits.h"

/// Ranges of the numbers that the physics can simulate, in SI units. Readers refuse a file with
/// other numbers and name the place; the physics refuses such numbers from other sources.
namespace ardee::bounds {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Range {
  double low;
  double high;
  /// False for NaN, too.
  constexpr bool holds(double value) const { return value >= low && value <= high; }
};

// Surfaces. ODE itself accepts infinite friction and stiffness.
constexpr Range kFriction{0.0, kInfinity};
constexpr Range kSlip{0.0, limits::kAbsurd};
constexpr Range kRadius_m{0.0, limits::kAbsurd};
constexpr Range kStiffness{0.0, kInfinity};
constexpr Range kDamping{0.0, kInfinity};
constexpr Range kMinDepth{-limits::kAbsurd, limits::kAbsurd};  // not positive: not set
constexpr Range kMaxVelocity{-limits::kAbsurd, kInfinity};     // negative: unlimited
constexpr Range kRestitution{0.0, 1.0};
constexpr Range kBounceThreshold{0.0, kInfinity};

// Links.
constexpr Range kDecay{0.0, 1.0};

// Joint axes.
constexpr Range kJointCoefficient{0.0, limits::kAbsurd};  // damping, friction, stiffness
constexpr Range kJointReference{-limits::kAbsurd, limits::kAbsurd};
// ERP and CFM; negative: the world's.
constexpr Range kJointSoftness{-limits::kAbsurd, limits::kAbsurd};

// Worlds.
constexpr Range kStep_s{1e-6, 1.0};
constexpr Range kUpdateRate_hz{0.0, limits::kMostRate_hz};  // 0: as fast as possible
constexpr Range kMaxContacts{1.0, 1e6};
constexpr Range kIterations{1.0, 100000.0};
constexpr Range kRelaxation{1e-6, 2.0};
constexpr Range kCfm{0.0, 1e6};
constexpr Range kErp{0.0, 1.0};
constexpr Range kCorrectingVelocity{0.0, kInfinity};
constexpr Range kSurfaceLayer_m{0.0, limits::kAbsurd};

}  // namespace ardee::bounds
