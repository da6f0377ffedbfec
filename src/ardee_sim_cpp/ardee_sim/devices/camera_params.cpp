// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_params.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/camera_formats.h"
#include "ardee_sim/devices/names.h"

namespace ardee {
namespace {

constexpr int kLongestSide_px = 8192;
constexpr double kMostPixels = 1 << 24;
constexpr double kFarthest_m = 1e6;
constexpr double kMostDistortion = 1e3;
/// Relative: of a focal length against what the field of view says.
constexpr double kSameFocalLength = 1e-2;

void read_image(const Element& image, CameraParams& camera, Log& log) {
  Parameters parameters(image);
  camera.width = parameters.integer("width", 320, 1, kLongestSide_px);
  camera.height = parameters.integer("height", 240, 1, kLongestSide_px);
  if (static_cast<double>(camera.width) * camera.height > kMostPixels) {
    throw Error(image.source, "found " + std::to_string(camera.width) + " x " +
                                  std::to_string(camera.height) + " pixels, expected at most " +
                                  std::to_string(static_cast<int>(kMostPixels)) + " in all");
  }
  const std::string format = parameters.text("format", "R8G8B8");
  const Element* place = parameters.block("format");
  camera.development.format = read_pixel_format(format, place ? place->source : image.source);
  parameters.ignore({"anti_aliasing"});
  parameters.finish(log);
}

void read_clip(const Element& clip, CameraParams& camera, Log& log) {
  Parameters parameters(clip);
  camera.near_m = parameters.number("near", 0.1, 0.0, kFarthest_m);
  camera.far_m = parameters.number("far", 100.0, 0.0, kFarthest_m);
  if (!(camera.far_m > camera.near_m)) throw parameters.error("far", "expected more than <near>");
  parameters.finish(log);
}

void read_noise(const Element& noise, CameraParams& camera, Log& log) {
  Parameters parameters(noise);
  const std::string type = noise.attributes.count("type") ? noise.attributes.at("type")
                                                          : parameters.text("type", "none");
  const double mean = parameters.number("mean", 0.0);
  const double std = parameters.number("stddev", 0.0, 0.0);
  parameters.ignore({"type", "bias_mean", "bias_stddev", "precision"});
  parameters.finish(log);
  if (type == "none") return;
  if (type != "gaussian") {
    throw Error(noise.source, "found noise type '" + type + "', expected gaussian or none");
  }
  camera.development.noise_mean = mean;
  camera.development.noise_std = std;
}

std::array<double, 5> read_distortion(const Element& distortion, Log& log) {
  Parameters parameters(distortion);
  std::array<double, 5> D{};
  std::size_t k = 0;
  for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) {
    D[k++] = parameters.number(key, 0.0, -kMostDistortion, kMostDistortion);
  }
  const std::string center = parameters.text("center", "0.5 0.5");
  std::istringstream stream(center);
  double x = 0.0, y = 0.0;
  if (!(stream >> x >> y) || x != 0.5 || y != 0.5) {
    throw parameters.error("center", "expected 0.5 0.5: camera_info has no other");
  }
  parameters.finish(log);
  return D;
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

/// SDF's <camera>; the lens is still that of the field of view.
CameraParams read_camera_block(const Element& block, std::optional<std::array<double, 5>>& bend,
                               Log& log) {
  CameraParams camera;
  Parameters parameters(block);
  camera.X_SC = read_pose(parameters.block("pose"));
  const double fov_rad = parameters.number("horizontal_fov", 1.047);
  if (!(fov_rad > 0.0 && fov_rad < M_PI)) {
    throw parameters.error("horizontal_fov", "expected more than 0 and less than pi");
  }
  if (const Element* image = parameters.block("image")) read_image(*image, camera, log);
  if (const Element* clip = parameters.block("clip")) read_clip(*clip, camera, log);
  if (const Element* noise = parameters.block("noise")) read_noise(*noise, camera, log);
  if (const Element* distortion = parameters.block("distortion")) {
    bend = read_distortion(*distortion, log);
  }
  parameters.ignore({"save", "depth_camera", "visibility_mask"});
  parameters.finish(log);
  camera.lens = Lens::pinhole(camera.width, camera.height, fov_rad);
  return camera;
}

/// Focal length and middle as the plugin overrides them: the picture is taken with them, too.
/// Returns the middle of P in x.
double read_intrinsics(Parameters& parameters, CameraParams& camera, Log& log) {
  constexpr double kMost_px = 1e6;
  const double focal_px = parameters.number("focalLength", 0.0, 0.0, kMost_px);
  const double cx_px = parameters.number("Cx", 0.0, -kMost_px, kMost_px);
  const double cy_px = parameters.number("Cy", 0.0, -kMost_px, kMost_px);
  const double cx_prime_px = parameters.number("CxPrime", 0.0, -kMost_px, kMost_px);
  if (focal_px > 0.0) {
    if (std::abs(focal_px / camera.lens.fx_px - 1.0) > kSameFocalLength) {
      std::ostringstream text;
      text << parameters.source().to_string() << ": found <focalLength> " << focal_px
           << ", expected " << camera.lens.fx_px
           << " by <horizontal_fov>: the picture is taken with the former";
      log.warn(text.str());
    }
    camera.lens.fx_px = camera.lens.fy_px = focal_px;
  }
  if (cx_px != 0.0) camera.lens.cx_px = cx_px;
  if (cy_px != 0.0) camera.lens.cy_px = cy_px;
  return cx_prime_px != 0.0 ? cx_prime_px : camera.lens.cx_px;
}

/// Sets what bends the picture, and returns what camera_info says.
std::array<double, 5> read_bend(Parameters& parameters, CameraParams& camera,
                                const std::optional<std::array<double, 5>>& of_sdf, Log& log) {
  std::array<double, 5> of_plugin{};
  std::size_t k = 0;
  for (const char* key :
       {"distortionK1", "distortionK2", "distortionT1", "distortionT2", "distortionK3"}) {
    of_plugin[k++] = parameters.number(key, 0.0, -kMostDistortion, kMostDistortion);
  }
  const bool automatic = parameters.boolean("autoDistortion", false);
  const bool given = of_plugin != std::array<double, 5>{};
  if (of_sdf) {
    if (given && of_plugin != *of_sdf) {
      log.warn(parameters.source().to_string() +
               ": found distortion other than that of <camera>, which camera_info tells");
    }
    return camera.lens.D = *of_sdf;
  }
  if (automatic) return camera.lens.D = of_plugin;
  if (given) {
    log.warn(parameters.source().to_string() +
             ": found distortion without <autoDistortion>: camera_info tells it, the picture is "
             "straight");
  }
  return of_plugin;
}

void fill_info(CameraParams& camera, const std::array<double, 5>& D, double cx_prime_px,
               double baseline_m) {
  const Lens& lens = camera.lens;
  CameraInfoReading& info = camera.info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.D = D;
  info.K = {lens.fx_px, 0, lens.cx_px, 0, lens.fy_px, lens.cy_px, 0, 0, 1};
  info.P = {lens.fx_px, 0,          cx_prime_px, -lens.fx_px * baseline_m,
            0,          lens.fy_px, lens.cy_px,  0,
            0,          0,          1,           0};
}

std::optional<float> read_exposure(Parameters& parameters) {
  if (parameters.text("exposure", "auto") == "auto") return std::nullopt;
  const double factor = parameters.number("exposure", 1.0, 0.0, 1e6);
  if (factor == 0.0) throw parameters.error("exposure", "expected auto or a number above 0");
  return static_cast<float>(factor);
}

DepthParams read_depth(Parameters& parameters, const CameraParams& camera, CameraKind kind) {
  constexpr double kMost = 1e3;
  DepthParams depth;
  depth.noise_constant_m = parameters.number("depthNoiseConstant", 0.0, 0.0, kMost);
  depth.noise_linear = parameters.number("depthNoiseLinear", 0.0, 0.0, kMost);
  depth.noise_quadratic_per_m = parameters.number("depthNoiseQuadratic", 0.0, 0.0, kMost);
  const double nearest_m = parameters.number("pointCloudCutoff", 0.4, 0.0, kFarthest_m);
  const double farthest_m = parameters.number(
      "pointCloudCutoffMax", kind == CameraKind::kOpenni ? 5.0 : kFarthest_m, 0.0, kFarthest_m);
  if (!(farthest_m > nearest_m)) {
    throw parameters.error("pointCloudCutoffMax", "expected more than <pointCloudCutoff>");
  }
  depth.nearest_m = std::max(nearest_m, camera.near_m);
  depth.farthest_m = std::min(farthest_m, camera.far_m);
  depth.millimetres = parameters.boolean("useDepth16UC1Format", false);
  return depth;
}

/// The plugin's keys for one camera. `suffix` follows the camera's name in topics.
void read_plugin(const PluginDescription& plugin, CameraKind kind, const std::string& suffix,
                 bool has_baseline, const std::optional<std::array<double, 5>>& bend,
                 CameraParams& camera, CamerasParams& all, DeviceContext& context) {
  Parameters parameters(plugin.element);
  const std::string robot = plugin_namespace(parameters, context);
  const std::string space = resolve_topic(parameters.text("cameraName", "") + suffix, robot);
  const auto topic = [&](const char* key, const char* fallback) {
    return resolve_topic(parameters.text(key, fallback), space);
  };
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
  const double cx_prime_px = read_intrinsics(parameters, camera, context.log);
  const std::array<double, 5> D = read_bend(parameters, camera, bend, context.log);
  const double baseline_m = parameters.number("hackBaseline", 0.0);
  fill_info(camera, D, cx_prime_px, has_baseline ? baseline_m : 0.0);
  camera.info.header.frame_id =
      resolve_frame(parameters.text("frameName", "/world"), robot, context);
  camera.development.exposure = read_exposure(parameters);
  all.triggered = parameters.boolean("triggered", all.triggered);
  all.trigger_topic = topic("triggerTopicName", "image_trigger");
  const double rate_hz = parameters.number("updateRate", 0.0, 0.0);
  if (rate_hz > 0.0) all.rate_hz = all.rate_hz > 0.0 ? std::min(all.rate_hz, rate_hz) : rate_hz;
  // Rays bend through the lens: there is no border to crop. The last two Gazebo does not read.
  parameters.ignore({"alwaysOn", "borderCrop", "baseline", "distortion_k1", "distortion_k2",
                     "distortion_k3", "distortion_t1", "distortion_t2", "imageTopic"});
  parameters.finish(context.log);
}

}  // namespace

CamerasParams read_cameras(const SensorDescription& sensor, const PluginDescription& plugin,
                           CameraKind kind, bool several, bool triggered, DeviceContext& context) {
  CamerasParams all;
  all.rate_hz = sensor.update_rate_hz;
  all.triggered = triggered;
  for (const Element& block : sensor.element.children) {
    if (block.name != "camera") continue;
    std::optional<std::array<double, 5>> bend;
    CameraParams camera = read_camera_block(block, bend, context.log);
    const auto name = block.attributes.find("name");
    const std::string own = name == block.attributes.end() ? "" : name->second;
    if (several && own.empty()) throw Error(block.source, "found no name, expected one");
    const bool is_left = several && own.find("left") != std::string::npos;
    const bool is_right = several && own.find("right") != std::string::npos;
    const std::string suffix = !several ? "" : is_left ? "/left" : is_right ? "/right" : "/" + own;
    read_plugin(plugin, kind, suffix, !is_left, bend, camera, all, context);
    all.cameras.push_back(std::move(camera));
    if (!several) break;
  }
  if (all.cameras.empty()) {
    throw Error(sensor.element.source, "sensor '" + sensor.name + "' of type '" + sensor.type +
                                           "': found no <camera>, expected one");
  }
  return all;
}

}  // namespace ardee
