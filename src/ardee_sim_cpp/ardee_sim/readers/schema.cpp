// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/schema.h"

#include <charconv>
#include <set>
#include <sstream>
#include <stdexcept>

namespace ardee {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// Normal form of a word for comparison: numbers by value, booleans as 0 and 1.
std::string canonical(const std::string& word) {
  if (word == "true" || word == "True") return "1";
  if (word == "false" || word == "False") return "0";
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, status] = std::from_chars(word.data(), end, value);
  if (status != std::errc() || stop != end) return word;
  std::ostringstream text;
  text << value + 0.0;  // not -0
  return text.str();
}

bool says_the_same(const std::string& one, const std::string& other) {
  std::istringstream first(one);
  std::istringstream second(other);
  std::string a, b;
  while (first >> a) {
    if (!(second >> b) || canonical(a) != canonical(b)) return false;
  }
  return !(second >> b);
}

/// Elements of which one counts, in each format.
const std::set<std::string, std::less<>> kOnce{
    "pose", "inertial", "geometry", "gravity", "static", "mass",     "inertia",
    "axis", "limit",    "origin",   "parent",  "child",  "dynamics", "mimic"};
/// Elements of SDF whose names tell them from their siblings; for others somebody else checks it.
const std::set<std::string, std::less<>> kNamed{"collision", "visual", "sensor", "light"};

/// Warns of elements of which only the first counts, and of siblings of one name.
void warn_of_repeats(const Node& node, bool is_sdf, Log& log) {
  std::set<std::string> seen;
  node.each([&](const Node& child) {
    const std::string kind(child.name());
    const std::string name = child.attribute("name");
    if (kOnce.count(kind) != 0 && !seen.insert(kind).second) {
      log.warn(child.source(), "found a second one in <" + std::string(node.name()) +
                                   ">, expected one: only the first counts");
    } else if (is_sdf && kNamed.count(kind) != 0 && !name.empty() &&
               !seen.insert(kind + ' ' + name).second) {
      log.warn(child.source(), "found a second one of the name '" + name + "', expected another");
    }
  });
}

bool is_harmless(const std::string& text, const Schema::Entry& entry) {
  for (const std::string& each : entry.harmless) {
    if (text.empty() || says_the_same(text, each)) return true;
  }
  return false;
}

}  // namespace

Schema::Schema(const char* format, const std::vector<SchemaRow>& rows, const Schema* base)
    : format_(format), rows_(rows), base_(base) {
  for (const SchemaRow& row : rows) {
    Place& place = places_[row.place];
    place.name = row.place;
    if (row.treatment == Treatment::kElsewhere) place.is_elsewhere = true;
    std::istringstream names(row.names);
    for (std::string name; names >> name;) {
      const Entry entry{row.treatment, row.note, split(row.harmless, '|'), nullptr};
      if (!place.entries.emplace(name, entry).second) {
        throw std::logic_error(place.name + " has two rows for " + name);
      }
    }
  }
  for (auto& [name, place] : places_) link_up(place);
}

/// Finds the place of each element: the longest place name that ends its path counts.
void Schema::link_up(Place& place) {
  for (auto& [name, entry] : place.entries) {
    if (name[0] == '@' || entry.treatment != Treatment::kActs) continue;
    std::string path = place.name + "/" + name;
    while (!(entry.inside = find(path))) {
      const std::size_t slash = path.find('/');
      if (slash == std::string::npos) break;
      path.erase(0, slash + 1);
    }
  }
}

const Schema::Place* Schema::find(const std::string& name) const {
  const auto found = places_.find(name);
  if (found != places_.end()) return &found->second;
  return base_ ? base_->find(name) : nullptr;
}

const Schema::Place& Schema::place(const std::string& name) const {
  if (const Place* found = find(name)) return *found;
  throw std::logic_error("no place '" + name + "' in the table of " + format_);
}

void Schema::check(const Node& node, const std::string& place_name, Log& log) const {
  check_inside(node, place(place_name), log);
}

void Schema::check_inside(const Node& node, const Place& inside, Log& log) const {
  const std::string of = "<" + std::string(node.name()) + "> in " + format_;
  node.each_attribute([&](const std::string& name, const std::string& value) {
    const auto known = inside.entries.find("@" + name);
    if (known == inside.entries.end()) {
      if (name == "value" && node.text() == node.attribute("value"))
        return;  // stands for the element's text
      if (!is_foreign(name))
        log.warn(node.source(), "'" + name + "' is no attribute of " + of + ", ignored");
    } else if (known->second.treatment == Treatment::kNoEffect && !value.empty() &&
               !is_harmless(value, known->second)) {
      log.warn(node.source(), "attribute '" + name + "' has no effect: " + known->second.note);
    }
  });
  if (inside.is_elsewhere) return;
  warn_of_repeats(node, format_ == "SDF", log);
  node.each([&](const Node& child) {
    const auto known = inside.entries.find(child.name());
    if (known == inside.entries.end()) {
      if (!is_foreign(child.name()))
        log.warn(child.source(), "not an element of " + of + ", ignored");
      return;
    }
    const Entry& entry = known->second;
    if (entry.treatment == Treatment::kActs) {
      static const Place kLeaf;
      check_inside(child, entry.inside ? *entry.inside : kLeaf, log);
    } else if (entry.treatment == Treatment::kNoEffect && !is_harmless(child.text(), entry)) {
      log.warn(child.source(), "has no effect: " + entry.note);
    }
  });
}

}  // namespace ardee
