// SPDX-License-Identifier: MIT
#include "ros/pacer.h"

namespace ardee::node {
namespace {

constexpr double kLongestLag_s = 0.1;  // of wall time that is made up

}  // namespace

void Pacer::set_factor(double factor, TimeNs now_ns) {
  factor_ = factor;
  restart(now_ns);
}

void Pacer::restart(TimeNs now_ns) {
  anchor_ns_ = now_ns;
  anchor_ = Clock::now();
}

double Pacer::wait_s(TimeNs now_ns) {
  if (factor_ <= 0.0) return 0.0;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - anchor_).count();
  const double wait = seconds(now_ns - anchor_ns_) / factor_ - elapsed_s;
  if (wait < -kLongestLag_s) restart(now_ns);
  return wait;
}

}  // namespace ardee::node
