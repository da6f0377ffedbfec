// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {
namespace {

using Eigen::Vector3d;

/// Entries of the state that the world does not have.
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

/// Equal to the precision that Gazebo saves.
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

/// As Gazebo scales a model: shapes are scaled at their places, masses are kept.
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
std::map<std::string, Item*> by_name(std::vector<Item>& items) {
  std::map<std::string, Item*> found;
  for (Item& item : items) found.emplace(item.name, &item);
  return found;
}

/// Visits the children of a kind; of several with one name only the first.
template <typename Visit>
void each_named(const Node& parent, const char* kind, Log& log, Visit visit) {
  std::set<std::string> seen;
  parent.each(kind, [&](const Node& child) {
    const std::string name = child.required_attribute("name");
    if (seen.insert(name).second) {
      visit(child, name);
    } else {
      log.warn(child.source(), "found a second state of one name, the first counts");
    }
  });
}

/// The state of one model of the world, and of those that it holds.
class ModelState {
 public:
  ModelState(Unknown& unknown, Log& log) : unknown_(unknown), log_(log) {}

  /// Models of a static model stay models; `X_WP` and `scale_P` are the pose and scale of the
  /// parent.
  void apply(const Node& saved, Instance& model, const Pose& X_WP, double scale_P) {
    if (saved.child("pose")) {
      model.pose = X_WP.inverse() * saved.pose();
      model.pose.p /= scale_P;
    }
    const auto scale = saved.child("scale");
    const bool is_scaled = scale && !has_unit_scale(*scale);
    if (!is_scaled && !saved.child("link") && !saved.child("model")) return;
    auto changed = std::make_shared<Model>(*model.model);
    if (is_scaled) scale_shapes(*scale, *changed, log_);
    const Pose X_WM = X_WP * Pose{scale_P * model.pose.p, model.pose.q};
    const double scale_M = scale_P * model.scale;
    links_ = by_name(changed->links);
    held_ = by_name(changed->instances);
    LinkStates states;
    collect(saved, "", *changed, states);
    bool has_changed = is_scaled;
    if (model.is_static) {
      has_changed |= move_links(states, X_WM, scale_M);
    } else if (differs(states, X_WM)) {
      model.link_states = std::make_shared<const LinkStates>(std::move(states));
    }
    each_named(saved, "model", log_, [&](const Node& nested, const std::string& name) {
      const auto found = held_.find(name);
      if (found == held_.end()) return;
      ModelState(unknown_, log_).apply(nested, *found->second, X_WM, scale_M);
      has_changed = true;
    });
    if (has_changed) model.model = std::move(changed);
  }

 private:
  /// Links by their names in the model; links of merged models have the model's name as a prefix.
  void collect(const Node& saved, const std::string& prefix, const Model& model,
               LinkStates& states) {
    each_named(saved, "link", log_, [&](const Node& link, const std::string& own) {
      const std::string name = prefix + own;
      if (links_.count(name) == 0) {
        unknown_.add("link", model.name + "::" + name);
      } else if (link.child("pose")) {
        const auto velocity = link.child("velocity");
        states[name] = {link.pose(), velocity ? read_velocity(*velocity) : Twist{}};
      }
    });
    each_named(saved, "model", log_, [&](const Node& nested, const std::string& own) {
      const std::string name = prefix + own;
      if (held_.count(name) != 0) return;
      const auto first = links_.lower_bound(name + "::");
      if (first != links_.end() && first->first.rfind(name + "::", 0) == 0) {
        collect(nested, name + "::", model, states);
      } else {
        unknown_.add("model", model.name + "::" + name);
      }
    });
  }

  bool differs(const LinkStates& states, const Pose& X_WM) const {
    return std::any_of(states.begin(), states.end(), [&](const auto& entry) {
      const auto& [name, state] = entry;
      return !is_same(state.X_WL, X_WM * links_.at(name)->X_ML) ||
             !state.twist_W.linear.isZero(0.0) || !state.twist_W.angular.isZero(0.0);
    });
  }

  bool move_links(const LinkStates& states, const Pose& X_WM, double scale) {
    bool moved = false;
    for (const auto& [name, state] : states) {
      Pose& X_ML = links_.at(name)->X_ML;
      if (is_same(state.X_WL, X_WM * Pose{scale * X_ML.p, X_ML.q})) continue;
      X_ML = X_WM.inverse() * state.X_WL;
      X_ML.p /= scale;
      moved = true;
    }
    return moved;
  }

  Unknown& unknown_;
  Log& log_;
  std::map<std::string, Link*> links_;
  std::map<std::string, Instance*> held_;
};

/// Removes the items with one of the names, and removes these names.
template <typename Item>
void erase_named(std::vector<Item>& items, std::set<std::string>& names) {
  std::set<std::string> found;
  const auto is_gone = [&](const Item& item) {
    return names.count(item.name) != 0 && found.insert(item.name).second;
  };
  items.erase(std::remove_if(items.begin(), items.end(), is_gone), items.end());
  for (const std::string& name : found) names.erase(name);
}

}  // namespace

void apply_sdf_state(const Node& state, World& world, Log& log) {
  Unknown unknown;
  if (const auto time = state.child("sim_time")) world.start_ns = read_time(*time);
  const auto models = by_name(world.models);
  each_named(state, "model", log, [&](const Node& saved, const std::string& name) {
    const auto found = models.find(name);
    if (found == models.end()) {
      unknown.add("model", name);
    } else {
      ModelState(unknown, log).apply(saved, *found->second, Pose{}, 1.0);
    }
  });
  const auto lights = by_name(world.lights);
  each_named(state, "light", log, [&](const Node& saved, const std::string& name) {
    const auto found = lights.find(name);
    if (found == lights.end()) {
      unknown.add("light", name);
    } else if (saved.child("pose")) {
      found->second->pose = saved.pose();
    }
  });
  if (const auto deletions = state.child("deletions")) {
    std::set<std::string> names;
    deletions->each("name", [&](const Node& name) { names.insert(name.required_text()); });
    erase_named(world.models, names);
    erase_named(world.lights, names);
    for (const std::string& name : names) unknown.add("entity", name);
  }
  unknown.warn(state.source(), log);
}

}  // namespace ardee
