// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "ardee_sim/readers/schema.h"

namespace ardee {

/// Walks through all elements of one version of SDF, by the descriptions in Debian's package
/// sdformat-sdf, and expects each element and attribute in the table at its place.
class SpecificationWalk {
 public:
  explicit SpecificationWalk(const std::string& version) : folder_(root() + version + "/") {
    EXPECT_TRUE(std::filesystem::exists(folder_)) << "the package sdformat-sdf is missing";
    const bool has_root = std::filesystem::exists(folder_ + "root.sdf");
    const XmlFile file = XmlFile::read(folder_ + (has_root ? "root.sdf" : "gazebo.sdf"), {});
    const std::string name = file.root().attribute("name");
    walk(file.root(), sdf_schema().place(name), name);
  }

  static const std::vector<std::string>& versions() {
    static const std::vector<std::string> all{"1.2", "1.3", "1.4", "1.5",
                                              "1.6", "1.7", "1.8", "1.9"};
    return all;
  }
  /// Set of "place/name" of all visited entries.
  const std::set<std::string>& met() const { return met_; }
  /// Visited entries that act and hold a number, a switch, or several numbers.
  const std::set<std::string>& acting_numbers() const { return acting_numbers_; }

 private:
  static std::string root() { return "/usr/share/sdformat12/"; }

  void walk(const Node& element, const Schema::Place& place, const std::string& path) {
    if (place.is_elsewhere) return;
    element.each("attribute", [&](const Node& attribute) {
      require(place, "@" + attribute.attribute("name"), attribute, path);
    });
    element.each("element", [&](const Node& child) {
      if (!child.has_attribute("copy_data")) enter(child, place, path);
    });
    element.each("include", [&](const Node& include) {
      const std::string file = folder_ + include.attribute("filename");
      // SDF 1.7 to 1.9 name a navsat.sdf that their package does not have.
      if (std::filesystem::exists(file)) enter(XmlFile::read(file, {}).root(), place, path);
    });
  }

  void enter(const Node& child, const Schema::Place& place, const std::string& path) {
    static const Schema::Place kLeaf;
    const std::string name = child.attribute("name");
    const Schema::Entry* entry = require(place, name, child, path);
    const bool recurs = child.has_attribute("ref");
    if (!entry || recurs || entry->treatment != Treatment::kActs) return;
    walk(child, entry->inside ? *entry->inside : kLeaf, path + "/" + name);
  }

  const Schema::Entry* require(const Schema::Place& place, const std::string& name,
                               const Node& description, const std::string& path) {
    static const std::set<std::string> kNumbers{"double", "float",   "int",      "unsigned int",
                                                "bool",   "vector3", "vector2d", "vector2i",
                                                "color",  "pose",    "time"};
    const auto found = place.entries.find(name);
    if (found == place.entries.end()) {
      ADD_FAILURE() << folder_ << ": " << path << "/" << name << " is in no row of '" << place.name
                    << "'";
      return nullptr;
    }
    const std::string where = place.name + "/" + name;
    met_.insert(where);
    const Schema::Entry& entry = found->second;
    const bool is_number = kNumbers.count(description.attribute("type")) != 0;
    if (entry.treatment == Treatment::kActs && is_number) acting_numbers_.insert(where);
    return &entry;
  }

  std::string folder_;
  std::set<std::string> met_;
  std::set<std::string> acting_numbers_;
};

}  // namespace ardee
