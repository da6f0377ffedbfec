// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/time.h"
#include "ardee_sim/description/model.h"

namespace ardee {

/// Parameters of the physics engine; defaults are SDF's.
struct PhysicsParams {
  enum class Solver { kQuick, kWorld };

  double step_s = 0.001;
  double real_time_update_rate_hz = 1000.0;  // steps per wall second; 0: as fast as possible
  Eigen::Vector3d gravity_m_per_s2{0, 0, -9.8};
  Solver solver = Solver::kQuick;
  int iterations = 50;
  double sor = 1.3;
  double cfm = 0.0;
  double erp = 0.2;
  double max_correcting_velocity_m_per_s = 100.0;
  double contact_surface_layer_m = 0.001;
  int max_contacts = 20;
};

struct Light {
  enum class Type { kDirectional, kPoint, kSpot };

  std::string name;
  Type type = Type::kDirectional;
  Pose pose;
  Color diffuse{1, 1, 1, 1};
  Color specular{0.1f, 0.1f, 0.1f, 1};
  Eigen::Vector3d direction{0, 0, -1};
  bool cast_shadows = false;
  double range_m = 10.0;
  double attenuation_constant = 1.0;
  double attenuation_linear = 1.0;
  double attenuation_quadratic = 0.0;
  // Spot: full brightness within the inner angle, none outside the outer one.
  double inner_angle_rad = 0.0;
  double outer_angle_rad = 0.0;
  double falloff = 0.0;
};

struct Scene {
  Color ambient{0.4f, 0.4f, 0.4f, 1};
  Color background{0.7f, 0.7f, 0.7f, 1};
  bool sky = false;
  bool shadows = true;
};

/// Position of the world's origin on the Earth; angles in degrees as in SDF.
struct SphericalCoordinates {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double elevation_m = 0.0;
  double heading_deg = 0.0;
};

/// A world as described: const after load.
struct World {
  std::string name = "default";
  Source source;
  PhysicsParams physics;
  Scene scene;
  std::vector<Light> lights;
  std::optional<Pose> gui_camera;
  std::optional<SphericalCoordinates> spherical_coordinates;
  TimeNs start_ns = 0;  // on the clock
  std::vector<Instance> models;
  std::vector<PluginDescription> plugins;
};

}  // namespace ardee
