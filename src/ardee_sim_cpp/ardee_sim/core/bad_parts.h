// SPDX-License-Identifier: MIT
#pragma once

namespace ardee {

/// What becomes of a world with a part that is written wrong, cannot be built or needs a file that
/// is not there: the whole is refused, or the part is left out with one error, as Gazebo does.
enum class BadParts { kRefuse, kLeaveOut };

}  // namespace ardee
