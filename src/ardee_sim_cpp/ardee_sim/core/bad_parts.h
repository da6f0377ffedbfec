// SPDX-License-Identifier: MIT
#pragma once

namespace ardee {

/// Policy for a world with a part that is malformed, cannot be built or needs a file that is
/// missing: refuse the whole world, or leave the part out with one error, as Gazebo does.
enum class BadParts { kRefuse, kLeaveOut };

}  // namespace ardee
