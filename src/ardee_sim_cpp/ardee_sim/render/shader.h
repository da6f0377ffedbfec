// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/lights.h"
#include "ardee_sim/render/material_library.h"
#include "ardee_sim/render/radiance_cache.h"
#include "ardee_sim/render/sky.h"

namespace ardee::render {

struct RenderOptions {
  int samples = 4;  // rays a pixel, in a fixed pattern
  bool shadows = true;
  int threads = 0;  // 0: all cores
  double max_range_m = 1e5;
  /// Uses the approximate rays of PictureTracer, and fewer of them on even surfaces (render_frame
  /// only).
  bool approximate = false;
  /// One for each pixel, row by row: 1 if it gets a ray; those of 0 see nothing (render_frame
  /// without `approximate` only). Null: all do.
  const std::vector<std::uint8_t>* wanted = nullptr;
};

/// Inputs of the shading of a part of a picture.
struct TileShading {
  const raycast::PictureTracer& rays;
  const MaterialLibrary& materials;
  const Scene& scene;
  const Sky& sky;
  const std::vector<Light>& lights;
  const Camera& camera;
  const RenderOptions& options;
  RadianceCache& store;  // for this scene, these lights and materials
};

/// Known lamps among the first 32, a bit each: whether they shine on a place.
struct LampKnowledge {
  std::uint32_t known = 0;
  std::uint32_t in_shadow = 0;
};

/// Least sine of a slant (nominal); a steeper one counts as this: the area that a pixel covers
/// would grow without bound.
constexpr double kLeastSlant = 0.05;

/// One ray through a pixel: the light collected so far, and the share of the light behind.
struct Sample {
  Eigen::Vector3f light{0, 0, 0};
  float transmittance = 1.0f;
  double travelled_m = 0.0;
  double stretch = 1.0;      // length of the ray for each metre along the camera's axis
  LampKnowledge lamps;       // at the first hit
  double footprint_m = 0.0;  // a texel's
  bool see_through = false;  // a texel whose light depends on the surfaces behind it
};

/// Shades rays in waves: hits of all rays, shadows of the hits, then surfaces behind transparent
/// ones.
class Shader {
 public:
  /// Begins a part of a picture; reuses the memory of the part before.
  void begin(const TileShading& shading);

  /// Adds a sample through (x, y) in pixels; it has no ray if the lens lets no light through.
  void enqueue(double x_px, double y_px);
  /// Adds a sample with the first hit of a primary ray, and the shadows of lamps that are known
  /// there.
  void enqueue(const raycast::PrimaryRayPacket& glances, int ray, const LampKnowledge& lamps);
  /// Adds a sample straight at a texel's middle, with `footprint_m` about it: its light depends on
  /// these alone. Texels and other samples are not shaded together.
  void enqueue(const raycast::SurfaceTexel& texel, double footprint_m);
  /// Returns whether moving models may shade the surroundings of a place.
  bool may_be_shaded(const Eigen::Vector3f& at_W, float about_m) const;
  /// Removes all samples.
  void clear();
  /// Shades all samples that were added since the last call.
  void flush();

  const std::vector<Sample>& samples() const { return samples_; }
  /// Rays of the samples that were added, and the sample of each.
  const std::vector<raycast::SceneRay>& rays() const { return rays_; }
  const std::vector<std::uint32_t>& owners() const { return owners_; }

 private:
  /// Lit point whose shadow ray is not traced yet.
  struct Waiting {
    std::uint32_t sample;
    Eigen::Vector3f light;
    std::uint32_t lamp_bit;  // 0: beyond the first lamps
  };

  /// Finds the hits of `count` rays from number `begin` on, and stores them at the start of
  /// points_.
  void find_points(std::size_t begin, std::size_t count, bool glanced);
  /// Adds the light of ray `i`, except for light that depends on shadows or comes from behind.
  void shade(const raycast::SurfaceInteraction& point, std::size_t i, int layer);
  void continue_ray(const Eigen::Vector3d& from_W, double range_m, std::size_t i);
  void enqueue_shadow_ray(std::size_t lamp, const Eigen::Vector3d& at_W,
                          const raycast::SurfaceInteraction& point, const Eigen::Vector3f& diffuse,
                          std::size_t i, bool first);
  void add_unshadowed();

  const TileShading* s_ = nullptr;
  Eigen::Matrix3d R_WC_;
  double focal_px_ = 1.0;
  double pixel_rad_ = 0.0;
  std::vector<std::optional<Illumination>> distant_;  // lights that are the same everywhere
  std::vector<Sample> samples_;
  std::vector<std::uint32_t> triangles_;       // one for each primary ray, or empty
  std::vector<raycast::SurfaceTexel> texels_;  // one for each ray at a texel, or empty
  std::vector<raycast::SceneRay> rays_;
  std::vector<std::uint32_t> owners_;                // the sample of each ray
  std::vector<raycast::SurfaceInteraction> points_;  // of the rays in work
  std::vector<raycast::SceneRay> next_rays_;
  std::vector<std::uint32_t> next_owners_;
  std::vector<raycast::SceneRay> shadow_rays_;
  std::vector<Waiting> waiting_;
  std::unique_ptr<bool[]> in_shadow_;
  std::size_t room_for_shadows_ = 0;
  MaterialLibrary::LookupCache lookup_cache_;
};

}  // namespace ardee::render
