// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/camera_params.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// Colour and depth cameras, one or several in a sensor. Outputs without a subscriber are not
/// computed: depth costs no shading, camera_info no picture.
class CameraSensor : public Sensor {
 public:
  static std::unique_ptr<Device> make(const SensorDescription& sensor, Parameters& parameters,
                                      std::size_t link, const CameraPlugin& which,
                                      DeviceContext& context);
  CameraSensor(const std::string& name, const Mount& mount, const CamerasParams& params,
               DeviceContext& context);
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override;

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override;

 private:
  struct Eye {
    CameraParams params;
    render::Lens unzoomed;
    std::shared_ptr<const render::UndistortionMap> unzoomed_table;
    render::Camera camera;       // without its pose
    std::shared_ptr<void> view;  // announces the rays' origin to the scenes
    Output* image = nullptr;     // null: no such topic
    Output* info = nullptr;
    Output* depth = nullptr;
    Output* depth_info = nullptr;
    Output* points = nullptr;
    Output* labels = nullptr;
    Output* instances = nullptr;
  };
  void add_eye(const CameraParams& params, DeviceContext& context);
  static void set_lens(Eye& eye);
  void sample(Eye& eye, TimeNs now_ns, const CounterRng& noise, ReadingSink& sink);

  CameraRenderer& pictures_;
  std::vector<Eye> eyes_;
  bool triggered_ = false;
  bool asked_ = false;  // a trigger has come since the last picture
};

}  // namespace ardee::devices
