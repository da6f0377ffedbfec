// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {
namespace {

constexpr int kMaxContacts = 100000;

/// Accepts "nan", which a link that never moves may have.
double read_inertia(const Node& element, const char* name, double fallback) {
  const auto value = to_double(element.text(name, ""));
  return value && std::isnan(*value) ? *value : element.number(name, fallback);
}

/// SDF's defaults: one kilogram, unit inertia.
Inertial read_inertial(const Node& link, const SdfFrames& frames, const std::string& name) {
  Inertial made;
  made.mass_kg = 1.0;
  made.inertia_kg_m2 = Eigen::Matrix3d::Identity();
  const auto inertial = link.child("inertial");
  if (!inertial) return made;
  made.mass_kg = read_inertia(*inertial, "mass", 1.0);
  made.X_LI = frames.pose_in(name, *inertial);
  if (const auto inertia = inertial->child("inertia")) {
    const double xx = read_inertia(*inertia, "ixx", 1.0);
    const double xy = read_inertia(*inertia, "ixy", 0.0);
    const double xz = read_inertia(*inertia, "ixz", 0.0);
    const double yy = read_inertia(*inertia, "iyy", 1.0);
    const double yz = read_inertia(*inertia, "iyz", 0.0);
    const double zz = read_inertia(*inertia, "izz", 1.0);
    made.inertia_kg_m2 << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  }
  return made;
}

double read(const Node& node, const char* path, double fallback, const bounds::Range& range) {
  return node.number(path, fallback, range.low, range.high);
}

/// A mask in decimal, or in hexadecimal after 0x.
std::uint32_t read_mask(const Node& contact, const char* name, std::uint32_t fallback) {
  const std::string text = contact.text(name, "");
  if (text.empty()) return fallback;
  std::size_t read = 0;
  unsigned long value = 0;
  try {
    value = std::stoul(text, &read, text.compare(0, 2, "0x") == 0 ? 16 : 10);
  } catch (const std::exception&) {
    read = 0;
  }
  constexpr unsigned long kLargest = 0xFFFFFFFF;
  if (read == text.size() && text[0] != '-' && value <= kLargest) {
    return static_cast<std::uint32_t>(value);
  }
  throw contact.required(name).error("found '" + text +
                                     "', expected a whole number of 32 bits, or 0x and one");
}

void read_contact(const Node& contact, Surface& surface) {
  surface.kp_n_per_m = read(contact, "ode/kp", surface.kp_n_per_m, bounds::kStiffness);
  surface.kd_n_s_per_m = read(contact, "ode/kd", surface.kd_n_s_per_m, bounds::kDamping);
  surface.max_correcting_velocity_m_per_s =
      read(contact, "ode/max_vel", surface.max_correcting_velocity_m_per_s, bounds::kMaxVelocity);
  surface.min_depth_m = read(contact, "ode/min_depth", surface.min_depth_m, bounds::kMinDepth);
  surface.collide_without_contact =
      contact.boolean("collide_without_contact", surface.collide_without_contact);
  surface.collide_bitmask = read_mask(contact, "collide_bitmask", surface.collide_bitmask);
  surface.category_bitmask = read_mask(contact, "category_bitmask", surface.collide_bitmask);
}

Collision read_collision(const Node& node, const Pose& X_LC, Geometry geometry) {
  Collision made;
  made.name = node.required_attribute("name");
  made.X_LC = X_LC;
  made.geometry = std::move(geometry);
  made.surface = read_sdf_surface(node);
  made.laser_retro = node.number("laser_retro", 0.0);
  return made;
}

Visual read_visual(const Node& node, const Pose& X_LV, Geometry geometry, Assets& assets) {
  Visual made;
  made.name = node.required_attribute("name");
  made.X_LV = X_LV;
  made.geometry = std::move(geometry);
  if (const auto material = node.child("material")) {
    made.material = read_sdf_material(*material, assets);
  }
  made.cast_shadows = node.boolean("cast_shadows", true);
  made.transparency = node.number("transparency", 0.0, 0.0, 1.0);
  made.laser_retro = node.number("laser_retro", 0.0);
  return made;
}

}  // namespace

double read_friction(const Node& mu, double otherwise) {
  if (mu.text().empty()) return otherwise;
  const double written = mu.to_number(-bounds::kInfinity, bounds::kInfinity);
  return written < 0.0 ? bounds::kInfinity : written;
}

Surface read_sdf_surface(const Node& collision, Surface made) {
  made.max_contacts = collision.integer("max_contacts", made.max_contacts, 0, kMaxContacts);
  const auto surface = collision.child("surface");
  if (!surface) return made;
  if (const auto mu = surface->find("friction/ode/mu")) made.mu = read_friction(*mu, made.mu);
  if (const auto mu = surface->find("friction/ode/mu2")) made.mu2 = read_friction(*mu, made.mu2);
  made.fdir1 = surface->vector3("friction/ode/fdir1", made.fdir1);
  made.slip1 = read(*surface, "friction/ode/slip1", made.slip1, bounds::kSlip);
  made.slip2 = read(*surface, "friction/ode/slip2", made.slip2, bounds::kSlip);
  made.torsional_mu =
      read(*surface, "friction/torsional/coefficient", made.torsional_mu, bounds::kFriction);
  made.use_patch_radius =
      surface->boolean("friction/torsional/use_patch_radius", made.use_patch_radius);
  made.patch_radius_m =
      read(*surface, "friction/torsional/patch_radius", made.patch_radius_m, bounds::kRadius_m);
  made.surface_radius_m =
      read(*surface, "friction/torsional/surface_radius", made.surface_radius_m, bounds::kRadius_m);
  if (const auto contact = surface->child("contact")) read_contact(*contact, made);
  made.restitution =
      read(*surface, "bounce/restitution_coefficient", made.restitution, bounds::kRestitution);
  made.bounce_threshold_m_per_s =
      read(*surface, "bounce/threshold", made.bounce_threshold_m_per_s, bounds::kBounceThreshold);
  return made;
}

PluginDescription read_plugin(const Node& plugin) {
  PluginDescription made;
  made.filename = plugin.required_attribute("filename");
  made.name = plugin.attribute("name", made.filename);
  made.element = plugin.to_element();
  return made;
}

namespace {

/// Types of SDF 1.2 to 1.12.
const std::vector<std::string> kSensorTypes{"air_pressure",
                                            "air_speed",
                                            "altimeter",
                                            "boundingbox_camera",
                                            "camera",
                                            "contact",
                                            "custom",
                                            "depth",
                                            "depth_camera",
                                            "force_torque",
                                            "gps",
                                            "gpu_lidar",
                                            "gpu_ray",
                                            "imu",
                                            "lidar",
                                            "logical_camera",
                                            "magnetometer",
                                            "multicamera",
                                            "navsat",
                                            "none",
                                            "ray",
                                            "rfid",
                                            "rfidtag",
                                            "rgbd",
                                            "rgbd_camera",
                                            "segmentation_camera",
                                            "sonar",
                                            "thermal",
                                            "thermal_camera",
                                            "wide_angle_camera",
                                            "wideanglecamera",
                                            "wireless_receiver",
                                            "wireless_transmitter"};

/// Warns of a type that no sensor has, or whose lens is drawn as another.
void check_type(const Node& sensor, const std::string& type, Log& log) {
  if (std::find(kSensorTypes.begin(), kSensorTypes.end(), type) == kSensorTypes.end()) {
    log.warn(sensor.source(), "found type '" + type + "', expected one of: " +
                                  nearest_names(type, kSensorTypes) + "; its plugin alone counts");
  } else if (type == "wideanglecamera" || type == "wide_angle_camera") {
    log.warn(sensor.source(),
             "found a wide-angle camera, expected a pinhole, as which it is drawn");
  }
}

}  // namespace

SensorDescription read_sensor(const Node& sensor, const Pose& X_LS, Log& log) {
  SensorDescription made;
  made.name = sensor.required_attribute("name");
  made.type = sensor.required_attribute("type");
  check_type(sensor, made.type, log);
  try {
    made.update_rate_hz = sensor.number("update_rate", 0.0);
  } catch (const Error&) {
    made.update_rate_hz = 0.0;  // the sensor's parser reads it again and reports the error
  }
  made.X_LS = X_LS;
  made.element = sensor.to_element();
  sensor.each("plugin", [&made](const Node& node) { made.plugins.push_back(read_plugin(node)); });
  return made;
}

Link read_sdf_link(const Node& link, const SdfFrames& frames, Assets& assets) {
  Link made;
  made.name = link.required_attribute("name");
  made.source = link.source();
  made.X_ML = frames.pose(link);
  made.inertial = read_inertial(link, frames, made.name);
  const auto X_L = [&](const Node& node) { return frames.pose_in(made.name, node); };
  link.each("collision", [&](const Node& node) {
    if (auto geometry = read_sdf_geometry(node, assets)) {
      made.collisions.push_back(read_collision(node, X_L(node), std::move(*geometry)));
    }
  });
  link.each("visual", [&](const Node& node) {
    if (auto geometry = read_sdf_geometry(node, assets)) {
      made.visuals.push_back(read_visual(node, X_L(node), std::move(*geometry), assets));
    }
  });
  link.each("sensor", [&](const Node& node) {
    made.sensors.push_back(read_sensor(node, X_L(node), assets.log()));
  });
  made.gravity = link.boolean("gravity", true);
  made.kinematic = link.boolean("kinematic", false);
  made.self_collide = link.boolean("self_collide", false);
  made.linear_decay = read(link, "velocity_decay/linear", 0.0, bounds::kDecay);
  made.angular_decay = read(link, "velocity_decay/angular", 0.0, bounds::kDecay);
  return made;
}

}  // namespace ardee
