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

/// What is told of each step.
struct StepListeners {
  RobotTopics& robots;
  StateTopics& states;
  ClockPublisher& clock;
  OdometryFrames& frames;
};

/// Lets simulated time pass: at its pace, by single steps, or not at all. Services and commands act
/// between steps, all in one thread.
class Runner {
 public:
  /// `chores` is called a few times a second of wall time, also while paused.
  Runner(Simulation& simulation, const StepListeners& outlets, std::function<void()> chores);

  /// Until ROS shuts down.
  void run();

  bool paused() const { return paused_; }
  void set_paused(bool paused);
  /// Takes steps while paused and returns how many were taken: fewer than asked for if the node is
  /// shut down or unpaused meanwhile. Throws Error if not paused, or called from within itself.
  std::uint32_t advance(std::uint32_t steps);
  void reset_world();
  void reset_simulation();
  /// The world's physics changed: its update rate sets the pace.
  void follow_physics();

 private:
  using Clock = std::chrono::steady_clock;

  void step();
  void wait_for_pace();
  /// Services and commands that are there, or arrive within `timeout_s`.
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
