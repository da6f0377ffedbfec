// SPDX-License-Identifier: MIT
#include <filesystem>
#include <set>

#include "ardee_sim/readers/schema.h"
#include "fixture.h"

namespace ardee {
namespace {

using SchemaTest = ReadersTest;

/// The descriptions of SDF that Debian's package sdformat-sdf brings, a folder a version.
const std::string kSpecification = "/usr/share/sdformat12/";

/// Walks all that one version of SDF may hold and compares it with the table.
class SpecificationWalk {
 public:
  explicit SpecificationWalk(const std::string& version)
      : folder_(kSpecification + version + "/") {}

  void run() {
    const bool has_root = std::filesystem::exists(folder_ + "root.sdf");
    const XmlFile file = XmlFile::read(folder_ + (has_root ? "root.sdf" : "gazebo.sdf"), {});
    const std::string name = file.root().attribute("name");
    walk(file.root(), sdf_schema().place(name), name);
  }
  /// "place/name" of all that was met.
  const std::set<std::string>& met() const { return met_; }

 private:
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
    const auto found = place.entries.find(name);
    if (found == place.entries.end()) {
      ADD_FAILURE() << folder_ << ": " << path << "/" << name << " is in no row of '" << place.name
                    << "'";
      return nullptr;
    }
    met_.insert(place.name + "/" + name);
    const Schema::Entry& entry = found->second;
    if (entry.treatment != Treatment::kActs) EXPECT_FALSE(entry.note.empty()) << path << name;
    (void)description;
    return &entry;
  }

  std::string folder_;
  std::set<std::string> met_;
};

const std::vector<std::string> kVersions{"1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9"};

TEST_F(SchemaTest, HasEachElementAndAttributeOfTheSpecificationAtEachPlace) {
  ASSERT_TRUE(std::filesystem::exists(kSpecification)) << "the package sdformat-sdf is missing";
  for (const std::string& version : kVersions) SpecificationWalk(version).run();
}

TEST_F(SchemaTest, HasNothingElseButItsOwnAndWhatIsNewer) {
  std::set<std::string> met;
  for (const std::string& version : kVersions) {
    SpecificationWalk walk(version);
    walk.run();
    met.insert(walk.met().begin(), walk.met().end());
  }
  const std::set<std::string> kOthers{
      // ARDEE's own
      "include/ardee:scale", "include/ardee:label", "model/ardee:instances",
      // SDF 1.10 to 1.12
      "light/visualize", "light/light_on"};
  for (const auto& [name, place] : sdf_schema().places()) {
    for (const auto& [child, entry] : place.entries) {
      const std::string path = name + "/" + child;
      EXPECT_TRUE(met.count(path) || kOthers.count(path)) << path << " is in no version of SDF";
    }
  }
}

}  // namespace
}  // namespace ardee
