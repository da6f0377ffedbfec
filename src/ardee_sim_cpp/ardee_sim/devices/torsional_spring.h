// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// libTorsionalSpringPlugin.so (thesis 4.4.3, Listings A.4, A.26, A.27): a torsional harmonic
/// oscillator on a joint, tau = -damping * rate - stiffness * (angle - reference) (eq. 4.1), with
/// the joint's limits enforced. A command on <referenceTopic> moves the reference. Unlike the
/// listing's explicit torque it is integrated implicitly and so is stable for any stiffness and
/// step.
class TorsionalSpring : public Device {
 public:
  struct Params {
    std::string joint;
    double stiffness_n_m_per_rad = 100.0;
    double damping_n_m_s_per_rad = 1.0;
    double reference_rad = 1.0;
    double lower_rad = 0.0;  // set only with has_limits
    double upper_rad = 0.0;
    bool has_limits = false;
    bool verbose = false;
    std::string reference_topic;  // empty: the reference stays
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  TorsionalSpring(const std::string& name, const Params& params, std::size_t joint,
                  DeviceContext& context);

  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(reference_rad_, verbose_timer_); }

 private:
  void set_reference(double reference_rad);

  Params params_;
  std::size_t joint_;
  Robot& robot_;
  Log& log_;
  double reference_rad_ = 0.0;
  RateTimer verbose_timer_{1.0};
};

}  // namespace ardee::devices
