// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string>

#include "fixture.h"

namespace ardee {
using namespace devices;

/// Returns a camera that stands still at its model's origin; `camera` goes into <camera>, `keys`
/// into the plugin.
inline std::string camera_post(const std::string& plugin, const std::string& camera,
                               const std::string& keys = "", const std::string& type = "camera",
                               double rate_hz = 10.0) {
  return "<sdf version='1.6'><model name='post'><static>true</static><link name='mast'>"
         "<sensor name='eye' type='" +
         type + "'><update_rate>" + std::to_string(rate_hz) + "</update_rate>" + camera +
         "<plugin name='eye' filename='libgazebo_ros_" + plugin +
         ".so'><cameraName>cam</cameraName><frameName>optical</frameName>"
         "<exposure>1</exposure>" +
         keys + "</plugin></sensor></link></model></sdf>";
}

inline std::string camera_block(int width, int height, double fov_rad,
                                const std::string& more = "") {
  return "<camera><horizontal_fov>" + std::to_string(fov_rad) + "</horizontal_fov><image><width>" +
         std::to_string(width) + "</width><height>" + std::to_string(height) +
         "</height><format>R8G8B8</format></image><clip><near>0.05</near><far>50</far></clip>" +
         more + "</camera>";
}

/// Returns a box that glows in one brightness from 0 to 1, in any light.
inline std::string glowing_box(const std::string& name, const std::string& pose,
                               const std::string& size, double brightness) {
  const std::string b = std::to_string(brightness);
  return "<model name='" + name + "'><static>true</static><pose>" + pose +
         "</pose><link name='link'><visual name='v'><geometry><box><size>" + size +
         "</size></box></geometry><material><ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse>"
         "<emissive>" +
         b + " " + b + " " + b + " 1</emissive></material></visual></link></model>";
}

/// Listens to these outputs of a robot only.
inline void listen_to(Entity& robot, const std::vector<std::string>& topics) {
  for (const auto& device : robot.devices) {
    for (Output& output : device->ports().all<Output>()) {
      output.demanded = std::find(topics.begin(), topics.end(), output.topic) != topics.end();
    }
  }
}

template <typename Number>
Number value_at(const std::vector<std::uint8_t>& data, std::size_t byte) {
  Number number;
  std::memcpy(&number, &data[byte], sizeof(number));
  return number;
}

}  // namespace ardee
