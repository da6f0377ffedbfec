// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// What becomes of an element or attribute.
enum class Treatment {
  kActs,
  kSettled,   // nothing to do: it asks for what happens anyway, or Gazebo does nothing with it too
  kNoEffect,  // known and without effect here, which is a warning
  kElsewhere  // left to whoever knows what it holds (a plugin)
};

/// One line of a table of elements.
struct SchemaRow {
  const char* place;  // the parent; "joint/physics" where its name alone means two things
  Treatment treatment;
  const char* names;      // of child elements and @attributes
  const char* note = "";  // why it is without effect or settled; of what acts: how, if not plain
  /// What those without effect may say without a warning: their default, or what happens here
  /// anyway. Alternatives are separated by |.
  const char* harmless = "";
};

/// Which elements and attributes may stand in which, and what becomes of them.
class Schema {
 public:
  struct Place;
  /// What is known of a name at a place.
  struct Entry {
    Treatment treatment = Treatment::kActs;
    std::string note;
    std::vector<std::string> harmless;
    const Place* inside = nullptr;  // of an element that acts
  };
  struct Place {
    std::string name;  // as in the rows
    bool is_elsewhere = false;
    std::map<std::string, Entry, std::less<>> entries;
  };

  /// `format`: its name in messages. `base` has the places that these rows name and do not have.
  Schema(const char* format, const std::vector<SchemaRow>& rows, const Schema* base = nullptr);
  Schema(const Schema&) = delete;
  Schema& operator=(const Schema&) = delete;

  /// Warns of what is unknown or without effect in `node`, a root or what a row calls `place`. What
  /// has a foreign XML namespace is left to its owners.
  void check(const Node& node, const std::string& place, Log& log) const;
  void check(const Node& root, Log& log) const { check(root, std::string(root.name()), log); }
  /// The place of that name; throws std::logic_error if there is none.
  const Place& place(const std::string& name) const;
  const std::map<std::string, Place>& places() const { return places_; }
  const std::vector<SchemaRow>& rows() const { return rows_; }

 private:
  const Place* find(const std::string& name) const;
  void link_up(Place& place);
  void check_inside(const Node& node, const Place& place, Log& log) const;

  std::string format_;
  std::vector<SchemaRow> rows_;
  const Schema* base_;
  std::map<std::string, Place> places_;
};

/// SDF 1.2 to 1.12 and ARDEE's own elements.
const Schema& sdf_schema();
/// URDF without what is in <gazebo> blocks.
const Schema& urdf_schema();
/// What a URDF's <gazebo> block may hold, by what it is about: "gazebo link", "gazebo joint" or
/// "gazebo robot".
const Schema& gazebo_schema();

}  // namespace ardee
