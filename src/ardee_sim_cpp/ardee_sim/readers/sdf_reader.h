// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/unique_names.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Reads SDF 1.2-1.12. Included model files are read once and kept for later worlds and models.
class SdfReader {
 public:
  explicit SdfReader(Assets& assets) : assets_(assets) {}

  /// `root` is a document's <sdf>.
  World read_world(const Node& root);
  std::shared_ptr<const Model> read_model(const Node& root);
  Light read_light(const Node& root);

 private:
  /// An included file: a model, or lights alone; neither if it is left out.
  struct ModelFile {
    std::shared_ptr<const Model> model;
    std::vector<Light> lights;
  };
  /// Addition of a nested <model> or an <include>; empty if it is left out.
  struct Placed {
    std::optional<Instance> instance;
    std::vector<Light> lights;
  };
  /// Context of a model: the version of its file, and whether its parent makes it static or not.
  struct Scope {
    int version = 0;  // 107: SDF 1.7
    std::optional<bool> make_static;
  };
  class Reading;

  /// Reads a file's top-level model; its pose has no reference frame.
  std::shared_ptr<const Model> read_own_model(const Node& model, const Scope& scope);
  /// Reads a model without its pose, which depends on its parent.
  std::shared_ptr<Model> read_model(const Node& model, const Scope& scope);
  /// Reads all nested models and includes of a model or world and adds them to `frames`; their
  /// poses are looked up there once all are added.
  std::vector<Placed> read_placed(const Node& parent, const Scope& scope, UniqueNames& names,
                                  SdfFrames& frames);
  Placed placed_instance(const Node& child, const Scope& scope, bool is_merged, UniqueNames& names,
                         SdfFrames& frames);
  void add_nested_models(const Node& model, std::vector<Placed> placed, UniqueNames& names,
                         const SdfFrames& frames, Model& made);
  /// Merges the models below a model into it; `bytes` is its approximate size so far.
  void add_nested(const Node& asker, Instance nested, std::size_t& bytes, Model& made);
  void merge(const Node& asker, const Instance& nested, const std::string& name, std::size_t& bytes,
             Model& made);
  void read_instances(const Node& node, UniqueNames& names, Model& made);
  const ModelFile& included_file(const Node& include, std::optional<bool> make_static);
  const ModelFile& included_file(const std::string& uri, const Source& source,
                                 std::optional<bool> make_static);
  const ModelFile& read_file(const std::string& path, const Source& source,
                             std::optional<bool> make_static);
  Instance read_include(const Node& include, const ModelFile& file, const std::string& name,
                        SdfFrames& frames);
  void read_world_models(const Node& world, const Scope& scope, World& made);
  void add_population(const Node& population, const Scope& scope, UniqueNames& names,
                      const SdfFrames& frames, World& made);
  void read_insertions(const Node& insertions, const Scope& scope, World& made);
  void check_size(const World& world) const;
  int read_version(const Node& root);
  /// Warns of models, lights and worlds beside the one that is read.
  void warn_of_others(const Node& parent, const Node& read) const;
  std::size_t count_placements(const Model& model, const Source& source);

  Assets& assets_;
  std::map<std::string, ModelFile> files_;                    // by path and staticness
  std::unordered_map<std::string, const ModelFile*> by_uri_;  // entries of files_ by URI
  std::unordered_map<const Model*, std::size_t>
      placements_;                    // of models that files_ or a world hold
  std::vector<std::string> reading_;  // files being read, outermost first
};

/// Whether an element is of a kind that Placed describes.
bool is_nested(const Node& child);

/// Name of a part of a world in messages: "<model> 'wall'".
std::string label_of(const Node& part);

/// X_HM of a model in its parent, from the pose of its placement frame.
inline Pose place_model(const Pose& X_HP, const std::optional<Pose>& X_MP) {
  return X_MP ? X_HP * X_MP->inverse() : X_HP;
}

/// Approximate memory of a model in bytes, without the data that it shares with others.
std::size_t bytes_of(const Model& model);

/// Merges a nested model into its parent: links and joints get names `child::link`; with an empty
/// name they keep their own.
void merge_model(const Model& nested, const Pose& X_MN, const std::string& name, Model& made);

}  // namespace ardee
