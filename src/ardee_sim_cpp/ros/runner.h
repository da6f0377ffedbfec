// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "ardee_sim/simulation/simulation.h"
#include "ros/clock_publisher.h"
#include "ros/odometry_frames.h"
#include "ros/pacer.h"
#include "ros/robot_topics.h"
#include "ros/state_topics.h"

namespace ardee::node {

/// Listeners that are informed of each step.
struct StepListeners {
  RobotTopics& robots;
  StateTopics& states;
  ClockPublisher& clock;
  OdometryFrames& frames;
};

/// Advances simulated time: at its pace, by single steps, or not at all. Services and commands act
/// between steps, all in one thread.
class Runner {
 public:
  /// `chores` is called a few times per second of wall time, also while paused.
  Runner(Simulation& simulation, const StepListeners& outlets, std::function<void()> chores);

  /// Runs until ROS shuts down.
  void run();

  bool paused() const { return paused_; }
  void set_paused(bool paused);
  /// Takes steps while paused and returns how many were taken: fewer than asked for if the node is
  /// shut down or unpaused meanwhile. Throws Error if not paused, or if called from within itself.
  std::uint32_t advance(std::uint32_t steps);
  void reset_world();
  void reset_simulation();
  /// Called when the world's physics changed: its update rate sets the pace.
  void follow_physics();

 private:
  using Clock = std::chrono::steady_clock;

  void step();
  void wait_for_pace();
  /// Serves the services and commands that wait, or arrive within `timeout_s`.
  void serve(double timeout_s);

  Simulation& simulation_;
  StepListeners outlets_;
  std::function<void()> chores_;
  Clock::time_point next_chores_ = Clock::now();
  Pacer pacer_;
  bool paused_ = false;
  bool advancing_ = false;
};

}  // namespace ardee::node
