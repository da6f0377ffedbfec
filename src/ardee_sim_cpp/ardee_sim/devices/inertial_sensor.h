// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/devices/inertial_motion.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// Base class of all inertial units: they follow the motion of their mounting through every step. A
/// sample is the mean since the previous sample, as from a unit that integrates between its
/// outputs.
class InertialSensor : public Sensor {
 public:
  InertialSensor(const std::string& name, const Mount& mount,
                 std::function<Eigen::Vector3d()> gravity_m_per_s2)
      : Sensor(name, mount),
        gravity_m_per_s2_(std::move(gravity_m_per_s2)),
        motion_(mount.robot, mount.link, mount.X_LS) {}

  void observe(TimeNs now_ns) override { motion_.begin_step(now_ns); }
  void on_set_state() override { motion_.on_set_state(); }
  void reset(TimeNs now_ns) override {
    Sensor::reset(now_ns);
    motion_.reset(now_ns);
  }
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(motion_);
  }

 protected:
  void follow(TimeNs now_ns) override { motion_.end_step(now_ns, gravity()); }
  /// Always true: errors drift on without subscribers.
  bool wanted() const override { return true; }
  InertialMotion::Mean take_motion() { return motion_.take(); }
  Eigen::Vector3d gravity() const { return gravity_m_per_s2_(); }

 private:
  std::function<Eigen::Vector3d()> gravity_m_per_s2_;
  InertialMotion motion_;
};

}  // namespace ardee::devices
