// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// libgazebo_ros_f3d.so: the contact force on a link, and its torque about the centre of mass of
/// the link's rigid body, after each step. Both are in the world's axes; <frameName> does not
/// change that. (The stock plugin reads the engine's sum of applied forces, which the step has set
/// to zero.)
class LinkForce : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::string topic{};
    std::string frame{};
    WorldInfo world_info{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  LinkForce(const std::string& name, const Params& params);

  void observe(TimeNs now_ns) override;

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  std::string scope_;  // of the link's collisions
  Output& output_;
};

}  // namespace ardee::devices
