// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/picture_tracer.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/lights.h"
#include "ardee_sim/render/material_library.h"
#include "ardee_sim/render/radiance_cache.h"

namespace ardee::render {

struct RenderOptions {
  int samples = 4;  // rays a pixel, in a fixed pattern
  bool shadows = true;
  int threads = 0;  // 0: all cores
  double max_range_m = 1e5;
  /// Rays by PictureTracer::trace_approximately, and fewer of them where a surface is even
  /// (render_frame only).
  bool approximate = false;
};

/// All that the shading of a part of a picture needs.
struct TileShading {
  const raycast::PictureTracer& rays;
  const MaterialLibrary& materials;
  const Scene& scene;
  const std::vector<Light>& lights;
  const Camera& camera;
  const RenderOptions& options;
  RadianceCache& store;  // of this scene, these lights and materials
};

/// Of the first lamps, a bit each: whether they shine on a place.
struct LampKnowledge {
  std::uint32_t known = 0;
  std::uint32_t in_shadow = 0;
};

/// Surfaces seen at a slant of which the sine is less are taken for this steep (nominal): the part
/// that a pixel covers grows beyond all bounds.
constexpr double kLeastSlant = 0.05;

/// One ray through a pixel: the light that it has brought, and the share that is still to come.
struct Sample {
  Eigen::Vector3f light{0, 0, 0};
  float transmittance = 1.0f;
  double travelled_m = 0.0;
  double stretch = 1.0;      // length of the way for each metre along the camera's axis
  LampKnowledge lamps;       // at what is met first
  double footprint_m = 0.0;  // of a texel
  bool see_through = false;  // a texel that cannot be looked at without what is behind
};

/// Shades rays in waves: what all of them hit, which of these points lie in shadow, what is behind
/// transparent surfaces.
class Shader {
 public:
  /// Begins a picture's part; the room of the one before is used again.
  void begin(const TileShading& shading);

  /// Adds a sample through (x, y) in pixels; it has no ray where the lens lets no light through.
  void enqueue(double x_px, double y_px);
  /// Adds a sample whose first hit a primary ray has found, where some lamps' shadows are known.
  void enqueue(const raycast::PrimaryRayPacket& glances, int ray, const LampKnowledge& lamps);
  /// Adds a sample straight at a texel's middle, `footprint_m` about it: its light depends on
  /// nothing else. Texels and other samples are not shaded together.
  void enqueue(const raycast::SurfaceTexel& texel, double footprint_m);
  /// Whether moving models may shade what is about a place.
  bool may_be_shaded(const Eigen::Vector3f& at_W, float about_m) const;
  /// Forgets the samples.
  void clear();
  /// Shades all samples that were added since the last call.
  void flush();

  const std::vector<Sample>& samples() const { return samples_; }
  /// Rays of the samples that were added, and the sample of each.
  const std::vector<raycast::SceneRay>& rays() const { return rays_; }
  const std::vector<std::uint32_t>& owners() const { return owners_; }

 private:
  /// A lit point that waits for the answer of its shadow ray.
  struct Waiting {
    std::uint32_t sample;
    Eigen::Vector3f light;
    std::uint32_t lamp_bit;  // of the first lamps; 0: another
  };

  /// What `count` rays from number `begin` on meet, into the first of points_.
  void find_points(std::size_t begin, std::size_t count, bool glanced);
  /// The light of ray `i`, but for what depends on shadows or lies behind.
  void shade(const raycast::SurfaceInteraction& point, std::size_t i, int layer);
  void continue_ray(const Eigen::Vector3d& from_W, double range_m, std::size_t i);
  void enqueue_shadow_ray(std::size_t lamp, const Eigen::Vector3d& at_W,
                          const raycast::SurfaceInteraction& point, const Eigen::Vector3f& diffuse,
                          std::size_t i, bool first);
  void add_unshadowed();

  const TileShading* s_ = nullptr;
  Eigen::Matrix3d R_WC_;
  double pixel_rad_ = 0.0;
  std::vector<std::optional<Illumination>> distant_;  // of each light that is the same everywhere
  std::vector<Sample> samples_;
  std::vector<std::uint32_t> triangles_;       // that each primary ray has hit; or empty
  std::vector<raycast::SurfaceTexel> texels_;  // that each ray looks at; or empty
  std::vector<raycast::SceneRay> rays_;
  std::vector<std::uint32_t> owners_;                // the sample of each ray
  std::vector<raycast::SurfaceInteraction> points_;  // of some rays
  std::vector<raycast::SceneRay> next_rays_;
  std::vector<std::uint32_t> next_owners_;
  std::vector<raycast::SceneRay> shadow_rays_;
  std::vector<Waiting> waiting_;
  std::unique_ptr<bool[]> in_shadow_;
  std::size_t room_for_shadows_ = 0;
  MaterialLibrary::LookupCache lookup_cache_;
};

}  // namespace ardee::render
