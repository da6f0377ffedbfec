// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// libgazebo_ros_ft_sensor.so: the wrench that a joint's child applies to the joint, about the
/// joint's origin, in the axes of the child link, whose name is the frame. A mass hanging on the
/// joint gives m g downwards.
class ForceTorqueSensor : public Sensor {
 public:
  struct Params {
    Mount mount;  // on the child link
    std::size_t joint = 0;
    double gaussian_noise = 0.0;  // N, N m
    std::string topic{};
    std::string frame{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  ForceTorqueSensor(const std::string& name, const Params& params);

  void observe(TimeNs now_ns) override;

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  Output& output_;
};

}  // namespace ardee::devices
