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

/// Normals of a surface within this cosine are of a place where it is smooth.
constexpr float kSmooth = 0.85f;

/// Whether two rays of a picture have met one surface, where it is smooth; or both nothing.
inline bool same_surface(const Glance& a, const Glance& b) {
  if (a.surface != b.surface || a.surface == 0) return a.surface == b.surface;
  if (a.geometry != Glance::kOutside && a.primitive == b.primitive) return true;
  const float along = a.normal_W.dot(b.normal_W);
  return along > 0.0f &&
         along * along >= kSmooth * kSmooth * a.normal_W.squaredNorm() * b.normal_W.squaredNorm();
}

/// Ranges along one surface that differ by more, as a share, are not next to each other.
constexpr float kSameRange = 0.02f;

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

  /// A look through (x, y) in pixels; one without a ray where the lens lets no light through.
  void send(double x_px, double y_px);
  /// One whose first meeting was glanced at: from `near_m` on along `direction_W`, of that length
  /// for each metre along the camera's axis. It takes shadows from those of its neighbours that
  /// have met the same surface, if they are of one opinion.
  void send(const GlanceRay& ray, float stretch, const Glance& glance,
            const Neighbours& neighbours);
  /// One that sees nothing, among glanced ones.
  void send_dark() {
    samples_.emplace_back();
    seen_.emplace_back();
  }
  /// Forgets the looks.
  void clear();
  /// The light of all looks that were sent since the last call.
  void gather();

  const std::vector<Sample>& samples() const { return samples_; }
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
  /// Of a sample that was glanced at.
  struct Seen {
    Glance glance;
    Neighbours neighbours;
    std::uint32_t known = 0;      // a bit a lamp: whether it shines here is known,
    std::uint32_t in_shadow = 0;  // and it does not
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
  std::vector<Seen> seen_;       // of each sample, or of none
  std::vector<Glance> glances_;  // of each ray, or of none
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
