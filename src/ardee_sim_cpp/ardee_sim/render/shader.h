// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/render/camera.h"
#include "ardee_sim/render/lights.h"
#include "ardee_sim/render/looks.h"

namespace ardee {

struct RenderOptions {
  int samples = 4;  // rays a pixel, in a fixed pattern
  bool shadows = true;
  int threads = 0;  // 0: all cores
  double max_range_m = 1e5;
  /// RayScene::look_quickly, and fewer looks where a surface is even (shoot only).
  bool quickly = false;
};

/// All that the shading of a part of a picture needs.
struct TileShading {
  const RayScene& rays;
  const Looks& looks;
  const Scene& scene;
  const std::vector<Light>& lights;
  const Camera& camera;
  const RenderOptions& options;
};

/// One look through a pixel: what it has gathered, and what of the light is still to come.
struct Sample {
  Eigen::Vector3f light{0, 0, 0};
  float rest = 1.0f;
  double travelled_m = 0.0;
  double stretch = 1.0;  // length of the way for each metre along the camera's axis
};

/// What a look has met first.
struct Seen {
  std::uint32_t entity = kNoEntity;
  std::uint32_t link = 0;
  std::uint32_t shape = 0;
  const Material* material = nullptr;
  float range_m = 0.0f;
  Eigen::Vector3f normal_W{0, 0, 0};
  std::uint32_t asked = 0;      // a bit a lamp: whether it shines here was asked,
  std::uint32_t in_shadow = 0;  // and it does not
};

/// Whether two looks have met one surface, where it is smooth.
bool same_surface(const Seen& a, const Seen& b);

/// Samples next to a new one whose light has been gathered; kNone: fewer.
struct Neighbours {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::uint32_t samples[4] = {kNone, kNone, kNone, kNone};
};

/// Sends looks through a picture and gathers their light in waves: what all of them meet, which of
/// these points lie in shadow, what is behind transparent surfaces.
class Shader {
 public:
  /// Begins a picture's part; the room of the one before is used again.
  void begin(const TileShading& shading);

  /// A look through (x, y) in pixels; one without a ray where the lens lets no light through. It
  /// takes shadows from those of its neighbours that have met the same surface, if they are of one
  /// opinion.
  void send(double x_px, double y_px, const Neighbours& neighbours = {});
  /// Forgets the looks.
  void clear();
  /// The light of all looks that were sent since the last call.
  void gather();

  const std::vector<Sample>& samples() const { return samples_; }
  /// What a sample has met first.
  const Seen& seen(std::size_t sample) const { return seen_[sample]; }
  /// Rays of the looks that were sent, and the sample of each.
  const std::vector<SceneRay>& rays() const { return rays_; }
  const std::vector<std::uint32_t>& owners() const { return owners_; }

 private:
  /// A lit point that waits for the answer of its shadow ray.
  struct Waiting {
    std::uint32_t sample;
    Eigen::Vector3f light;
    std::uint32_t lamp_bit;  // of the first lamps; 0: another
  };
  enum class Opinion { kLit, kInShadow, kNone };

  void shade_layer(bool first, bool last);
  Opinion opinion(std::size_t sample, std::uint32_t lamp_bit) const;
  void look_on(const Eigen::Vector3d& from_W, std::size_t i);
  void send_to_lamp(std::size_t lamp, const Eigen::Vector3d& at_W, const SurfacePoint& point,
                    const Eigen::Vector3f& diffuse, std::size_t i, bool first);
  void add_unshadowed();

  const TileShading* s_ = nullptr;
  Eigen::Matrix3d R_WC_;
  double pixel_rad_ = 0.0;
  std::vector<std::optional<Illumination>> distant_;  // of each light that is the same everywhere
  std::vector<Sample> samples_;
  std::vector<Seen> seen_;              // of each sample
  std::vector<Neighbours> neighbours_;  // of each sample
  std::vector<SceneRay> rays_;
  std::vector<std::uint32_t> owners_;  // the sample of each ray
  std::vector<SurfacePoint> points_;   // as many as ever were needed
  std::vector<SceneRay> next_rays_;
  std::vector<std::uint32_t> next_owners_;
  std::vector<SceneRay> shadow_rays_;
  std::vector<Waiting> waiting_;
  std::unique_ptr<bool[]> in_shadow_;
  std::size_t room_for_shadows_ = 0;
  Looks::Memo memo_;
};

}  // namespace ardee
