// SPDX-License-Identifier: MIT
#include "ardee_sim/description/parameters.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace ardee {
namespace {

std::string in_words(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

std::optional<double> to_double(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  double value = 0.0;
  auto [stop, status] = std::from_chars(word.data(), end, value);
  if (status != std::errc()) return std::nullopt;
  if (stop != end && (*stop == 'f' || *stop == 'F')) ++stop;
  return stop == end ? std::optional<double>(value) : std::nullopt;
}

double parse_number(const std::string& text, const Source& source) {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first != std::string::npos) {
    const std::size_t count = text.find_last_not_of(kSpace) - first + 1;
    const auto value = to_double(std::string_view(text).substr(first, count));
    if (value && std::isfinite(*value)) return *value;
  }
  throw Error(source, "found " + in_quotes(text) + ", expected a finite number");
}

bool parse_boolean(const std::string& text, const Source& source) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "true" || lower == "1") return true;
  if (lower == "false" || lower == "0") return false;
  throw Error(source, "found " + in_quotes(text) + ", expected true or false");
}

Eigen::Vector3d parse_vector3(const std::string& text, const Source& source) {
  std::istringstream stream(text);
  std::string x, y, z, rest;
  if (!(stream >> x >> y >> z) || (stream >> rest)) {
    throw Error(source, "found " + in_quotes(text) + ", expected three numbers");
  }
  return {parse_number(x, source), parse_number(y, source), parse_number(z, source)};
}

void Parameters::note(const AskedKey& key) const {
  if (element_.key_log) element_.key_log->add(key);
}

void Parameters::ignore(const std::set<std::string>& keys) {
  known_.insert(keys.begin(), keys.end());
  for (const std::string& key : keys) note({key, "", "", false, true});
}

const Element* Parameters::find(const std::string& key) {
  known_.insert(key);
  note({key, "", ""});
  return element_.child(key);
}

const Element* Parameters::find_value(const std::string& key) {
  with_one_value_.insert(key);
  return find(key);
}

const Element* Parameters::find_filled(const std::string& key) {
  const Element* child = find_value(key);
  return child && !child->text.empty() ? child : nullptr;
}

bool Parameters::has(const std::string& key) { return find(key) != nullptr; }

std::string Parameters::text(const std::string& key, const std::string& fallback) {
  note({key, "text", fallback});
  const Element* child = find_value(key);
  return child ? child->text : fallback;
}

std::string Parameters::required_text(const std::string& key) {
  note({key, "text", "", true});
  const Element* child = find_value(key);
  if (!child || child->text.empty()) {
    throw Error(element_.source, "found no <" + key + ">, expected one");
  }
  return child->text;
}

double Parameters::number(const std::string& key, double fallback, double low, double high) {
  note({key, "number", in_words(fallback)});
  const Element* child = find_filled(key);
  if (!child) return fallback;
  const double value = parse_number(child->text, child->source);
  if (value < low || value > high) {
    std::ostringstream what;
    what << "found " << value << ", expected a number ";
    if (high == std::numeric_limits<double>::max()) {
      what << "of at least " << low;
    } else {
      what << "in [" << low << ", " << high << "]";
    }
    throw Error(child->source, what.str());
  }
  return value;
}

int Parameters::integer(const std::string& key, int fallback, int low, int high) {
  note({key, "whole number", std::to_string(fallback)});
  const double value = number(key, fallback, low, high);
  if (value != std::floor(value)) throw error(key, "expected a whole number");
  return static_cast<int>(value);
}

bool Parameters::boolean(const std::string& key, bool fallback) {
  note({key, "true or false", fallback ? "true" : "false"});
  const Element* child = find_filled(key);
  return child ? parse_boolean(child->text, child->source) : fallback;
}

Eigen::Vector3d Parameters::vector3(const std::string& key, const Eigen::Vector3d& fallback) {
  note({key, "three numbers",
        in_words(fallback.x()) + " " + in_words(fallback.y()) + " " + in_words(fallback.z())});
  const Element* child = find_filled(key);
  return child ? parse_vector3(child->text, child->source) : fallback;
}

const Element* Parameters::block(const std::string& key) { return find(key); }

void Parameters::finish(Log& log) const {
  for (const Element& child : element_.children) {
    if (known_.count(child.name) == 0 && !is_foreign(child.name)) {
      log.warn(child.source, "unknown key, ignored");
    }
    if (with_one_value_.count(child.name) != 0 && element_.child(child.name) != &child) {
      log.warn(child.source, "found it a second time, expected it once: the first counts");
    }
  }
}

Error Parameters::error(const std::string& key, const std::string& what) const {
  const Element* child = element_.child(key);
  if (!child) return Error(element_.source, "<" + key + ">: " + what);
  return Error(child->source, "found " + in_quotes(child->text) + ", " + what);
}

}  // namespace ardee
