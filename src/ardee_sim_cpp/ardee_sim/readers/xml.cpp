// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/xml.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/text_file.h"

namespace ardee {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string quoted(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  return "'" + (text.size() > kLongest ? text.substr(0, kLongest) + "..." : text) + "'";
}

std::string bounds(double low, double high) {
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
  // Older robots say <mu1 value="0.9"/> in their <gazebo> blocks, and libsdformat reads that.
  if (!element_->FirstChild()) all = attribute("value");
  return trimmed(all);
}

std::string Node::required_text() const {
  std::string value = text();
  if (value.empty()) throw error("found no text, expected some");
  return value;
}

double Node::to_number(double low, double high) const {
  double values[1];
  parse_numbers(values, 1, "a finite number");
  if (values[0] < low || values[0] > high) {
    throw error("found " + quoted(text()) + ", " + bounds(low, high));
  }
  return values[0];
}

double Node::to_limit() const {
  constexpr double kInfinite = 1e15;
  std::string value = text();
  std::transform(value.begin(), value.end(), value.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (value == "inf" || value == "+inf") return std::numeric_limits<double>::infinity();
  if (value == "-inf") return -std::numeric_limits<double>::infinity();
  const double number =
      to_number(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());
  if (std::abs(number) < kInfinite) return number;
  return std::copysign(std::numeric_limits<double>::infinity(), number);
}

int Node::to_integer(int low, int high) const {
  const double value = to_number(low, high);
  if (value != std::floor(value)) {
    throw error("found " + quoted(text()) + ", expected a whole number");
  }
  return static_cast<int>(value);
}

bool Node::to_boolean() const { return parse_boolean(text(), source()); }

template <std::size_t kCount>
std::size_t Node::parse_numbers(double (&values)[kCount], std::size_t least,
                                const char* what) const {
  const std::string all = text();
  const char* at = all.data();
  const char* const end = at + all.size();
  std::size_t count = 0;
  bool good = true;
  while (good && at != end) {
    if (kSpace.find(*at) != std::string_view::npos) {
      ++at;
      continue;
    }
    double value = 0.0;
    const auto [stop, status] = std::from_chars(*at == '+' ? at + 1 : at, end, value);
    good = status == std::errc() && std::isfinite(value) && count < kCount &&
           (stop == end || kSpace.find(*stop) != std::string_view::npos);
    if (good) values[count++] = value;
    at = stop;
  }
  if (!good || count < least) {
    throw error("found " + quoted(all) + ", expected " + what);
  }
  return count;
}

Eigen::Vector2d Node::to_vector2() const {
  double v[2];
  parse_numbers(v, 2, "two numbers");
  return {v[0], v[1]};
}

Eigen::Vector3d Node::to_vector3() const {
  double v[3];
  parse_numbers(v, 3, "three finite numbers");
  for (const double value : v) {
    if (std::abs(value) > kAbsurd) {
      throw error("found " + quoted(text()) + ", " + bounds(-kAbsurd, kAbsurd));
    }
  }
  return {v[0], v[1], v[2]};
}

Pose Node::to_pose() const {
  double v[6];
  parse_numbers(v, 6, "six finite numbers (x y z roll pitch yaw)");
  for (const double value : v) {
    if (std::abs(value) > kAbsurd) {
      throw error("found " + quoted(text()) + ", " + bounds(-kAbsurd, kAbsurd));
    }
  }
  const double rad = parse_boolean(attribute("degrees", "false"), source()) ? M_PI / 180.0 : 1.0;
  return Pose::from_xyz_rpy({v[0], v[1], v[2]}, {v[3] * rad, v[4] * rad, v[5] * rad});
}

Color Node::to_color() const {
  double v[4];
  const std::size_t count = parse_numbers(v, 3, "three or four numbers in [0, 1]");
  if (count == 3) v[3] = 1.0;
  Color color;
  for (int i = 0; i < 4; ++i) color[i] = static_cast<float>(std::clamp(v[i], 0.0, 1.0));
  return color;
}

std::string Node::text(std::string_view path, const std::string& fallback) const {
  const auto node = find(path);
  return node ? node->text() : fallback;
}

double Node::number(std::string_view path, double fallback, double low, double high) const {
  const auto node = find(path);
  return node ? node->to_number(low, high) : fallback;
}

int Node::integer(std::string_view path, int fallback, int low, int high) const {
  const auto node = find(path);
  return node ? node->to_integer(low, high) : fallback;
}

bool Node::boolean(std::string_view path, bool fallback) const {
  const auto node = find(path);
  return node ? node->to_boolean() : fallback;
}

Eigen::Vector3d Node::vector3(std::string_view path, const Eigen::Vector3d& fallback) const {
  const auto node = find(path);
  return node ? node->to_vector3() : fallback;
}

Pose Node::pose() const {
  const auto node = child("pose");
  if (node && !node->attribute("relative_to").empty()) {
    throw node->error("found relative_to='" + node->attribute("relative_to") +
                      "', expected none here");
  }
  return node && !node->text().empty() ? node->to_pose() : Pose{};  // <pose/> is no pose
}

Color Node::color(std::string_view path, const Color& fallback) const {
  const auto node = find(path);
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
