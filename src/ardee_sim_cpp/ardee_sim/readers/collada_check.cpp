// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/collada_check.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace ardee {
namespace {

using Names = std::set<std::string, std::less<>>;

/// Calls use(begin, end) for each word of a text.
template <typename Use>
void each_word(const std::string& text, Use use) {
  constexpr const char* kSpace = " \t\r\n";
  std::size_t begin = text.find_first_not_of(kSpace);
  while (begin != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
    use(text.data() + begin, text.data() + end);
    begin = text.find_first_not_of(kSpace, end);
  }
}

/// Number of numbers in an element's text. Throws Error if it holds anything else.
template <typename Number>
std::size_t count_numbers(const Node& node) {
  std::size_t count = 0;
  each_word(node.text(), [&](const char* begin, const char* end) {
    Number value{};
    const auto [stop, status] = std::from_chars(*begin == '+' ? begin + 1 : begin, end, value);
    if (status != std::errc() || stop != end) {
      throw node.error("found '" + std::string(begin, std::min(end, begin + 40)) +
                       "' among its values, expected numbers");
    }
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) throw node.error("found a value that is not finite");
    }
    ++count;
  });
  return count;
}

std::size_t whole_number(const Node& node, const char* name, std::size_t fallback) {
  if (!node.has_attribute(name)) return fallback;
  const std::string text = node.attribute(name);
  std::size_t value = 0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || stop != text.data() + text.size() || value > (1u << 30)) {
    throw node.error("found " + std::string(name) + "='" + text + "', expected a whole number");
  }
  return value;
}

class ColladaCheck {
 public:
  void check(const Node& root) {
    collect(root);
    for (const Node& node : references_) check_reference(node);
    for (const auto& [id, node] : nodes_) extent_of(id, node, 0);
    for (const Node& scene : scenes_) extent(scene, 0);
  }

 private:
  /// Collects all ids and numbers in one traversal.
  void collect(const Node& node) {
    static const Names kIndices{"p", "v", "vcount", "h"};
    static const Names kValues{"float_array", "matrix", "translate", "rotate", "scale",
                               "lookat",      "skew",   "color",     "float"};
    const std::string_view name = node.name();
    const std::string id = node.attribute("id");
    if (!id.empty()) ids_.insert(id);
    if (name == "float_array") {
      check_array(node, id);
    } else if (kIndices.count(name) != 0) {
      count_numbers<std::int32_t>(node);
    } else if (kValues.count(name) != 0) {
      count_numbers<float>(node);
    } else if (name == "effect") {
      check_parameters(node);
    } else if (name == "node" && !id.empty()) {
      nodes_.emplace(id, node);
    } else if (name == "visual_scene") {
      scenes_.push_back(node);
    } else if (name == "input" || name == "accessor" || name == "instance_geometry" ||
               name == "instance_node" || name == "instance_controller") {
      references_.push_back(node);
    }
    node.each([&](const Node& child) {
      check_place(child, name);
      collect(child);
    });
  }

  void check_array(const Node& node, const std::string& id) {
    node.required_attribute("count");
    const std::size_t count = whole_number(node, "count", 0);
    const std::size_t found = count_numbers<float>(node);
    if (found != count) {
      throw node.error("found " + std::to_string(found) + " numbers, expected " +
                       std::to_string(count));
    }
    arrays_[id] = found;
  }

  /// The mesh library reads an element by its name at any place, and then looks for parts that do
  /// not exist there.
  static void check_place(const Node& child, std::string_view parent) {
    static const Names kPrimitives{"triangles",  "polylist", "polygons", "lines",
                                   "linestrips", "trifans",  "tristrips"};
    static const std::map<std::string, Names, std::less<>> kParents{
        {"COLLADA", {"no other element"}},
        {"library_effects", {"COLLADA"}},
        {"library_geometries", {"COLLADA"}},
        {"library_materials", {"COLLADA"}},
        {"library_nodes", {"COLLADA"}},
        {"library_visual_scenes", {"COLLADA"}},
        {"geometry", {"library_geometries"}},
        {"mesh", {"geometry"}},
        {"vertices", {"mesh", "brep", "convex_mesh"}},
        {"float_array", {"source"}},
        {"accessor", {"technique_common"}},
        {"visual_scene", {"library_visual_scenes"}},
        {"node", {"library_nodes", "visual_scene", "node"}},
        {"effect", {"library_effects"}},
    };
    const bool is_primitive = kPrimitives.count(child.name()) != 0;
    const auto found = kParents.find(is_primitive ? "vertices" : child.name());
    if (found == kParents.end() || found->second.count(parent) != 0) return;
    throw child.error("found it in <" + std::string(parent) + ">, expected it in <" +
                      *found->second.begin() + ">");
  }

  /// A parameter of an effect names another; the mesh library would follow a cycle for ever.
  static void check_parameters(const Node& effect) {
    std::map<std::string, std::string> named;
    const std::function<void(const Node&)> collect_named = [&](const Node& node) {
      if (node.name() == "newparam") {
        std::string target = node.text("sampler2D/source", "");
        if (target.empty()) target = node.text("surface/init_from", "");
        named[node.attribute("sid")] = target;
      }
      node.each(collect_named);
    };
    collect_named(effect);
    Names followed;  // those whose chain is known to end
    for (const auto& [first, target] : named) {
      std::vector<std::string> chain;
      for (std::string sid = first; named.count(sid) != 0 && followed.count(sid) == 0;
           sid = named[sid]) {
        if (chain.size() == named.size()) {
          throw effect.error("found parameter '" + first + "' in a ring, expected none");
        }
        chain.push_back(sid);
      }
      followed.insert(chain.begin(), chain.end());
    }
  }

  void check_reference(const Node& node) const {
    const std::string_view name = node.name();
    const bool by_source = name == "input" || name == "accessor";
    const std::string target = node.required_attribute(by_source ? "source" : "url");
    if (name == "input") {
      node.required_attribute("semantic");
      whole_number(node, "offset", 0);
      whole_number(node, "set", 0);
    }
    if (target[0] != '#') return;  // in another file, which is never opened
    if (ids_.count(target.substr(1)) == 0) {
      throw node.error("found a reference to '" + target + "', expected an id of the file");
    }
    if (name == "accessor") check_accessor(node, target.substr(1));
  }

  void check_accessor(const Node& node, const std::string& array) const {
    const auto found = arrays_.find(array);
    if (found == arrays_.end()) return;  // names, not numbers
    node.required_attribute("count");
    const std::size_t count = whole_number(node, "count", 0);
    const std::size_t stride = whole_number(node, "stride", 1);
    std::size_t width = 0;
    node.each("param", [&width](const Node&) { ++width; });
    const std::size_t most = std::max(width, stride);
    const std::size_t end =
        whole_number(node, "offset", 0) + (count == 0 ? 0 : (count - 1) * stride + most);
    if (end > found->second) {
      throw node.error("found items up to value " + std::to_string(end) + " of array '" + array +
                       "', expected at most its " + std::to_string(found->second));
    }
  }

  /// Number of nodes, and their depth, after each <instance_node> of a node is replaced by its
  /// target.
  struct Extent {
    std::size_t count = 1;
    std::size_t depth = 1;
  };

  /// Throws Error if a node contains itself, or the nodes become too many.
  Extent extent(const Node& node, std::size_t above) {
    constexpr std::size_t kMost = 200'000;
    constexpr std::size_t kDeepest = 1000;
    Extent made;
    const auto add = [&made](const Extent& below) {
      made.count += below.count;
      made.depth = std::max(made.depth, below.depth + 1);
    };
    if (above < kDeepest) {
      node.each("node", [&](const Node& child) { add(extent(child, above + 1)); });
      node.each("instance_node", [&](const Node& instance) {
        const auto target = nodes_.find(instance.attribute("url").substr(1));
        if (target != nodes_.end()) add(extent_of(target->first, target->second, above + 1));
      });
    }
    if (made.count > kMost) throw node.error("found too many nodes, expected fewer");
    if (above + made.depth > kDeepest) {
      throw node.error("found nodes more than " + std::to_string(kDeepest) +
                       " deep in each other, expected fewer");
    }
    return made;
  }

  /// Extent of a node with an id; each is computed once.
  Extent extent_of(const std::string& id, const Node& node, std::size_t above) {
    const auto [known, is_new] = extents_.emplace(id, std::nullopt);
    if (is_new) known->second = extent(node, above);
    if (!known->second) {
      throw node.error("found node '" + id + "' within itself, expected a tree");
    }
    return *known->second;
  }

  Names ids_;
  std::map<std::string, std::size_t> arrays_;  // numbers in each
  std::map<std::string, Node, std::less<>> nodes_;
  std::map<std::string, std::optional<Extent>> extents_;  // by id; none: being computed
  std::vector<Node> scenes_;
  std::vector<Node> references_;
};

}  // namespace

void check_collada(const Node& root) {
  if (root.name() != "COLLADA") throw root.error("found this root element, expected <COLLADA>");
  ColladaCheck().check(root);
}

}  // namespace ardee
