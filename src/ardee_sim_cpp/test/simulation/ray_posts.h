// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "fixture.h"

namespace ardee {

/// Model of one link with a ray sensor at its origin, in SDF.
struct RayPost {
  std::string plugin;
  std::string type = "ray";
  std::string horizontal = "<samples>1</samples>";
  std::string vertical = "";
  std::string range = "<min>0.1</min><max>30</max>";
  std::string noise = "";
  std::string keys = "";
  std::string rate = "<update_rate>10</update_rate>";
  bool is_static = true;  // false: it floats, with no weight and round inertia

  std::string xml() const {
    return "<sdf version='1.6'><model name='post'><static>" +
           std::string(is_static ? "true" : "false") +
           "</static><link name='mast'><gravity>0</gravity><sensor name='eye' type='" + type +
           "'>" + rate + "<ray><scan><horizontal>" + horizontal + "</horizontal>" +
           (vertical.empty() ? "" : "<vertical>" + vertical + "</vertical>") + "</scan><range>" +
           range + "</range>" + (noise.empty() ? "" : "<noise>" + noise + "</noise>") +
           "</ray><plugin name='eye' filename='" + plugin + "'><topicName>seen</topicName>" + keys +
           "</plugin></sensor></link></model></sdf>";
  }
};

inline std::string angles(int samples, double min_rad, double max_rad) {
  return "<samples>" + std::to_string(samples) + "</samples><min_angle>" + std::to_string(min_rad) +
         "</min_angle><max_angle>" + std::to_string(max_rad) + "</max_angle>";
}

/// Returns a static board across the x axis, 1 cm thick, whose near face is at x; with laser_retro
/// if not 0.
inline std::string board(const std::string& name, double x_m, double y_m, double width_m,
                         double retro = 0.0, const std::string& material = "") {
  const std::string geometry =
      "<geometry><box><size>0.01 " + std::to_string(width_m) + " 6</size></box></geometry>";
  const std::string shine =
      retro > 0.0 ? "<laser_retro>" + std::to_string(retro) + "</laser_retro>" : "";
  return "<model name='" + name + "'><static>true</static><pose>" + std::to_string(x_m + 0.005) +
         " " + std::to_string(y_m) + " 0 0 0 0</pose><link name='link'><collision name='c'>" +
         geometry + shine + "</collision><visual name='v'>" + geometry + shine + material +
         "</visual></link></model>";
}

}  // namespace ardee
