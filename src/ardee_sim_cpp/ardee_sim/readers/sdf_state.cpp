// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_state.h"

#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "ardee_sim/description/parameters.h"

namespace ardee {
namespace {

using Eigen::Vector3d;

/// What the state speaks of and the world does not have.
class Unknown {
 public:
  void add(const char* kind, const std::string& name) {
    if (++count_ <= kListed)
      names_ += (count_ > 1 ? ", " : "") + std::string(kind) + " '" + name + "'";
  }
  void warn(const Source& state, Log& log) const {
    if (count_ == 0) return;
    const std::string more =
        count_ > kListed ? " and " + std::to_string(count_ - kListed) + " more" : "";
    log.warn(state, "found " + names_ + more + ", which the world does not have; ignored");
  }

 private:
  static constexpr std::size_t kListed = 5;
  std::size_t count_ = 0;
  std::string names_;
};

/// "seconds nanoseconds"
TimeNs read_time(const Node& time) {
  constexpr double kLongest_s = 1e9;
  std::istringstream words(time.text());
  std::string first, second = "0", rest;
  words >> first >> second;
  const double whole_s = parse_number(first, time.source());
  const double part_ns = parse_number(second, time.source());
  const bool valid = whole_s >= 0.0 && whole_s <= kLongest_s && part_ns >= 0.0 && part_ns < 1e9;
  if (!valid || words >> rest) {
    throw time.error("found '" + time.text() + "', expected seconds and nanoseconds");
  }
  return nanoseconds(whole_s) + static_cast<TimeNs>(part_ns);
}

Twist read_velocity(const Node& velocity) {
  std::istringstream words(velocity.text());
  double numbers[6] = {};
  std::string word;
  for (double& number : numbers) {
    if (!(words >> word)) throw velocity.error("found fewer numbers, expected six");
    number = parse_number(word, velocity.source());
  }
  if (words >> word) throw velocity.error("found more numbers, expected six");
  return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

/// Equal as far as the digits that Gazebo saves go.
bool is_same(const Pose& a, const Pose& b) {
  constexpr double kSaved = 1e-5;
  return (a.p - b.p).norm() <= kSaved * (1.0 + b.p.norm()) && a.q.angularDistance(b.q) <= kSaved;
}

struct ScaleShape {
  Vector3d factors;

  void operator()(Box& box) const { box.size_m = box.size_m.cwiseProduct(factors); }
  void operator()(Sphere& sphere) const { sphere.radius_m *= factors.maxCoeff(); }
  void operator()(Cylinder& cylinder) const {
    cylinder.radius_m *= factors.head<2>().maxCoeff();
    cylinder.length_m *= factors.z();
  }
  void operator()(Plane& plane) const {
    plane.size_m = plane.size_m.cwiseProduct(factors.head<2>());
  }
  void operator()(Mesh& mesh) const { mesh.scale = mesh.scale.cwiseProduct(factors); }
  void operator()(Heightmap&) const {}
};

/// As Gazebo scales a model: its shapes grow where they stand, masses stay.
void scale_shapes(const Node& scale, Model& model, Log& log) {
  const Vector3d factors = scale.to_vector3();
  if (!(factors.minCoeff() > 0.0)) {
    throw scale.error("found '" + scale.text() + "', expected three positive numbers");
  }
  const auto change = [&](Geometry& shape) {
    std::visit(ScaleShape{factors}, shape);
    if (std::holds_alternative<Heightmap>(shape)) {
      log.warn(scale.source(), "a heightmap keeps its size");
    }
  };
  for (Link& link : model.links) {
    for (Collision& collision : link.collisions) change(collision.geometry);
    for (Visual& visual : link.visuals) change(visual.geometry);
  }
}

bool has_unit_scale(const Node& scale) {
  return scale.text().empty() || scale.to_vector3() == Vector3d::Ones();
}

template <typename Item>
std::unordered_map<std::string, Item*> by_name(std::vector<Item>& items) {
  std::unordered_map<std::string, Item*> found;
  for (Item& item : items) found.emplace(item.name, &item);
  return found;
}

/// The state of one model of the world, and of those that it holds.
class ModelState {
 public:
  ModelState(Unknown& unknown, Log& log) : unknown_(unknown), log_(log) {}

  /// Models of a static model stay models; `X_WP` and `scale_P` are where what holds it stands.
  void apply(const Node& saved, Instance& model, const Pose& X_WP, double scale_P) {
    if (saved.child("pose")) {
      model.pose = X_WP.inverse() * saved.pose();
      model.pose.p /= scale_P;
    }
    const Pose X_WM = X_WP * Pose{scale_P * model.pose.p, model.pose.q};
    auto changed = std::make_shared<Model>(*model.model);
    bool has_changed = false;
    if (const auto scale = saved.child("scale"); scale && !has_unit_scale(*scale)) {
      scale_shapes(*scale, *changed, log_);
      has_changed = true;
    }
    const auto held = by_name(changed->instances);
    LinkStates links;
    collect_links(saved, "", *changed, held, links);
    const double scale_M = scale_P * model.scale;
    if (model.is_static) {
      has_changed |= move_links(links, X_WM, scale_M, *changed);
    } else if (differs(links, X_WM, *changed)) {
      model.link_states = std::make_shared<const LinkStates>(std::move(links));
    }
    saved.each("model", [&](const Node& nested) {
      const auto found = held.find(nested.attribute("name"));
      if (found == held.end()) return;
      apply(nested, *found->second, X_WM, scale_M);
      has_changed = true;
    });
    if (has_changed) model.model = std::move(changed);
  }

 private:
  using Held = std::unordered_map<std::string, Instance*>;

  /// Links by their names in the model; those of models merged into it have these before theirs.
  void collect_links(const Node& saved, const std::string& prefix, const Model& model,
                     const Held& held, LinkStates& links) {
    saved.each("link", [&](const Node& link) {
      const std::string name = prefix + link.required_attribute("name");
      if (model.find_link(name) == nullptr) {
        unknown_.add("link", model.name + "::" + name);
      } else if (link.child("pose")) {
        const auto velocity = link.child("velocity");
        links[name] = {link.pose(), velocity ? read_velocity(*velocity) : Twist{}};
      }
    });
    saved.each("model", [&](const Node& nested) {
      const std::string name = prefix + nested.required_attribute("name");
      if (held.count(name) != 0) return;
      const std::string inner = name + "::";
      const bool is_merged = std::any_of(
          model.links.begin(), model.links.end(),
          [&](const Link& link) { return link.name.compare(0, inner.size(), inner) == 0; });
      if (is_merged) {
        collect_links(nested, inner, model, held, links);
      } else {
        unknown_.add("model", model.name + "::" + name);
      }
    });
  }

  static Pose described(const Model& model, const std::string& link, const Pose& X_WM) {
    return X_WM * model.find_link(link)->X_ML;
  }

  static bool differs(const LinkStates& links, const Pose& X_WM, const Model& model) {
    return std::any_of(links.begin(), links.end(), [&](const auto& entry) {
      const auto& [name, state] = entry;
      return !is_same(state.X_WL, described(model, name, X_WM)) ||
             !state.twist_W.linear.isZero(0.0) || !state.twist_W.angular.isZero(0.0);
    });
  }

  static bool move_links(const LinkStates& links, const Pose& X_WM, double scale, Model& model) {
    bool moved = false;
    for (Link& link : model.links) {
      const auto found = links.find(link.name);
      const Pose X_WL = X_WM * Pose{scale * link.X_ML.p, link.X_ML.q};
      if (found == links.end() || is_same(found->second.X_WL, X_WL)) continue;
      link.X_ML = X_WM.inverse() * found->second.X_WL;
      link.X_ML.p /= scale;
      moved = true;
    }
    return moved;
  }

  Unknown& unknown_;
  Log& log_;
};

template <typename Item>
bool erase_named(std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const Item& item) { return item.name == name; });
  if (found == items.end()) return false;
  items.erase(found);
  return true;
}

}  // namespace

void apply_sdf_state(const Node& state, World& world, Log& log) {
  Unknown unknown;
  if (const auto time = state.child("sim_time")) world.start_ns = read_time(*time);
  const auto models = by_name(world.models);
  state.each("model", [&](const Node& saved) {
    const auto found = models.find(saved.required_attribute("name"));
    if (found == models.end()) {
      unknown.add("model", saved.attribute("name"));
    } else {
      ModelState(unknown, log).apply(saved, *found->second, Pose{}, 1.0);
    }
  });
  const auto lights = by_name(world.lights);
  state.each("light", [&](const Node& saved) {
    const auto found = lights.find(saved.required_attribute("name"));
    if (found == lights.end()) {
      unknown.add("light", saved.attribute("name"));
    } else if (saved.child("pose")) {
      found->second->pose = saved.pose();
    }
  });
  if (const auto deletions = state.child("deletions")) {
    deletions->each("name", [&](const Node& name) {
      const std::string gone = name.required_text();
      if (!erase_named(world.models, gone) && !erase_named(world.lights, gone)) {
        unknown.add("entity", gone);
      }
    });
  }
  unknown.warn(state.source(), log);
}

}  // namespace ardee
