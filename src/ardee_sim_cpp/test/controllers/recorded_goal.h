// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/devices/actions.h"
#include "rig.h"

namespace ardee::control {
using namespace devices;

/// Client's side of a goal: keeps its feedback and result.
template <typename Action>
class RecordedGoal : public Action::Handle {
 public:
  using Result = typename Action::Result;
  using Feedback = typename Action::Feedback;

  void accept() override { states.push_back("accepted"); }
  void reject(const Result& given, const std::string& /*why*/) override { end("rejected", given); }
  void feed_back(const Feedback& given) override { feedback.push_back(given); }
  void succeed(const Result& given) override { end("succeeded", given); }
  void abort(const Result& given) override { end("aborted", given); }
  void cancel() override { states.push_back("cancelled"); }

  const std::string& state() const { return states.back(); }

  std::vector<std::string> states;
  Result result;
  std::vector<Feedback> feedback;

 private:
  void end(const std::string& state, const Result& given) {
    states.push_back(state);
    result = given;
  }
};

/// Returns the only action of a controller.
template <typename Action>
const Action& action_of(Rig& rig) {
  return std::get<Action>(rig.controller->ports().all<devices::Action>().at(0).get());
}

/// Sends a goal to the only action of a controller.
template <typename Action>
std::shared_ptr<RecordedGoal<Action>> send_goal(Rig& rig, const typename Action::Goal& goal) {
  auto handle = std::make_shared<RecordedGoal<Action>>();
  action_of<Action>(rig).on_goal(goal, handle);
  return handle;
}

}  // namespace ardee::control
