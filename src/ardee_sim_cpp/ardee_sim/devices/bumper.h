// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// libgazebo_ros_bumper.so in a sensor of type contact: contacts of the collisions that the
/// sensor's <contact> names. A message holds each step since the last one, as the stock plugin's
/// does. Its vectors are in the world's axes; <frameName> does not change that.
class Bumper : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::set<std::string> collisions{};  // scoped names
    std::string topic{};
    std::string frame{};
    WorldInfo world_info{};
  };

  static std::unique_ptr<Device> make(const SensorDescription& sensor, Parameters& parameters,
                                      std::size_t link, DeviceContext& context);
  Bumper(const std::string& name, const Params& params);

  void observe(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(touches_);
  }

 protected:
  void follow(TimeNs now_ns) override;
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  Output& output_;
  std::vector<ContactsReading::Touch> touches_;  // since the last sample
};

}  // namespace ardee::devices
