// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "ardee_sim/devices/geodesy.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"
#include "ardee_sim/devices/sensor_model.h"

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

/// Angles in rad: heading of x and declination clockwise from north, inclination downwards.
Vector3d field_in_world(double magnitude, double heading_rad, double declination_rad,
                        double inclination_rad) {
  const double turn = heading_rad - declination_rad;
  const double level = magnitude * std::cos(inclination_rad);
  return {level * std::cos(turn), level * std::sin(turn), -magnitude * std::sin(inclination_rad)};
}

/// libhector_gazebo_ros_magnetic.so: the Earth's field in the body's axes, in the unit of
/// <magnitude>, as Vector3Stamped or, with <useMagneticFieldMsgs>, as MagneticField.
class Magnetometer : public Sensor {
 public:
  struct Params {
    Mount mount;
    Eigen::Vector3d field_W{0, 0, 0};
    SensorErrors errors{};
    bool as_magnetic_field = false;
    std::string topic{};
    std::string frame{};
  };

  Magnetometer(const std::string& name, const Params& params)
      : Sensor(name, params.mount),
        params_(params),
        model_(params.errors, 3, stream_key(params.mount.seed, name + "/field")),
        output_(add_output(params.topic,
                           params.as_magnetic_field ? reading_kind<MagneticFieldReading>()
                                                    : reading_kind<VectorReading>(),
                           params.frame)) {
    add_tuning(model_.tuning(params.topic));
  }

  void reset(TimeNs now_ns) override {
    Sensor::reset(now_ns);
    model_.reset(now_ns, noise_seed());
  }
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(model_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) override {
    const Vector3d field = model_.corrupt(pose().q.conjugate() * params_.field_W, elapsed_s());
    if (!output_.demanded) return;
    const Header header{now_ns, params_.frame};
    if (params_.as_magnetic_field) {
      sink.on_reading(output_, MagneticFieldReading{header, field});
    } else {
      sink.on_reading(output_, VectorReading{header, field});
    }
  }
  bool wanted() const override { return true; }

 private:
  Params params_;
  SensorModel model_;
  Output& output_;
};

}  // namespace

std::unique_ptr<Device> make_magnetometer(const PluginDescription& plugin, Parameters& parameters,
                                          DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  Magnetometer::Params params{
      {context.robot, plugin_link(parameters, context), {}, 0.0, context.seed}};
  read_update_times(parameters, 0.0, params.mount);
  params.errors = read_sensor_errors(parameters, "", read_noise_mode(parameters));
  const double magnitude = parameters.number("magnitude", 1.0, 0.0);
  const double heading_deg = parameters.number("referenceHeading", 0.0, -360.0, 360.0);
  const double declination_deg = parameters.number("declination", 0.0, -360.0, 360.0);
  const double inclination_deg = parameters.number("inclination", 60.0, -90.0, 90.0);
  params.field_W = field_in_world(magnitude, heading_deg * kDegree, declination_deg * kDegree,
                                  inclination_deg * kDegree);
  params.as_magnetic_field = parameters.boolean("useMagneticFieldMsgs", false);
  params.topic = resolve_topic(parameters.text("topicName", "magnetic"), space);
  const std::string link = context.robot.model().links[params.mount.link].name;
  params.frame = resolve_frame(parameters.text("frameId", link), space, context);
  parameters.ignore({"alwaysOn"});
  return std::make_unique<Magnetometer>(plugin.name, params);
}

}  // namespace ardee::devices
