// SPDX-License-Identifier: MIT
#include "ardee_sim/description/setting.h"

#include "ardee_sim/core/error.h"

namespace ardee {
namespace {

std::string found(const Setting& setting) {
  struct Describe {
    std::string operator()(std::monostate) const { return "nothing"; }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(int value) const { return "the integer " + std::to_string(value); }
    std::string operator()(double value) const { return "the number " + std::to_string(value); }
    std::string operator()(const std::string& value) const { return "'" + value + "'"; }
    std::string operator()(const Setting::List& list) const {
      return "a list of " + std::to_string(list.size());
    }
    std::string operator()(const Setting::Map& map) const {
      return "a group of " + std::to_string(map.size());
    }
  };
  return std::visit(Describe(), setting.value());
}

Error mismatch(const Setting& setting, const std::string& expected) {
  return Error(setting.path() + ": found " + found(setting) + ", expected " + expected);
}

double to_number(const Setting& setting) {
  if (const auto* number = std::get_if<double>(&setting.value())) return *number;
  if (const auto* integer = std::get_if<int>(&setting.value())) return *integer;
  throw mismatch(setting, "a number");
}

template <typename T>
const T& as(const Setting& setting, const std::string& expected) {
  if (const auto* value = std::get_if<T>(&setting.value())) return *value;
  throw mismatch(setting, expected);
}

}  // namespace

Setting Setting::at(const std::string& relative_path) const {
  const std::string full = path_ == "/" ? path_ + relative_path : path_ + "/" + relative_path;
  const auto* map = std::get_if<Map>(&value_);
  if (!map) return {full, {}};
  // a key of a file may itself contain slashes
  for (const auto& [key, setting] : *map) {
    if (key == relative_path) return setting;
    if (relative_path.compare(0, key.size() + 1, key + "/") == 0) {
      const Setting below = setting.at(relative_path.substr(key.size() + 1));
      if (below) return below;
    }
  }
  return {full, {}};
}

double Setting::number(const std::string& name) const { return to_number(at(name)); }

double Setting::number(const std::string& name, double fallback) const {
  const Setting setting = at(name);
  return setting ? to_number(setting) : fallback;
}

int Setting::integer(const std::string& name, int fallback) const {
  const Setting setting = at(name);
  return setting ? as<int>(setting, "an integer") : fallback;
}

bool Setting::boolean(const std::string& name, bool fallback) const {
  const Setting setting = at(name);
  return setting ? as<bool>(setting, "true or false") : fallback;
}

std::string Setting::text(const std::string& name) const {
  const Setting setting = at(name);
  return as<std::string>(setting, "a text");
}

std::string Setting::text(const std::string& name, const std::string& fallback) const {
  return has(name) ? text(name) : fallback;
}

const Setting::List& Setting::list(const std::string& expected) const {
  return as<List>(*this, expected);
}

const Setting::Map& Setting::group(const std::string& expected) const {
  return as<Map>(*this, expected);
}

std::vector<std::string> Setting::texts(const std::string& name) const {
  const Setting setting = at(name);
  std::vector<std::string> all;
  for (const Setting& each : as<List>(setting, "a list of names")) {
    all.push_back(as<std::string>(each, "a name"));
  }
  return all;
}

std::vector<double> Setting::exact_doubles(const std::string& name, std::size_t count) const {
  const std::string expected = "a list of " + std::to_string(count) + " numbers";
  const Setting setting = at(name);
  const List& list = as<List>(setting, expected);
  if (list.size() != count) throw mismatch(setting, expected);
  std::vector<double> all;
  for (const Setting& each : list) {
    all.push_back(as<double>(each, "a number with a point, as 0.0 or 1.0e6"));
  }
  return all;
}

}  // namespace ardee
