// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"

namespace ardee {
using namespace devices;

/// Keeps all readings by topic.
class Recorder : public ReadingSink {
 public:
  void on_reading(const Output& output, const Reading& reading) override {
    readings_[output.topic].push_back(reading);
  }
  template <typename T>
  std::vector<T> on(const std::string& topic) const {
    std::vector<T> of_kind;
    const auto found = readings_.find(topic);
    if (found == readings_.end()) return of_kind;
    for (const Reading& reading : found->second) of_kind.push_back(std::get<T>(reading));
    return of_kind;
  }
  std::size_t count(const std::string& topic) const {
    const auto found = readings_.find(topic);
    return found == readings_.end() ? 0 : found->second.size();
  }
  void clear() { readings_.clear(); }

 private:
  std::map<std::string, std::vector<Reading>> readings_;
};

/// Running world from text, with its readings and messages.
class TestWorld {
 public:
  /// Starts a world with `body` inside <world> and physics steps of `step_s`.
  explicit TestWorld(const std::string& body, double step_s = 0.001,
                     const SimulationOptions& options = {})
      : loader_(ResourceLocator::from_environment(), Log(sink())) {
    const std::string xml =
        "<sdf version='1.6'><world name='test'><physics type='ode'><max_step_size>" +
        std::to_string(step_s) + "</max_step_size></physics>" + body + "</world></sdf>";
    simulation_ =
        std::make_unique<Simulation>(loader_.load_world_text(xml, "test.world"), options, sink());
    simulation_->set_sink(&recorder_);
  }

  Simulation& operator*() { return *simulation_; }
  Simulation* operator->() { return simulation_.get(); }
  Recorder& recorder() { return recorder_; }
  const Recorder& recorder() const { return recorder_; }
  const std::vector<std::string>& messages() const { return messages_; }

  Entity& spawn(const std::string& xml, const std::string& name, const Pose& pose = {},
                const std::string& robot_namespace = "") {
    SpawnRequest request;
    request.name = name;
    request.model = loader_.load_model_text(xml, name + ".urdf");
    request.X_WM = pose;
    request.robot_namespace = robot_namespace;
    return simulation_->spawn(request);
  }
  void run(double duration_s) {
    const TimeNs end = simulation_->now_ns() + nanoseconds(duration_s);
    while (simulation_->now_ns() < end) simulation_->step();
  }
  void command(Entity& robot, double v_m_per_s, double w_rad_per_s) {
    for (const auto& device : robot.devices) {
      for (const Input& input : device->ports().all<Input>()) {
        if (input.kind != command_kind<Twist>()) continue;
        input.on_command(Twist{{v_m_per_s, 0, 0}, {0, 0, w_rad_per_s}});
      }
    }
  }

 private:
  LogSink sink() {
    return [this](LogLevel, const std::string& text) { messages_.push_back(text); };
  }

  std::vector<std::string> messages_;
  Loader loader_;
  std::unique_ptr<Simulation> simulation_;
  Recorder recorder_;
};

/// Returns a static box in SDF.
inline std::string static_box(const std::string& name, const std::string& pose,
                              const std::string& size) {
  const std::string geometry = "<geometry><box><size>" + size + "</size></box></geometry>";
  return "<model name='" + name + "'><static>true</static><pose>" + pose +
         "</pose><link name='link'>" + "<collision name='c'>" + geometry +
         "</collision><visual name='v'>" + geometry + "</visual></link></model>";
}

inline std::string ground_plane() {
  return "<model name='ground'><static>true</static><link name='link'><collision "
         "name='c'><geometry>"
         "<plane><normal>0 0 1</normal><size>100 "
         "100</size></plane></geometry></collision></link></model>";
}

/// Returns a room of inside measure 10 m x 6 m about the origin.
inline std::string room() {
  return static_box("east", "5.5 0 1 0 0 0", "1 8 4") +
         static_box("west", "-5.5 0 1 0 0 0", "1 8 4") +
         static_box("north", "0 3.5 1 0 0 0", "12 1 4") +
         static_box("south", "0 -3.5 1 0 0 0", "12 1 4");
}

/// Returns a lidar that stands still at its model's origin; `extra` goes into the plugin block.
inline std::string lidar_post(const std::string& plugin, const std::string& type, int samples,
                              double noise_std_m = 0.0, const std::string& extra = "",
                              const std::string& range = "<min>0.1</min><max>30</max>") {
  return "<sdf version='1.6'><model name='post'><static>true</static><link name='mast'>"
         "<sensor name='lidar' type='" +
         type +
         "'><update_rate>40</update_rate><ray><scan><horizontal>"
         "<samples>" +
         std::to_string(samples) +
         "</samples><min_angle>-2.35619449</min_angle>"
         "<max_angle>2.35619449</max_angle></horizontal></scan><range>" +
         range +
         "</range>"
         "<noise><type>gaussian</type><mean>0</mean><stddev>" +
         std::to_string(noise_std_m) + "</stddev></noise></ray><plugin name='lidar' filename='" +
         plugin +
         "'>"
         "<topicName>scan</topicName><frameName>mast</frameName>" +
         extra + "</plugin></sensor></link></model></sdf>";
}

}  // namespace ardee
