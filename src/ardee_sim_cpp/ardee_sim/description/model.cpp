// SPDX-License-Identifier: MIT
#include "ardee_sim/description/model.h"

#include <algorithm>

namespace ardee {
namespace {

template <typename Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

struct JointMotion {
  std::size_t axes;
  bool turns;
  bool has_limits;
};

JointMotion motion_of(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return {1, true, true};
    case JointType::kContinuous:
      return {1, true, false};
    case JointType::kPrismatic:
    case JointType::kScrew:
      return {1, false, true};
    case JointType::kUniversal:
    case JointType::kRevolute2:
      return {2, false, true};
    case JointType::kFixed:
    case JointType::kBall:
      break;
  }
  return {0, false, false};
}

}  // namespace

std::size_t axis_count(JointType type) { return motion_of(type).axes; }

bool turns(JointType type) { return motion_of(type).turns; }

bool has_limits(JointType type) { return motion_of(type).has_limits; }

const Link* Model::find_link(const std::string& link_name) const {
  return find_named(links, link_name);
}

const Joint* Model::find_joint(const std::string& joint_name) const {
  return find_named(joints, joint_name);
}

std::optional<NamedFrame> Model::find_frame(const std::string& frame_name) const {
  if (const Link* link = find_link(frame_name))
    return NamedFrame{frame_name, link->X_ML, link->name};
  if (const Joint* joint = find_joint(frame_name)) {
    const Link* child = find_link(joint->child);
    if (child) return NamedFrame{frame_name, child->X_ML * joint->X_CJ, child->name};
  }
  if (const NamedFrame* frame = find_named(frames, frame_name)) return *frame;
  for (const Instance& instance : instances) {
    const std::string prefix = instance.name + "::";
    if (frame_name == instance.name) return NamedFrame{frame_name, instance.pose, "", true};
    if (frame_name.compare(0, prefix.size(), prefix) != 0) continue;
    const auto inside = instance.model->find_frame(frame_name.substr(prefix.size()));
    if (inside) {
      return NamedFrame{frame_name, instance.pose * inside->X_MF, "", inside->is_model};
    }
  }
  return std::nullopt;
}

}  // namespace ardee
