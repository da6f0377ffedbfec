// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_params.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/camera_formats.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sdf_noise.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

constexpr int kLongestSide_px = 8192;
constexpr double kMostPixels = 1 << 24;
constexpr double kLongestShutter_s = 1.0;
constexpr double kLeastFov_rad = 1e-3;
constexpr double kMostFov_rad = M_PI - 1e-3;

void read_image(const Element& image, CameraParams& camera, Log& log) {
  Parameters parameters(image);
  camera.width = parameters.integer("width", 320, 1, kLongestSide_px);
  camera.height = parameters.integer("height", 240, 1, kLongestSide_px);
  if (static_cast<double>(camera.width) * camera.height > kMostPixels) {
    throw Error(image.source, "found " + std::to_string(camera.width) + " x " +
                                  std::to_string(camera.height) + " pixels, expected at most " +
                                  std::to_string(static_cast<int>(kMostPixels)) + " in all");
  }
  const Element* place = parameters.block("format");
  const std::string format = place && !place->text.empty() ? place->text : "R8G8B8";
  camera.development.format = read_pixel_format(format, place ? place->source : image.source, log);
}

void read_clip(const Element& clip, CameraParams& camera) {
  Parameters parameters(clip);
  camera.near_m = parameters.number("near", 0.1, 0.0, limits::kFarthest_m);
  camera.far_m = parameters.number("far", 100.0, 0.0, limits::kFarthest_m);
  if (!(camera.far_m > camera.near_m)) throw parameters.error("far", "expected more than <near>");
}

Pose read_pose(const Element* pose) {
  if (pose == nullptr || pose->text.empty()) return {};
  std::istringstream stream(pose->text);
  double numbers[6];
  for (double& number : numbers) {
    std::string word;
    stream >> word;
    number = parse_number(word, pose->source);
  }
  std::string rest;
  if (stream >> rest) throw Error(pose->source, "found '" + pose->text + "', expected six numbers");
  return Pose::from_xyz_rpy({numbers[0], numbers[1], numbers[2]},
                            {numbers[3], numbers[4], numbers[5]});
}

/// Reads SDF's <camera>; the plugin's keys are not yet applied to the lens.
CameraParams read_camera_block(const Element& block, SdfLens& of_sdf, Log& log) {
  CameraParams camera;
  Parameters parameters(block);
  camera.X_SC = read_pose(parameters.block("pose"));
  const double fov_rad = parameters.number("horizontal_fov", 1.047);
  if (!(fov_rad > 0.0 && fov_rad < M_PI)) {
    throw parameters.error("horizontal_fov", "expected more than 0 and less than pi");
  }
  if (const Element* image = parameters.block("image")) read_image(*image, camera, log);
  if (const Element* clip = parameters.block("clip")) read_clip(*clip, camera);
  if (const Element* given = parameters.block("noise")) {
    const SdfNoise noise = read_sdf_noise(*given, false);
    camera.development.noise_mean = noise.mean;
    camera.development.noise_std = noise.std;
  }
  camera.lens.actual = render::Lens::pinhole(camera.width, camera.height, fov_rad);
  of_sdf = read_sdf_lens(parameters, camera.lens.actual, log);
  return camera;
}

std::optional<float> read_exposure(Parameters& parameters) {
  if (parameters.text("exposure", "auto") == "auto") return std::nullopt;
  const double factor = parameters.number("exposure", 1.0, 0.0, limits::kMostFactor);
  if (factor == 0.0) throw parameters.error("exposure", "expected auto or a number above 0");
  return static_cast<float>(factor);
}

render::WhiteBalance read_white_balance(Parameters& parameters) {
  const auto read = render::parse_white_balance(parameters.text("whiteBalance", "off"));
  if (!read) throw parameters.error("whiteBalance", render::kWhiteBalanceForms);
  return *read;
}

DepthParams read_depth(Parameters& parameters, const CameraParams& camera, CameraKind kind) {
  constexpr double kMost = 1e3;
  DepthParams depth;
  depth.noise_constant_m = parameters.number("depthNoiseConstant", 0.0, 0.0, kMost);
  depth.noise_linear = parameters.number("depthNoiseLinear", 0.0, 0.0, kMost);
  depth.noise_quadratic_per_m = parameters.number("depthNoiseQuadratic", 0.0, 0.0, kMost);
  const double nearest_m = parameters.number("pointCloudCutoff", 0.4, 0.0, limits::kFarthest_m);
  const double farthest_m = parameters.number(
      "pointCloudCutoffMax", kind == CameraKind::kOpenni ? 5.0 : limits::kFarthest_m, 0.0,
      limits::kFarthest_m);
  if (!(farthest_m > nearest_m)) {
    throw parameters.error("pointCloudCutoffMax", "expected more than <pointCloudCutoff>");
  }
  depth.nearest_m = std::max(nearest_m, camera.near_m);
  depth.farthest_m = std::min(farthest_m, camera.far_m);
  depth.millimetres = parameters.boolean("useDepth16UC1Format", false);
  return depth;
}

/// Encoding of the published image; without the key, that of <format>.
void read_image_encoding(Parameters& parameters, CameraParams& camera) {
  camera.cloud_format = camera.development.format;
  camera.encoding = parameters.text("imageEncoding", encoding_of(camera.cloud_format));
  if (const Element* key = parameters.block("imageEncoding")) {
    camera.development.format = read_encoding(camera.encoding, key->source);
  }
}

void read_zoom(Parameters& parameters, CameraParams& camera) {
  camera.fov_min_rad =
      parameters.number("horizontalFovMin", kLeastFov_rad, kLeastFov_rad, kMostFov_rad);
  camera.fov_max_rad =
      parameters.number("horizontalFovMax", kMostFov_rad, kLeastFov_rad, kMostFov_rad);
  if (camera.fov_max_rad < camera.fov_min_rad) {
    throw parameters.error("horizontalFovMax", "expected at least <horizontalFovMin>");
  }
}

/// The plugin's keys for one camera. `suffix` follows the camera's name in topics.
void read_plugin(Parameters& parameters, CameraKind kind, const std::string& suffix,
                 bool has_baseline, const SdfLens& of_sdf, CameraParams& camera, CamerasParams& all,
                 DeviceContext& context) {
  const std::string robot = plugin_namespace(parameters, context);
  // As in Gazebo a camera's name is below the robot's namespace, even with a leading slash.
  const std::string name = without_slashes(parameters.text("cameraName", "")) + suffix;
  const std::string space = "/" + without_slashes(robot + "/" + name);
  const auto topic = [&](const char* key, const char* fallback) {
    return resolve_topic(parameters.text(key, fallback), space);
  };
  camera.topics.fov = resolve_topic("set_hfov", space);
  const bool depth = kind != CameraKind::kColor;
  CameraTopics& topics = camera.topics;
  topics.image = topic("imageTopicName", depth ? "ir/image_raw" : "image_raw");
  topics.info = topic("cameraInfoTopicName", depth ? "ir/camera_info" : "camera_info");
  if (depth) {
    topics.depth = topic("depthImageTopicName", "depth/image_raw");
    topics.depth_info = topic("depthImageCameraInfoTopicName", "depth/camera_info");
    topics.points = topic("pointCloudTopicName", "points");
    camera.depth = read_depth(parameters, camera, kind);
  }
  if (parameters.boolean("segmentation", false)) {
    const std::string base = topics.image.substr(0, topics.image.find_last_of('/'));
    topics.labels = base + "/segmentation/label";
    topics.instances = base + "/segmentation/instance";
  }
  camera.lens = read_camera_lens(parameters, camera.lens.actual, of_sdf, context.log);
  if (!has_baseline) camera.lens.baseline_m = 0.0;
  read_zoom(parameters, camera);
  camera.frame = resolve_frame(parameters.text("frameName", "/world"), robot, context,
                               WithoutPrefix::kNamespace);
  camera.development.exposure = read_exposure(parameters);
  camera.development.white_balance = read_white_balance(parameters);
  camera.exposure_time_s = parameters.number("exposureTime", 0.0, 0.0, kLongestShutter_s);
  camera.readout_time_s = parameters.number("readoutTime", 0.0, 0.0, kLongestShutter_s);
  read_image_encoding(parameters, camera);
  all.triggered = parameters.boolean("triggered", all.triggered);
  all.trigger_topic = topic("triggerTopicName", "image_trigger");
  all.rate_hz = slower_rate_hz(all.rate_hz, parameters.number("updateRate", 0.0, 0.0));
  // Rays pass through the lens model: there is no border to crop. Gazebo does not read the last
  // two.
  parameters.ignore({"alwaysOn", "borderCrop", "baseline", "distortion_k1", "distortion_k2",
                     "distortion_k3", "distortion_t1", "distortion_t2", "imageTopic"});
}

}  // namespace

CameraInfoReading CameraParams::info() const {
  const render::Lens& taken = lens.actual;
  CameraInfoReading info;
  info.width = static_cast<std::uint32_t>(width);
  info.height = static_cast<std::uint32_t>(height);
  info.D = lens.reported;
  info.K = {taken.fx_px, taken.skew_px, taken.cx_px, 0, taken.fy_px, taken.cy_px, 0, 0, 1};
  info.P = {taken.fx_px,
            taken.skew_px,
            lens.cx_prime_px.value_or(taken.cx_px),
            0.0 - taken.fx_px * lens.baseline_m,
            0,
            taken.fy_px,
            taken.cy_px,
            0,
            0,
            0,
            1,
            0};
  return info;
}

CamerasParams read_cameras(const SensorDescription& sensor, Parameters& parameters,
                           const CameraPlugin& which, DeviceContext& context) {
  CamerasParams all;
  all.rate_hz = sensor.update_rate_hz;
  all.triggered = which.triggered;
  for (const Element& block : sensor.element.children) {
    if (block.name != "camera") continue;
    SdfLens of_sdf;
    CameraParams camera = read_camera_block(block, of_sdf, context.log);
    const auto name = block.attributes.find("name");
    const std::string own = name == block.attributes.end() ? "" : name->second;
    if (which.several && own.empty()) throw Error(block.source, "found no name, expected one");
    const bool is_left = which.several && own.find("left") != std::string::npos;
    const bool is_right = which.several && own.find("right") != std::string::npos;
    const std::string suffix = !which.several ? ""
                               : is_left      ? "/left"
                               : is_right     ? "/right"
                                              : "/" + own;
    read_plugin(parameters, which.kind, suffix, !is_left, of_sdf, camera, all, context);
    for (const CameraParams& other : all.cameras) {
      if (other.topics.image != camera.topics.image) continue;
      throw Error(block.source, "found a second camera of topic " + camera.topics.image +
                                    ", expected names that tell cameras apart");
    }
    all.cameras.push_back(std::move(camera));
    if (!which.several) break;
  }
  if (all.cameras.empty()) {
    throw Error(sensor.element.source, "sensor '" + sensor.name + "' of type '" + sensor.type +
                                           "': found no <camera>, expected one");
  }
  return all;
}

}  // namespace ardee::devices
