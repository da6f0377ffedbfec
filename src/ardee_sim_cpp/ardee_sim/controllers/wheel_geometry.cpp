// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/wheel_geometry.h"

#include "ardee_sim/core/error.h"

namespace ardee::control {
namespace {

const Joint& find_joint(const Model& model, const std::string& name, const Setting& source) {
  const Joint* joint = model.find_joint(name);
  if (!joint) {
    throw Error(source.path() + ": found nothing, and no joint '" + name +
                "' in the robot's description to take it from");
  }
  return *joint;
}

}  // namespace

std::vector<std::string> joint_names(const Setting& settings, const std::string& key) {
  if (std::holds_alternative<std::string>(settings.at(key).value())) return {settings.text(key)};
  std::vector<std::string> names = settings.texts(key);
  if (names.empty()) {
    throw Error(settings.at(key).path() + ": found an empty list, expected names of joints");
  }
  return names;
}

Eigen::Vector3d joint_origin(const Model& model, const std::string& joint, const Setting& source) {
  const Joint& found = find_joint(model, joint, source);
  return model.find_link(found.child)->X_ML * found.X_CJ.p;
}

double positive(double number, const Setting& source) {
  if (!(number > 0.0)) {
    throw Error(source.path() + ": found " + std::to_string(number) +
                ", expected a number above 0");
  }
  return number;
}

double wheel_radius(const Setting& settings, const Model& model, const std::string& joint,
                    WheelShape shape) {
  const Setting source = settings.at("wheel_radius");
  if (source) return positive(settings.number("wheel_radius"), source);
  const Link& link = *model.find_link(find_joint(model, joint, source).child);
  if (!link.collisions.empty()) {
    const Geometry& geometry = link.collisions.front().geometry;
    if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) return cylinder->radius_m;
    const auto* sphere = std::get_if<Sphere>(&geometry);
    if (sphere && shape == WheelShape::kCylinderOrSphere) return sphere->radius_m;
  }
  throw Error(source.path() + ": found nothing, and link '" + link.name + "' has no collision of " +
              (shape == WheelShape::kCylinder ? "a cylinder" : "a cylinder or a sphere") +
              " to take it from");
}

double read_multiplier(const Setting& settings, const std::string& key) {
  const double multiplier = settings.number(key, 1.0);
  if (multiplier == 0.0) throw Error(settings.path() + "/" + key + ": found 0, expected another");
  return multiplier;
}

}  // namespace ardee::control
