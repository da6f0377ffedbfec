// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/devices/reading_header.h"
#include "ardee_sim/physics/contact.h"

namespace ardee::devices {

/// Contacts of a sensor's collisions since the previous reading. Vectors have the world's axes,
/// positions are in the world, torques are about the first body's centre of mass.
struct ContactsReading {
  /// Two collisions that touched in a step; the first is the sensor's.
  struct Touch {
    TimeNs time_ns = 0;
    std::string collision1;
    std::string collision2;
    std::vector<physics::Contact> points;

    void serialize(StateArchive& state) { state(time_ns, collision1, collision2, points); }
  };
  Header header;
  std::vector<Touch> touches;
};

/// A force and a torque about the origin of header.frame_id (geometry_msgs/WrenchStamped).
struct WrenchReading {
  Header header;
  physics::ForceTorque wrench;
};

}  // namespace ardee::devices
