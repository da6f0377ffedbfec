// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_sensor.h"

#include "ardee_sim/devices/camera_readings.h"

namespace ardee::devices {
namespace {

bool asked_for(const Output* output) { return output != nullptr && output->demanded; }

}  // namespace

std::unique_ptr<Device> CameraSensor::make(const SensorDescription& sensor, Parameters& parameters,
                                           std::size_t link, const CameraPlugin& which,
                                           DeviceContext& context) {
  const CamerasParams params = read_cameras(sensor, parameters, which, context);
  const Mount mount{context.robot, link, sensor.X_LS, params.rate_hz, context.seed};
  return std::make_unique<CameraSensor>(sensor.name, mount, params, context);
}

CameraSensor::CameraSensor(const std::string& name, const Mount& mount, const CamerasParams& params,
                           DeviceContext& context)
    : Sensor(name, mount), pictures_(context.pictures), triggered_(params.triggered) {
  for (const CameraParams& camera : params.cameras) add_eye(camera, context);
  if (triggered_) {
    ports().add_input<Trigger>(params.trigger_topic, [this](const Trigger&) { asked_ = true; });
  }
}

void CameraSensor::add_eye(const CameraParams& params, DeviceContext& context) {
  Eye eye;
  eye.params = params;
  eye.camera.width = params.width;
  eye.camera.height = params.height;
  eye.camera.near_m = params.near_m;
  eye.camera.far_m = params.far_m;
  eye.camera.motion.exposure_time_s = params.exposure_time_s;
  eye.camera.motion.readout_time_s = params.readout_time_s;
  set_lens(eye);
  eye.unzoomed = params.lens.actual;
  eye.unzoomed_table = eye.camera.lens;
  eye.view = context.scenes.register_eye(raycast::SceneKind::kVisual,
                                         [this, X_SC = params.X_SC] { return (pose() * X_SC).p; });
  const auto output = [&](const std::string& topic, std::size_t kind) {
    if (topic.empty()) return static_cast<Output*>(nullptr);
    Output& added = add_output(topic, kind, eye.params.frame);
    if (triggered_) added.rate_hz.reset();
    return &added;
  };
  const std::size_t image = reading_kind<ImageReading>();
  const std::size_t info = reading_kind<CameraInfoReading>();
  const CameraTopics& topics = params.topics;
  eye.image = output(topics.image, image);
  eye.info = output(topics.info, info);
  eye.depth = output(topics.depth, image);
  eye.depth_info = output(topics.depth_info, info);
  eye.points = output(topics.points, reading_kind<PointCloudReading>());
  eye.labels = output(topics.labels, image);
  eye.instances = output(topics.instances, image);
  const std::size_t number = eyes_.size();
  ports().add_number_input(topics.fov, params.fov_min_rad, params.fov_max_rad,
                           [this, number](double fov) {
                             Eye& zoomed = eyes_[number];
                             zoomed.params.lens.set_horizontal_fov(zoomed.params.width, fov);
                             set_lens(zoomed);
                           });
  eyes_.push_back(std::move(eye));
}

void CameraSensor::set_lens(Eye& eye) {
  const CameraParams& params = eye.params;
  eye.camera.lens =
      std::make_shared<render::UndistortionMap>(params.lens.actual, params.width, params.height);
}

void CameraSensor::reset(TimeNs now_ns) {
  Sensor::reset(now_ns);
  asked_ = false;
  for (Eye& eye : eyes_) {
    eye.params.lens.actual = eye.unzoomed;
    eye.camera.lens = eye.unzoomed_table;
  }
}

void CameraSensor::serialize(StateArchive& state) {
  Sensor::serialize(state);
  state(asked_);
  for (Eye& eye : eyes_) {
    render::Lens& lens = eye.params.lens.actual;
    const double unzoomed_px = lens.fx_px;
    state(lens);
    if (lens.fx_px != unzoomed_px) set_lens(eye);
  }
}

bool CameraSensor::wanted() const {
  if (triggered_ && !asked_) return false;
  for (const Eye& eye : eyes_) {
    for (const Output* output :
         {eye.image, eye.info, eye.depth, eye.depth_info, eye.points, eye.labels, eye.instances}) {
      if (asked_for(output)) return true;
    }
  }
  return false;
}

void CameraSensor::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  asked_ = false;
  std::size_t number = 0;
  for (Eye& eye : eyes_) sample(eye, now_ns, noise.frame(number++), sink);
}

void CameraSensor::sample(Eye& eye, TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  render::FrameParts parts;
  parts.light = asked_for(eye.image) || asked_for(eye.points);
  parts.depth = asked_for(eye.depth) || asked_for(eye.points);
  parts.ids = asked_for(eye.labels) || asked_for(eye.instances);
  const Header header{now_ns, eye.params.frame};
  const auto give = [&](const Output* output, auto reading) {
    reading.header = header;
    sink.on_reading(*output, reading);
  };
  if (parts.any()) {
    eye.camera.X_WC = pose() * eye.params.X_SC;
    Twist& twist_W = eye.camera.motion.twist_W;
    twist_W = twist();
    twist_W.linear += twist_W.angular.cross(eye.camera.X_WC.p - pose().p);
    const render::Frame frame = pictures_.take(eye.camera, parts);
    ImageReading image;
    if (asked_for(eye.image)) image = color_image(frame, eye.params, noise.frame(0));
    if (parts.depth) {
      const auto depths_m = measured_depths(frame, eye.params.depth, noise.frame(1));
      if (asked_for(eye.depth)) give(eye.depth, depth_image(frame, depths_m, eye.params.depth));
      if (asked_for(eye.points)) {
        const auto pixels = cloud_pixels(frame, eye.params, image, noise.frame(0));
        give(eye.points, point_cloud(eye.camera, depths_m, pixels, eye.params.cloud_format));
      }
    }
    if (asked_for(eye.image)) give(eye.image, std::move(image));
    if (asked_for(eye.labels)) give(eye.labels, label_image(frame));
    if (asked_for(eye.instances)) give(eye.instances, instance_image(frame));
  }
  if (asked_for(eye.info)) give(eye.info, eye.params.info());
  if (asked_for(eye.depth_info)) give(eye.depth_info, eye.params.info());
}

}  // namespace ardee::devices
