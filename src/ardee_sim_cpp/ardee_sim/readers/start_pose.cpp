// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/start_pose.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>

#include "ardee_sim/core/error.h"

namespace ardee {
namespace {

constexpr const char* kExpected = "expected numbers x_m, y_m, z_m, yaw_rad";

/// The number of the pose that has this key in the file.
double* number_of(StartPose& pose, const std::string& key) {
  if (key == "x_m") return &pose.x_m;
  if (key == "y_m") return &pose.y_m;
  if (key == "z_m") return &pose.z_m;
  if (key == "yaw_rad") return &pose.yaw_rad;
  return nullptr;
}

StartPose read(const YAML::Node& file, const std::string& path) {
  if (!file.IsMap()) throw Error(Source{path, 1, ""}, std::string("found no keys, ") + kExpected);
  StartPose pose;
  for (const auto& each : file) {
    const auto key = each.first.as<std::string>();
    const Source source{path, each.first.Mark().line + 1, ""};
    double* number = number_of(pose, key);
    if (!number) throw Error(source, "found the key '" + key + "', " + kExpected);
    double value = 0.0;
    if (!YAML::convert<double>::decode(each.second, value) || !std::isfinite(value)) {
      throw Error(source, key + ": found '" + (each.second.IsScalar() ? each.second.Scalar() : "") +
                              "', expected a finite number");
    }
    *number = value;
  }
  return pose;
}

}  // namespace

std::optional<StartPose> read_start_pose(const std::string& world_file) {
  const std::string path =
      std::filesystem::path(world_file).replace_extension(".start.yaml").string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  try {
    return read(YAML::LoadFile(path), path);
  } catch (const YAML::Exception& problem) {
    throw Error(Source{path, problem.mark.line + 1, ""},
                "found " + problem.msg + ", expected YAML");
  }
}

}  // namespace ardee
