// SPDX-License-Identifier: MIT
#pragma once

#include <tinyxml2.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/element.h"
#include "ardee_sim/description/material.h"

namespace ardee {

/// One element of a parsed document with typed access to its contents. A value that does not parse
/// or lies outside its bounds is an Error with file, line and element. Cheap to copy; valid as long
/// as its XmlFile.
class Node {
 public:
  Node(const tinyxml2::XMLElement& element, const std::string& file)
      : element_(&element), file_(&file) {}

  std::string_view name() const { return element_->Name(); }
  const std::string& file() const { return *file_; }
  int line() const { return element_->GetLineNum(); }
  Source source() const { return {*file_, line(), std::string(name())}; }
  Error error(const std::string& what) const { return Error(source(), what); }

  std::optional<Node> child(const char* name) const;
  /// The child at the end of a path "a/b/c".
  std::optional<Node> find(std::string_view path) const;
  Node required(const char* name) const;
  /// Calls visit(Node) for each child element, or each one of that name.
  template <typename Visit>
  void each(const char* child_name, Visit visit) const {
    for (const auto* e = element_->FirstChildElement(child_name); e;
         e = e->NextSiblingElement(child_name)) {
      visit(Node(*e, *file_));
    }
  }
  template <typename Visit>
  void each(Visit visit) const {
    each(nullptr, visit);
  }

  /// Calls visit(name, value) for each attribute, both as strings.
  template <typename Visit>
  void each_attribute(Visit visit) const {
    for (const auto* a = element_->FirstAttribute(); a; a = a->Next()) {
      visit(std::string(a->Name()), std::string(a->Value()));
    }
  }
  bool has_attribute(const char* name) const { return element_->Attribute(name) != nullptr; }
  std::string attribute(const char* name, const std::string& fallback = "") const;
  /// A text that is not empty; throws Error otherwise.
  std::string required_attribute(const char* name) const;
  /// From `least` to `most` numbers of an attribute; none if it is absent or empty.
  std::vector<double> attribute_numbers(const char* name, std::size_t least, std::size_t most,
                                        double low = -limits::kAbsurd,
                                        double high = limits::kAbsurd) const;
  double attribute_number(const char* name, double fallback, double low = -limits::kAbsurd,
                          double high = limits::kAbsurd) const;
  Eigen::Vector3d attribute_vector3(const char* name, const Eigen::Vector3d& fallback) const;

  /// All text directly inside, trimmed; for an empty element its attribute "value".
  std::string text() const;
  std::string required_text() const;
  /// A number, infinite only if the bounds are.
  double to_number(double low = -limits::kAbsurd, double high = limits::kAbsurd) const;
  /// A number that may be infinite; magnitudes from 1e15 on count as infinite.
  double to_limit() const;
  int to_integer(int low, int high) const;
  bool to_boolean() const;
  Eigen::Vector2d to_vector2() const;
  Eigen::Vector3d to_vector3() const;
  /// Pose in the frame that the attribute relative_to names (SdfFrames).
  Pose to_pose() const;
  Color to_color() const;

  // The values above for a child (or the element at a path "a/b"), with a default if it is absent
  // or empty.
  std::string text(std::string_view path, const std::string& fallback) const;
  double number(std::string_view path, double fallback, double low = -limits::kAbsurd,
                double high = limits::kAbsurd) const;
  double limit(std::string_view path, double fallback) const;
  int integer(std::string_view path, int fallback, int low, int high) const;
  bool boolean(std::string_view path, bool fallback) const;
  Eigen::Vector3d vector3(std::string_view path, const Eigen::Vector3d& fallback) const;
  /// Pose in <pose>; an absent or empty one is the identity. Throws Error if it is relative to
  /// another frame.
  Pose pose() const;
  Color color(std::string_view path, const Color& fallback) const;

  /// The element and all below it as plain data.
  Element to_element() const;

 private:
  /// From `least` to `most` numbers of magnitude up to limits::kAbsurd; `what` describes them in
  /// messages.
  std::vector<double> to_numbers(std::size_t least, std::size_t most, const char* what) const;
  /// The element at the end of a path, if it has text.
  std::optional<Node> find_filled(std::string_view path) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

/// A parsed XML document and its name in messages.
class XmlFile {
 public:
  /// Throws Error if the text is not well-formed XML with one root, or if plain_xml refuses it.
  XmlFile(const std::string& text, const std::string& name);
  static XmlFile read(const std::string& path, const Source& source);
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  Node root() const { return Node(*document_.RootElement(), name_); }

 private:
  tinyxml2::XMLDocument document_;
  std::string name_;
};

}  // namespace ardee
