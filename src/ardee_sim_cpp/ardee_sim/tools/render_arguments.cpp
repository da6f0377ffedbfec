// SPDX-License-Identifier: MIT
#include "ardee_sim/tools/render_arguments.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include "ardee_sim/core/error.h"
#include "ardee_sim/render/camera.h"

namespace ardee {
namespace {

constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;
constexpr double kDefaultFov_deg = 60.0;
constexpr int kMaxSide_px = 16384;
constexpr int kMaxSamples = 1024;
constexpr int kMaxThreads = 1024;
constexpr double kFarthest_m = 1e7;

/// Reads the words one after the other.
class Words {
 public:
  Words(int argc, const char* const* argv) : words_(argv + 1, argv + argc) {}

  bool empty() const { return next_ == words_.size(); }
  const std::string& take(const std::string& option) {
    if (empty()) throw Error(option + ": found nothing after it, expected a value");
    return words_[next_++];
  }
  Eigen::Vector3d point(const std::string& option) {
    Eigen::Vector3d values;
    for (double& value : values) {
      value = number(option, take(option));
      if (std::abs(value) > kFarthest_m) {
        throw Error(option + ": found " + words_[next_ - 1] + ", expected at most 1e7");
      }
    }
    return values;
  }
  Pose pose(const std::string& option) {
    const Eigen::Vector3d xyz = point(option);
    return Pose::from_xyz_rpy(xyz, point(option));
  }
  double number(const std::string& option, const std::string& text) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      throw Error(option + ": found '" + text + "', expected a number");
    }
    return value;
  }
  int whole(const std::string& option, const std::string& text, int low, int high) const {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool read = error == std::errc() && end == text.data() + text.size();
    if (!read || value < low || value > high) {
      throw Error(option + ": found '" + text + "', expected a whole number from " +
                  std::to_string(low) + " to " + std::to_string(high));
    }
    return value;
  }

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

void read_size(Words& words, RenderArguments& found) {
  const std::string text = words.take("--size");
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) {
    throw Error("--size: found '" + text + "', expected WIDTHxHEIGHT in pixels, as 1280x720");
  }
  found.width = words.whole("--size", text.substr(0, cross), 1, kMaxSide_px);
  found.height = words.whole("--size", text.substr(cross + 1), 1, kMaxSide_px);
}

void read_fov(Words& words, RenderArguments& found) {
  const std::string text = words.take("--fov-deg");
  const double value = words.number("--fov-deg", text);
  if (!(value >= 0.1 && value <= 175.0)) {
    throw Error("--fov-deg: found " + text + ", expected 0.1 to 175");
  }
  found.horizontal_fov_rad = value * kDegree_rad;
}

/// The camera may be given in two ways; either is complete or absent.
struct View {
  std::optional<Pose> pose;
  std::optional<Eigen::Vector3d> from;
  std::optional<Eigen::Vector3d> at;

  std::optional<Pose> resolve() const {
    if (from.has_value() != at.has_value()) {
      throw Error("found one of --look-from and --look-at, expected both or none");
    }
    if (pose && from) throw Error("found --pose and --look-from, expected one of them");
    return from ? std::optional<Pose>(render::look_at(*from, *at)) : pose;
  }
};

void check(const RenderArguments& found) {
  if (found.world.empty()) throw Error("found no world file, expected one");
  if (found.output.empty())
    throw Error("found no --output, expected a file to write, as world.png");
  if (std::filesystem::path(found.output).extension() != ".png") {
    throw Error("--output: found '" + found.output + "', expected a name that ends in .png");
  }
  const std::filesystem::path folder = std::filesystem::path(found.output).parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    throw Error("--output: found no folder '" + folder.string() + "', expected one to write to");
  }
}

}  // namespace

RenderArguments parse_render_arguments(int argc, const char* const* argv) {
  RenderArguments found;
  found.horizontal_fov_rad = kDefaultFov_deg * kDegree_rad;
  View view;
  bool robot_placed = false;
  Words words(argc, argv);
  const std::map<std::string, std::function<void()>> options = {
      {"-h", [&] { found.help = true; }},
      {"--help", [&] { found.help = true; }},
      {"--collisions", [&] { found.collisions = true; }},
      {"--no-shadows", [&] { found.shadows = false; }},
      {"--output", [&] { found.output = words.take("--output"); }},
      {"--pose", [&] { view.pose = words.pose("--pose"); }},
      {"--look-from", [&] { view.from = words.point("--look-from"); }},
      {"--look-at", [&] { view.at = words.point("--look-at"); }},
      {"--size", [&] { read_size(words, found); }},
      {"--fov-deg", [&] { read_fov(words, found); }},
      {"--model-path", [&] { found.model_paths.push_back(words.take("--model-path")); }},
      {"--robot", [&] { found.robot = words.take("--robot"); }},
      {"--robot-pose",
       [&] {
         found.robot_W = words.pose("--robot-pose");
         robot_placed = true;
       }},
      {"--samples",
       [&] { found.samples = words.whole("--samples", words.take("--samples"), 1, kMaxSamples); }},
      {"--threads",
       [&] { found.threads = words.whole("--threads", words.take("--threads"), 0, kMaxThreads); }}};
  while (!words.empty()) {
    const std::string word = words.take("");
    if (const auto option = options.find(word); option != options.end()) {
      option->second();
    } else if (word.empty() || word[0] == '-' || !found.world.empty()) {
      throw Error("found '" + word +
                  "', expected a world file and options (--help lists all arguments)");
    } else {
      found.world = word;
    }
  }
  if (found.help) return found;
  check(found);
  if (robot_placed && found.robot.empty()) {
    throw Error("found --robot-pose without --robot, expected the robot's file too");
  }
  found.camera_W = view.resolve();
  return found;
}

std::string render_usage() {
  return "usage: render_world WORLD --output PICTURE.png\n"
         "         [--pose X Y Z ROLL PITCH YAW | --look-from X Y Z --look-at X Y Z]\n"
         "         [--size WIDTHxHEIGHT] [--fov-deg F] [--robot FILE] [--robot-pose X Y Z R P Y]\n"
         "         [--model-path DIR] [--samples N] [--collisions] [--no-shadows] [--threads N] "
         "[-h]\n"
         "Draws a picture of a world without a display.\n"
         "  WORLD             world file (SDF 1.2 to 1.12): a path, or a name below\n"
         "                    GAZEBO_RESOURCE_PATH\n"
         "  --output FILE     PNG file to write\n"
         "  --pose            pose of the camera in m and rad; it looks along its x axis, z is up\n"
         "                    (default the world's gui camera, else a view over the whole world)\n"
         "  --look-from       position of the camera in m; it looks at --look-at\n"
         "  --look-at         point in the middle of the picture in m, with --look-from\n"
         "  --size            width and height in pixels (default 1280x720)\n"
         "  --fov-deg F       horizontal angle of view in degrees (default 60)\n"
         "  --robot FILE      URDF or SDF file of a robot to draw too\n"
         "  --robot-pose      pose of the robot in m and rad (default 0 0 0 0 0 0)\n"
         "  --model-path DIR  folder of models to search before GAZEBO_MODEL_PATH; may be given "
         "again\n"
         "  --samples N       rays per pixel, for smooth edges (default 4)\n"
         "  --collisions      draw collision bodies too, transparent and orange\n"
         "  --no-shadows      light reaches everywhere\n"
         "  --threads N       threads, 0: all cores (default 0); the picture is the same with any\n"
         "  -h, --help        this text\n";
}

}  // namespace ardee
