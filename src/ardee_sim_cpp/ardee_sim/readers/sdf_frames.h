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

/// The named frames of a model or world, each placed in another by its <pose>'s relative_to
/// (SDF 1.7, http://sdformat.org/tutorials?tut=pose_frame_semantics). They are looked up when all
/// are known, so that their order in the file does not matter. X_R: in the frame of the model or
/// world, the root.
class SdfFrames {
 public:
  /// `root`: its own name, "__model__" or "world".
  explicit SdfFrames(std::string root) : root_(std::move(root)) {}

  /// A link, frame, joint or model: where its <pose> puts it, in `base` unless that names another;
  /// `body` is what it moves with (empty: it is a body itself).
  void add(const Node& element, const std::string& name, const std::string& base,
           const std::string& body = "");
  /// A link, joint or frame; nothing else.
  void add_child(const Node& child);
  void add_children(const Node& parent) {
    parent.each([this](const Node& child) { add_child(child); });
  }
  void add(const std::string& name, const Pose& X_R);
  /// A model within, with its links and other frames, as name::link. The <pose> of its element
  /// places its frame X_MP.
  void add_model(const std::string& name, const Node& element, const std::optional<Pose>& X_MP,
                 std::shared_ptr<const Model> model);
  void add_model(const std::string& name, const Pose& X_RM, std::shared_ptr<const Model> model);
  /// The links and other frames of `model`, which was added as `name`, by their own names too.
  void add_merged(const std::string& name, const Model& model);

  /// X_R of an element: of its <pose>, given in `base` unless that names another frame.
  Pose pose(const Node& element, const std::string& base) const;
  Pose pose(const Node& element) const { return pose(element, root_); }
  /// The same in `base` itself.
  Pose pose_in(const std::string& base, const Node& element) const;
  /// X_R of a frame; an Error at `asker` if there is none of that name or it lies in itself.
  Pose find(const std::string& name, const Node& asker) const;
  /// The link that a frame moves with; "" is the root's own; a name that is unknown is its own.
  std::string body_of(const std::string& name) const;
  /// The <frame>s among the children of `parent`.
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
