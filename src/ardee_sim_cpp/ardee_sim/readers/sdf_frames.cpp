// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_frames.h"

#include <set>

#include "ardee_sim/core/nearest_names.h"

namespace ardee {
namespace {

/// Greatest depth of nested frames; a greater depth counts as a cycle.
constexpr std::size_t kDeepest = 1000;
/// Greatest number of names in a message.

/// The <pose> of an element, if it is not empty.
std::optional<Node> pose_of(const Node& element) {
  const auto pose = element.child("pose");
  if (!pose || (pose->text().empty() && pose->attribute("relative_to").empty())) return {};
  return pose;
}

Pose own_pose(const std::optional<Node>& pose) {
  return pose && !pose->text().empty() ? pose->to_pose() : Pose{};
}

std::string relative_to(const std::optional<Node>& pose) {
  return pose ? pose->attribute("relative_to") : "";
}

/// "model::link" at the first pair of colons; the second part is empty if there is none.
std::pair<std::string, std::string> split_scope(const std::string& name) {
  const std::size_t colons = name.find("::");
  if (colons == std::string::npos) return {name, ""};
  return {name.substr(0, colons), name.substr(colons + 2)};
}

}  // namespace

void SdfFrames::add(const Node& element, const std::string& name, const std::string& base,
                    const std::string& body) {
  const auto pose = pose_of(element);
  const std::string other = relative_to(pose);
  frames_.emplace(name, Frame{own_pose(pose), other.empty() ? base : other, body});
}

void SdfFrames::add_child(const Node& child) {
  const std::string name = child.attribute("name");
  if (child.name() == "link") {
    add(child, name, root_);
  } else if (child.name() == "frame") {
    const std::string attached_to = child.attribute("attached_to");
    const std::string& body = attached_to.empty() ? root_ : attached_to;
    add(child, name, body, body);
  } else if (child.name() == "joint") {
    const std::string held = child.text("child", "");
    add(child, name, held, held);
  }
}

void SdfFrames::add(const std::string& name, const Pose& X_R) {
  frames_.emplace(name, Frame{X_R, root_, ""});
}

void SdfFrames::add_model(const std::string& name, const Node& element,
                          const std::optional<Pose>& X_MP, std::shared_ptr<const Model> model) {
  const auto pose = pose_of(element);
  const std::string other = relative_to(pose);
  const Pose X_BP = own_pose(pose);
  frames_.emplace(name,
                  Frame{X_MP ? X_BP * X_MP->inverse() : X_BP, other.empty() ? root_ : other, ""});
  models_.emplace(name, std::move(model));
}

void SdfFrames::add_model(const std::string& name, const Pose& X_RM,
                          std::shared_ptr<const Model> model) {
  add(name, X_RM);
  models_.emplace(name, std::move(model));
}

void SdfFrames::add_merged(const std::string& name, const Model& model) {
  const auto add_frame = [&](const NamedFrame& frame) {
    const std::string body = frame.link.empty() ? model.canonical_link : frame.link;
    frames_.emplace(frame.name, Frame{frame.X_MF, name, body == frame.name ? "" : body});
  };
  for (const Link& link : model.links) add_frame({link.name, link.X_ML, link.name});
  for (const Joint& joint : model.joints) {
    frames_.emplace(joint.name, Frame{joint.X_CJ, joint.child, joint.child});
  }
  for (const NamedFrame& frame : model.frames) add_frame(frame);
}

Pose SdfFrames::pose(const Node& element, const std::string& base) const {
  const auto pose = pose_of(element);
  const std::string other = relative_to(pose);
  const std::string& from = other.empty() ? base : other;
  return from == root_ ? own_pose(pose) : find(from, pose ? *pose : element) * own_pose(pose);
}

Pose SdfFrames::pose_in(const std::string& base, const Node& element) const {
  const auto pose = pose_of(element);
  const std::string other = relative_to(pose);
  if (other.empty() || other == base) return own_pose(pose);
  return find(base, element).inverse() * this->pose(element);
}

Pose SdfFrames::find(const std::string& name, const Node& asker) const {
  return find(name, asker, 0);
}

Pose SdfFrames::find(const std::string& name, const Node& asker, std::size_t depth) const {
  if (name == root_) return {};
  const auto found = frames_.find(name);
  if (found == frames_.end()) return nested_frame(name, asker, depth);
  if (depth > kDeepest) {
    throw asker.error("found that frame '" + name + "' lies in itself, or in more than " +
                      std::to_string(kDeepest) + " others, expected fewer");
  }
  const Frame& frame = found->second;
  return frame.base == root_ ? frame.pose : find(frame.base, asker, depth + 1) * frame.pose;
}

Pose SdfFrames::nested_frame(const std::string& name, const Node& asker, std::size_t depth) const {
  const auto [scope, rest] = split_scope(name);
  const auto model = models_.find(scope);
  const auto frame = model != models_.end() ? model->second->find_frame(rest) : std::nullopt;
  if (frame) return find(scope, asker, depth + 1) * frame->X_MF;
  std::set<std::string> known{root_};
  for (const auto& each : frames_) known.insert(each.first);
  throw asker.error("found frame '" + name + "', expected one of " +
                    nearest_names(name, {known.begin(), known.end()}));
}

std::string SdfFrames::body_of(const std::string& name) const {
  std::string body = name;
  for (std::size_t steps = 0; steps <= kDeepest; ++steps) {
    const auto model = models_.find(body);
    if (model != models_.end()) return body + "::" + model->second->canonical_link;
    const auto found = frames_.find(body);
    if (found == frames_.end() || found->second.body.empty()) break;
    body = found->second.body;
  }
  const auto [scope, rest] = split_scope(body);
  const auto model = models_.find(scope);
  const auto frame = model != models_.end() ? model->second->find_frame(rest) : std::nullopt;
  if (frame) {
    body = scope + "::" + (frame->link.empty() ? model->second->canonical_link : frame->link);
  }
  return body == root_ ? "" : body;
}

std::vector<NamedFrame> SdfFrames::named_frames(const Node& parent) const {
  std::vector<NamedFrame> made;
  std::unordered_map<std::string, std::size_t> before;  // shortens the search for frames below them
  parent.each("frame", [&](const Node& node) {
    const std::string name = node.required_attribute("name");
    const Frame& frame = frames_.at(name);
    const auto base = before.find(frame.base);
    const auto carrier = before.find(frame.body);
    const bool is_known = base != before.end() && carrier != before.end();
    made.push_back({name, is_known ? made[base->second].X_MF * frame.pose : find(name, node),
                    is_known ? made[carrier->second].link : body_of(name)});
    before.emplace(name, made.size() - 1);
  });
  return made;
}

}  // namespace ardee
