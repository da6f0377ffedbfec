// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/xml.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/description/parameters.h"

namespace ardee {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Numbers separated by space; none if a word is not a number.
std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  std::size_t at = text.find_first_not_of(kSpace);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    const auto value = to_double(text.substr(at, end - at));
    if (!value) return std::nullopt;
    numbers.push_back(*value);
    at = text.find_first_not_of(kSpace, end);
  }
  return numbers;
}

std::string expected_range(double low, double high) {
  std::ostringstream what;
  what << "expected a number in [" << low << ", " << high << "]";
  return what.str();
}

}  // namespace

std::optional<Node> Node::child(const char* child_name) const {
  const auto* found = element_->FirstChildElement(child_name);
  if (!found) return std::nullopt;
  return Node(*found, *file_);
}

std::optional<Node> Node::find(std::string_view path) const {
  std::optional<Node> node = *this;
  while (node && !path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    node = node->child(std::string(path.substr(0, slash)).c_str());
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return node;
}

Node Node::required(const char* child_name) const {
  const auto found = child(child_name);
  if (!found) throw error("found no <" + std::string(child_name) + ">, expected one");
  return *found;
}

std::string Node::attribute(const char* attribute_name, const std::string& fallback) const {
  const char* value = element_->Attribute(attribute_name);
  return value ? trimmed(value) : fallback;
}

std::string Node::required_attribute(const char* attribute_name) const {
  std::string value = attribute(attribute_name);
  if (value.empty()) {
    throw error("found no attribute '" + std::string(attribute_name) + "', expected one");
  }
  return value;
}

std::string Node::text() const {
  std::string all;
  for (const auto* piece = element_->FirstChild(); piece; piece = piece->NextSibling()) {
    if (const auto* text = piece->ToText()) all += text->Value();
  }
  // Older robots have <mu1 value="0.9"/> in their <gazebo> blocks, and libsdformat reads that.
  if (!element_->FirstChild()) all = attribute("value");
  return trimmed(all);
}

std::string Node::required_text() const {
  std::string value = text();
  if (value.empty()) throw error("found no text, expected some");
  return value;
}

std::vector<double> Node::attribute_numbers(const char* attribute_name, std::size_t least,
                                            std::size_t most, double low, double high) const {
  const std::string all = attribute(attribute_name);
  const auto numbers = parse_numbers(all);
  const auto is_within = [&](double value) { return value >= low && value <= high; };
  const bool counts = numbers && numbers->size() >= least && numbers->size() <= most;
  if (all.empty() || (counts && std::all_of(numbers->begin(), numbers->end(), is_within))) {
    return *numbers;
  }
  std::ostringstream what;
  what << "found " << attribute_name << "=" << in_quotes(all) << ", expected " << least
       << (most > least ? " or " + std::to_string(most) : "")
       << (most == 1 ? " number" : " numbers") << " in [" << low << ", " << high << "]";
  throw error(what.str());
}

double Node::attribute_number(const char* attribute_name, double fallback, double low,
                              double high) const {
  const std::vector<double> value = attribute_numbers(attribute_name, 1, 1, low, high);
  return value.empty() ? fallback : value[0];
}

Eigen::Vector3d Node::attribute_vector3(const char* attribute_name,
                                        const Eigen::Vector3d& fallback) const {
  const std::vector<double> v = attribute_numbers(attribute_name, 3, 3);
  return v.empty() ? fallback : Eigen::Vector3d(v[0], v[1], v[2]);
}

double Node::to_number(double low, double high) const {
  const std::string all = text();
  const auto value = to_double(all);
  if (!value || std::isnan(*value)) {
    throw error("found " + in_quotes(all) + ", expected a finite number");
  }
  if (*value < low || *value > high)
    throw error("found " + in_quotes(all) + ", " + expected_range(low, high));
  return *value;
}

double Node::to_limit() const {
  constexpr double kInfinite = 1e15;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double number = to_number(-kInfinity, kInfinity);
  return std::abs(number) < kInfinite ? number : std::copysign(kInfinity, number);
}

int Node::to_integer(int low, int high) const {
  const double value = to_number(low, high);
  if (value != std::floor(value)) {
    throw error("found " + in_quotes(text()) + ", expected a whole number");
  }
  return static_cast<int>(value);
}

bool Node::to_boolean() const { return parse_boolean(text(), source()); }

std::vector<double> Node::to_numbers(std::size_t least, std::size_t most, const char* what) const {
  const std::string all = text();
  const auto numbers = parse_numbers(all);
  if (!numbers || numbers->size() < least || numbers->size() > most) {
    throw error("found " + in_quotes(all) + ", expected " + what);
  }
  for (const double value : *numbers) {
    if (!std::isfinite(value)) throw error("found " + in_quotes(all) + ", expected " + what);
    if (std::abs(value) > limits::kAbsurd) {
      throw error("found " + in_quotes(all) + ", " +
                  expected_range(-limits::kAbsurd, limits::kAbsurd));
    }
  }
  return *numbers;
}

Eigen::Vector2d Node::to_vector2() const {
  const std::vector<double> v = to_numbers(2, 2, "two numbers");
  return {v[0], v[1]};
}

Eigen::Vector3d Node::to_vector3() const {
  const std::vector<double> v = to_numbers(3, 3, "three finite numbers");
  return {v[0], v[1], v[2]};
}

Pose Node::to_pose() const {
  const std::string format = attribute("rotation_format", "euler_rpy");
  const bool in_degrees = parse_boolean(attribute("degrees", "false"), source());
  if (format == "quat_xyzw" && !in_degrees) {
    const std::vector<double> v = to_numbers(7, 7, "seven finite numbers (x y z qx qy qz qw)");
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(q.norm() > 1e-6)) throw error("found a quaternion of length zero, expected one of 1");
    return {{v[0], v[1], v[2]}, q.normalized()};
  }
  if (format != "euler_rpy") {
    throw error("found rotation_format='" + format + "'" + (in_degrees ? " in degrees" : "") +
                ", expected euler_rpy, or quat_xyzw without degrees");
  }
  const std::vector<double> v = to_numbers(6, 6, "six finite numbers (x y z roll pitch yaw)");
  const double rad = in_degrees ? M_PI / 180.0 : 1.0;
  return Pose::from_xyz_rpy({v[0], v[1], v[2]}, {v[3] * rad, v[4] * rad, v[5] * rad});
}

Color Node::to_color() const {
  const std::vector<double> v = to_numbers(3, 4, "three or four numbers in [0, 1]");
  Color color{0, 0, 0, 1};
  for (std::size_t i = 0; i < v.size(); ++i) {
    color[static_cast<int>(i)] = static_cast<float>(std::clamp(v[i], 0.0, 1.0));
  }
  return color;
}

std::optional<Node> Node::find_filled(std::string_view path) const {
  const auto node = find(path);
  return node && !node->text().empty() ? node : std::nullopt;
}

std::string Node::text(std::string_view path, const std::string& fallback) const {
  const auto node = find(path);
  return node ? node->text() : fallback;
}

double Node::number(std::string_view path, double fallback, double low, double high) const {
  const auto node = find_filled(path);
  return node ? node->to_number(low, high) : fallback;
}

double Node::limit(std::string_view path, double fallback) const {
  const auto node = find_filled(path);
  return node ? node->to_limit() : fallback;
}

int Node::integer(std::string_view path, int fallback, int low, int high) const {
  const auto node = find_filled(path);
  return node ? node->to_integer(low, high) : fallback;
}

bool Node::boolean(std::string_view path, bool fallback) const {
  const auto node = find_filled(path);
  return node ? node->to_boolean() : fallback;
}

Eigen::Vector3d Node::vector3(std::string_view path, const Eigen::Vector3d& fallback) const {
  const auto node = find_filled(path);
  return node ? node->to_vector3() : fallback;
}

Pose Node::pose() const {
  const auto node = child("pose");
  if (node && !node->attribute("relative_to").empty()) {
    throw node->error("found relative_to='" + node->attribute("relative_to") +
                      "', expected none here");
  }
  return node && !node->text().empty() ? node->to_pose() : Pose{};  // <pose/> counts as absent
}

Color Node::color(std::string_view path, const Color& fallback) const {
  const auto node = find_filled(path);
  return node ? node->to_color() : fallback;
}

Element Node::to_element() const {
  Element element;
  element.name = element_->Name();
  element.text = text();
  element.source = source();
  for (const auto* a = element_->FirstAttribute(); a; a = a->Next()) {
    element.attributes[a->Name()] = a->Value();
  }
  each([&element](const Node& node) { element.children.push_back(node.to_element()); });
  return element;
}

}  // namespace ardee
