// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// The named frames of a model or world, each placed in another by its <pose>'s relative_to (SDF
/// 1.7, http://sdformat.org/tutorials?tut=pose_frame_semantics). They are looked up when all are
/// known, so that their order in the file does not matter. X_R is a pose in the root, the frame of
/// the model or world.
class SdfFrames {
 public:
  /// `root` is the name of the root, "__model__" or "world".
  explicit SdfFrames(std::string root) : root_(std::move(root)) {}

  /// Adds a link, frame, joint or model at its <pose>, in `base` unless the pose names another
  /// frame; `body` is the link that it moves with (empty: it is a body itself).
  void add(const Node& element, const std::string& name, const std::string& base,
           const std::string& body = "");
  /// Adds `child` if it is a link, joint or frame; ignores other elements.
  void add_child(const Node& child);
  void add_children(const Node& parent) {
    parent.each([this](const Node& child) { add_child(child); });
  }
  void add(const std::string& name, const Pose& X_R);
  /// Adds a nested model, with its links and other frames as name::link. The <pose> of its element
  /// places its frame X_MP.
  void add_model(const std::string& name, const Node& element, const std::optional<Pose>& X_MP,
                 std::shared_ptr<const Model> model);
  void add_model(const std::string& name, const Pose& X_RM, std::shared_ptr<const Model> model);
  /// Adds the links and other frames of `model`, which was added as `name`, also without the
  /// prefix.
  void add_merged(const std::string& name, const Model& model);

  /// X_R of an element by its <pose>, given in `base` unless the pose names another frame.
  Pose pose(const Node& element, const std::string& base) const;
  Pose pose(const Node& element) const { return pose(element, root_); }
  /// Pose of an element in `base`.
  Pose pose_in(const std::string& base, const Node& element) const;
  /// X_R of a frame; throws Error at `asker` if the name is unknown or the frame depends on itself.
  Pose find(const std::string& name, const Node& asker) const;
  /// The link that a frame moves with; "" for the root; an unknown name is returned as it is.
  std::string body_of(const std::string& name) const;
  /// Returns the <frame>s among the children of `parent`.
  std::vector<NamedFrame> named_frames(const Node& parent) const;

 private:
  struct Frame {
    Pose pose;
    std::string base;  // empty: the root
    std::string body;
  };

  Pose find(const std::string& name, const Node& asker, std::size_t depth) const;
  Pose nested_frame(const std::string& name, const Node& asker, std::size_t depth) const;

  std::string root_;
  std::unordered_map<std::string, Frame> frames_;
  std::unordered_map<std::string, std::shared_ptr<const Model>> models_;
};

}  // namespace ardee
