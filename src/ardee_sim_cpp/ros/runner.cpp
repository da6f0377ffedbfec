// SPDX-License-Identifier: MIT
#include "ros/runner.h"

#include <ros/ros.h>

#include <algorithm>

#include "ros/waiting_callbacks.h"

namespace ardee::node {
namespace {

constexpr double kIdleWait_s = 0.1;  // longest delay until a shutdown is noticed while paused
constexpr auto kChorePeriod = std::chrono::milliseconds(200);

}  // namespace

Runner::Runner(Simulation& simulation, const StepListeners& outlets, std::function<void()> chores)
    : simulation_(simulation), outlets_(outlets), chores_(std::move(chores)) {
  follow_physics();
  outlets_.clock.publish(simulation.now_ns());
}

void Runner::run() {
  while (ros::ok()) {
    if (paused_) {
      serve(kIdleWait_s);
    } else {
      step();
      wait_for_pace();
    }
  }
}

void Runner::serve(double timeout_s) {
  call_waiting(*ros::getGlobalCallbackQueue(), timeout_s);
  if (Clock::now() < next_chores_) return;
  chores_();
  if (paused_) outlets_.clock.publish(simulation_.now_ns());
  next_chores_ = Clock::now() + kChorePeriod;
}

void Runner::wait_for_pace() {
  serve(0.0);
  while (ros::ok() && !paused_) {
    const double wait_s = pacer_.wait_s(simulation_.now_ns());
    if (wait_s <= 0.0) return;
    serve(std::min(wait_s, kIdleWait_s));
  }
}

void Runner::step() {
  outlets_.robots.update_demand();
  try {
    simulation_.step();
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("the simulation is paused: " << error.what());
    set_paused(true);
    return;
  }
  outlets_.clock.on_step(simulation_.now_ns());
  outlets_.states.publish();
}

void Runner::set_paused(bool paused) {
  if (paused_ == paused) return;
  paused_ = paused;
  pacer_.restart(simulation_.now_ns());
  outlets_.clock.publish(simulation_.now_ns());
}

std::uint32_t Runner::advance(std::uint32_t steps) {
  if (!paused_) throw Error("the simulation runs, expected it to be paused (pause_physics)");
  if (advancing_) throw Error("an earlier call is still stepping");
  advancing_ = true;
  std::uint32_t taken = 0;
  while (taken < steps && paused_ && ros::ok()) {
    const std::uint64_t before = simulation_.step_count();
    step();
    if (simulation_.step_count() == before) break;  // it failed and reported the error
    ++taken;
    serve(0.0);
  }
  advancing_ = false;
  outlets_.clock.publish(simulation_.now_ns());
  return taken;
}

void Runner::reset_world() {
  simulation_.reset_world();
  outlets_.frames.restart();
  outlets_.clock.publish(simulation_.now_ns());
}

void Runner::reset_simulation() {
  simulation_.reset_simulation();
  outlets_.frames.restart();
  pacer_.restart(simulation_.now_ns());
  outlets_.clock.restart(simulation_.now_ns());
}

void Runner::follow_physics() {
  const PhysicsParams& physics = simulation_.physics();
  pacer_.set_factor(physics.step_s * physics.real_time_update_rate_hz, simulation_.now_ns());
}

}  // namespace ardee::node
