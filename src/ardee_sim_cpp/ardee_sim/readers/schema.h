// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Treatment of an element or attribute.
enum class Treatment {
  kActs,
  kSettled,   // nothing to do: it is the behaviour anyway, or Gazebo ignores it too
  kNoEffect,  // known, but without effect here: a warning
  kElsewhere  // left to another parser (a plugin's)
};

/// Their short names, for tables.
namespace treatments {
inline constexpr Treatment acts = Treatment::kActs;
inline constexpr Treatment settled = Treatment::kSettled;
inline constexpr Treatment no_effect = Treatment::kNoEffect;
inline constexpr Treatment elsewhere = Treatment::kElsewhere;
}  // namespace treatments

/// One line of a table of elements.
struct SchemaRow {
  const char* place;  // the parent; "joint/physics" if its name alone is ambiguous
  Treatment treatment;
  const char* names;      // of child elements and @attributes
  const char* note = "";  // reason of no effect or of settled; effect, if it is not obvious
  /// Values of an element without effect that give no warning: its default, or the behaviour here
  /// anyway. Alternatives are separated by |.
  const char* harmless = "";
};

/// Elements and attributes that may stand in each element, and their treatment.
class Schema {
 public:
  struct Place;
  /// Entry of a name at a place.
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

  /// `format` is its name in messages. `base` holds the places that these rows refer to but do not
  /// define.
  Schema(const char* format, const std::vector<SchemaRow>& rows, const Schema* base = nullptr);
  Schema(const Schema&) = delete;
  Schema& operator=(const Schema&) = delete;

  /// Warns of names that are unknown or without effect in `node`, a root or an element whose row
  /// has the name `place`. Names in a foreign XML namespace are skipped.
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
/// URDF without the contents of <gazebo> blocks.
const Schema& urdf_schema();
/// Contents of a URDF's <gazebo> block by its subject: "gazebo link", "gazebo joint" or "gazebo
/// robot".
const Schema& gazebo_schema();

}  // namespace ardee
