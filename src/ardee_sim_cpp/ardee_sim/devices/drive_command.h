// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"

namespace ardee::devices {

/// The command that a drive follows. The last one holds, as in the stock plugins, unless a timeout
/// is set.
class DriveCommand {
 public:
  /// 0: no timeout.
  explicit DriveCommand(double timeout_s) : timeout_s_(timeout_s) {}

  void set(const Twist& command) {
    command_ = command;
    is_new_ = true;
  }
  const Twist& at(TimeNs now_ns) {
    if (is_new_) {
      is_new_ = false;
      time_ns_ = now_ns;
    }
    if (timeout_s_ > 0.0 && now_ns - time_ns_ > nanoseconds(timeout_s_)) command_ = Twist{};
    return command_;
  }
  void reset(TimeNs now_ns) {
    command_ = Twist{};
    is_new_ = false;
    time_ns_ = now_ns;
  }
  void serialize(StateArchive& state) { state(command_, is_new_, time_ns_); }

 private:
  double timeout_s_;
  Twist command_;
  bool is_new_ = false;
  TimeNs time_ns_ = 0;
};

}  // namespace ardee::devices
