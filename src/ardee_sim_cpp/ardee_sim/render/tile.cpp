// SPDX-License-Identifier: MIT
#include "ardee_sim/render/tile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "ardee_sim/render/lights.h"
#include "ardee_sim/render/sky.h"
#include "ardee_sim/render/tone.h"

namespace ardee {
namespace {

/// A new ray starts this far off the surface that it leaves.
constexpr double kOffset_m = 1e-4;
/// So many transparent surfaces one behind the other are looked through.
constexpr int kMaxLayers = 8;
constexpr float kOpaque = 0.999f;

/// Share of the light on the far side of a two-sided sheet that comes through, beside what it
/// would reflect on the near side: leaves pass less visible light than they reflect.
constexpr double kSheetTransmission = 0.4;

/// Two-sided meshes are sheets, as leaves are. Where one encloses something, its own far wall keeps
/// the light out.
bool is_sheet(const SurfacePoint& point) {
  return point.two_sided && point.visual != nullptr &&
         std::holds_alternative<Mesh>(point.visual->geometry);
}

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

  bool same_surface(const Seen& other) const {
    return entity == other.entity && link == other.link && shape == other.shape &&
           material == other.material && normal_W.dot(other.normal_W) >= kSmooth * met();
  }
  float met() const { return entity == kNoEntity ? 0.0f : 1.0f; }

  /// Cosine between normals of a surface that counts as smooth.
  static constexpr float kSmooth = 0.85f;
};

/// Four looks at the corners of a square of pixels differ by less in light, and in depth (as a
/// share of it) from a plane: what lies between is theirs too.
constexpr float kSameLight = 0.1f;
constexpr float kSameRange = 0.02f;

/// A lit point that waits for the answer of its shadow ray.
struct Waiting {
  std::size_t sample;
  Eigen::Vector3f light;
};

/// The bits of a number mirrored behind the binary point: with k / n an even pattern (Hammersley).
double mirrored_bits(unsigned number) {
  double result = 0.0;
  for (double bit = 0.5; number != 0; number >>= 1, bit *= 0.5) {
    if ((number & 1u) != 0) result += bit;
  }
  return result;
}

class Tile {
 public:
  Tile(const TileShading& shading, const TileArea& area)
      : s_(shading), area_(area), R_WC_(shading.camera.X_WC.q.toRotationMatrix()) {
    const double cone = 1.0 / s_.camera.focal_length_px();
    pixel_rad_ = cone / std::sqrt(static_cast<double>(s_.options.samples));
    for (const Light& light : s_.lights) {
      const bool distant = light.type == Light::Type::kDirectional;
      distant_.push_back(distant ? illuminate(light, Eigen::Vector3d::Zero()) : std::nullopt);
    }
    const auto most = static_cast<std::size_t>(area.width * area.height * s_.options.samples);
    samples_.reserve(most);
    rays_.reserve(most);
    owners_.reserve(most);
    shadow_rays_.reserve(most);
    waiting_.reserve(most);
  }

  /// `samples` a pixel, in a fixed pattern.
  void shade() {
    const int count = s_.options.samples;
    for (int k = 0; k < area_.width * area_.height; ++k) {
      const double x = area_.left + k % area_.width;
      const double y = area_.upper + k / area_.width;
      for (int i = 0; i < count; ++i) {
        const double dx = (i + 0.5) / count;
        const double dy = mirrored_bits(static_cast<unsigned>(i)) + 0.5 / count;
        send(x + dx, y + std::fmod(dy, 1.0));
      }
    }
    gather_light();
  }

  /// Through the middle of each pixel.
  void shoot(const FrameParts& parts, Frame& frame) {
    for (int k = 0; k < area_.width * area_.height; ++k) {
      send(area_.left + k % area_.width + 0.5, area_.upper + k / area_.width + 0.5);
    }
    if (parts.depth || parts.ids) {
      hits_.resize(rays_.size());
      s_.rays.meet(rays_.data(), rays_.size(), hits_.data());
      write_hits(parts, frame);
    }
    if (!parts.light) return;
    if (s_.options.quickly) {
      shoot_every_other(frame);
      return;
    }
    gather_light();
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      frame.light[index_in(frame, k)] = samples_[k].light;
    }
  }

  void write(Image& image) const {
    const auto count = static_cast<std::size_t>(s_.options.samples);
    for (int k = 0; k < area_.width * area_.height; ++k) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = 0; i < count; ++i) {
        const Sample& sample = samples_[static_cast<std::size_t>(k) * count + i];
        sum += sample.light.unaryExpr(&tone);
      }
      const std::size_t at =
          image.index(area_.left + k % area_.width, area_.upper + k / area_.width);
      for (int c = 0; c < 3; ++c) {
        image.samples8[at + static_cast<std::size_t>(c)] =
            to_byte(sum[c] / static_cast<float>(count));
      }
      image.samples8[at + 3] = 255;
    }
  }

 private:
  std::size_t index_in(const Frame& frame, std::size_t pixel) const {
    const int k = static_cast<int>(pixel);
    return frame.index(area_.left + k % area_.width, area_.upper + k / area_.width);
  }

  /// Looks through each second pixel each way, and through those between where these four are not
  /// of one smooth surface in one light.
  void shoot_every_other(Frame& frame) {
    clear();
    const int columns = area_.width / 2 + area_.width % 2 + 1;
    const int rows = area_.height / 2 + area_.height % 2 + 1;
    for (int k = 0; k < columns * rows; ++k) {
      send(area_.left + 2 * (k % columns) + 0.5, area_.upper + 2 * (k / columns) + 0.5);
    }
    seen_.assign(samples_.size(), {});
    gather_light();
    for (int row = 0; row + 1 < rows; ++row) {
      for (int column = 0; column + 1 < columns; ++column) fill_square(column, row, columns, frame);
    }
    gather_light();
    for (const auto& [place, sample] : between_) frame.light[place] = samples_[sample].light;
  }

  void fill_square(int column, int row, int columns, Frame& frame) {
    const auto first = static_cast<std::size_t>(row * columns + column);
    const std::size_t corners[4] = {first, first + 1, first + static_cast<std::size_t>(columns),
                                    first + static_cast<std::size_t>(columns) + 1};
    const bool even = is_even(corners);
    for (int k = 0; k < 4; ++k) {
      const int x = area_.left + 2 * column + k % 2;
      const int y = area_.upper + 2 * row + k / 2;
      if (x >= area_.left + area_.width || y >= area_.upper + area_.height) continue;
      const std::size_t place = frame.index(x, y);
      if (k == 0) {
        frame.light[place] = samples_[first].light;
      } else if (even) {
        const Eigen::Vector3f& a = samples_[corners[0]].light;
        const Eigen::Vector3f& b = samples_[corners[k]].light;
        frame.light[place] = k < 3 ? Eigen::Vector3f(0.5f * (a + b))
                                   : Eigen::Vector3f(0.25f * (a + b + samples_[corners[1]].light +
                                                              samples_[corners[2]].light));
      } else {
        send(x + 0.5, y + 0.5);
        between_.emplace_back(place, samples_.size() - 1);
      }
    }
  }

  bool is_even(const std::size_t corners[4]) const {
    const Seen& a = seen_[corners[0]];
    Eigen::Vector3f least = samples_[corners[0]].light;
    Eigen::Vector3f most = least;
    for (int k = 1; k < 4; ++k) {
      if (!a.same_surface(seen_[corners[k]])) return false;
      least = least.cwiseMin(samples_[corners[k]].light);
      most = most.cwiseMax(samples_[corners[k]].light);
    }
    if ((most - least).maxCoeff() > kSameLight) return false;
    const float bend_m = a.range_m + seen_[corners[3]].range_m - seen_[corners[1]].range_m -
                         seen_[corners[2]].range_m;
    return std::abs(bend_m) <= kSameRange * a.range_m;
  }

  void clear() {
    samples_.clear();
    rays_.clear();
    owners_.clear();
  }

  /// A sample through (x, y) in pixels; one without a ray where the lens lets no light through.
  void send(double x, double y) {
    Sample& sample = samples_.emplace_back();
    const Eigen::Vector3d way_C = s_.camera.direction_C(x, y);
    const double stretch = way_C.norm();
    if (!std::isfinite(stretch)) return;
    const Eigen::Vector3d direction_W = R_WC_ * (way_C / stretch);
    sample.travelled_m = s_.camera.near_m * stretch;
    sample.stretch = stretch;
    const double end_m = std::min(s_.camera.far_m * stretch, s_.options.max_range_m);
    rays_.push_back({s_.camera.X_WC.p + sample.travelled_m * direction_W, direction_W,
                     end_m - sample.travelled_m});
    owners_.push_back(samples_.size() - 1);
  }

  void write_hits(const FrameParts& parts, Frame& frame) const {
    std::vector<RayHit> of_pixel(samples_.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) of_pixel[owners_[i]] = hits_[i];
    for (std::size_t k = 0; k < of_pixel.size(); ++k) {
      const RayHit& hit = of_pixel[k];
      const bool met = hit.entity != kNoEntity;
      const std::size_t at = index_in(frame, k);
      if (parts.depth) {
        const double range_m = samples_[k].travelled_m + static_cast<double>(hit.range_m);
        frame.depth_m[at] = met ? static_cast<float>(range_m / samples_[k].stretch)
                                : std::numeric_limits<float>::infinity();
      }
      if (parts.ids) {
        frame.entities[at] = hit.entity;
        frame.labels[at] = static_cast<std::uint16_t>(hit.label);
      }
    }
  }

  void gather_light() {
    for (int layer = 0; layer < kMaxLayers && !rays_.empty(); ++layer) {
      points_.resize(rays_.size());
      if (s_.options.quickly) {
        s_.rays.look_quickly(rays_.data(), rays_.size(), points_.data());
      } else {
        s_.rays.look(rays_.data(), rays_.size(), points_.data());
      }
      shade_layer(layer + 1 == kMaxLayers);
      add_unshadowed();
      rays_.swap(next_rays_);
      owners_.swap(next_owners_);
      next_rays_.clear();
      next_owners_.clear();
    }
  }

  void shade_layer(bool last) {
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      Sample& sample = samples_[owners_[i]];
      const SurfacePoint& point = points_[i];
      if (!point.met()) {
        sample.light += sample.rest * sky_color(s_.scene, rays_[i].direction_W);
        continue;
      }
      if (owners_[i] < seen_.size() && seen_[owners_[i]].entity == kNoEntity) {
        seen_[owners_[i]] = {point.entity,
                             point.link,
                             point.shape,
                             point.material,
                             static_cast<float>(point.range_m),
                             point.smooth_normal_W.cast<float>()};
      }
      sample.travelled_m += point.range_m;
      const double slant =
          std::max(std::abs(point.smooth_normal_W.dot(rays_[i].direction_W)), 0.05);
      const double footprint_m = sample.travelled_m * pixel_rad_ / std::sqrt(slant);
      const Look look = s_.looks.at(point, footprint_m);
      const float opacity = last || look.opacity > kOpaque ? 1.0f : look.opacity;
      const Eigen::Vector3d at_W = rays_[i].origin_W + point.range_m * rays_[i].direction_W;
      const float share = sample.rest * opacity;
      Eigen::Vector3f ambient = ambient_light(s_.scene, point.smooth_normal_W);
      if (is_sheet(point)) {
        ambient += static_cast<float>(kSheetTransmission) *
                   ambient_light(s_.scene, -point.smooth_normal_W);
      }
      sample.light += share * (look.emissive + look.ambient.cwiseProduct(ambient));
      for (std::size_t k = 0; k < s_.lights.size(); ++k) {
        send_to(k, at_W, point, share * look.diffuse, i);
      }
      sample.rest *= 1.0f - opacity;
      if (opacity < 1.0f) look_on(at_W - kOffset_m * point.normal_W, i);
    }
  }

  void look_on(const Eigen::Vector3d& from_W, std::size_t i) {
    const SceneRay& ray = rays_[i];
    next_rays_.push_back({from_W, ray.direction_W, ray.reach_m - points_[i].range_m});
    next_owners_.push_back(owners_[i]);
  }

  void send_to(std::size_t lamp, const Eigen::Vector3d& at_W, const SurfacePoint& point,
               const Eigen::Vector3f& diffuse, std::size_t i) {
    const Light& light = s_.lights[lamp];
    const bool distant = light.type == Light::Type::kDirectional;
    const std::optional<Illumination> found = distant ? distant_[lamp] : illuminate(light, at_W);
    if (!found) return;
    double cosine = point.smooth_normal_W.dot(found->to_light_W);
    Eigen::Vector3d lit_side_W = point.normal_W;
    const bool lit_from_behind = cosine <= 0.0;
    if (lit_from_behind) {
      if (!is_sheet(point)) return;
      cosine *= -kSheetTransmission;
      lit_side_W = -lit_side_W;
    }
    if (lit_side_W.dot(found->to_light_W) <= 0.0) return;
    const Eigen::Vector3f arriving =
        static_cast<float>(cosine) * diffuse.cwiseProduct(found->color);
    if (!s_.options.shadows || !s_.scene.shadows || !light.cast_shadows) {
      samples_[owners_[i]].light += arriving;
      return;
    }
    const double reach_m = std::min(found->distance_m, s_.options.max_range_m);
    shadow_rays_.push_back({at_W + kOffset_m * lit_side_W, found->to_light_W, reach_m - kOffset_m});
    waiting_.push_back({owners_[i], arriving});
  }

  void add_unshadowed() {
    const auto in_shadow = std::make_unique<bool[]>(shadow_rays_.size());
    if (s_.options.quickly) {
      s_.rays.find_shadows_quickly(shadow_rays_.data(), shadow_rays_.size(), in_shadow.get());
    } else {
      s_.rays.find_shadows(shadow_rays_.data(), shadow_rays_.size(), in_shadow.get());
    }
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      if (!in_shadow[i]) samples_[waiting_[i].sample].light += waiting_[i].light;
    }
    shadow_rays_.clear();
    waiting_.clear();
  }

  const TileShading& s_;
  const TileArea area_;
  const Eigen::Matrix3d R_WC_;
  double pixel_rad_ = 0.0;
  std::vector<std::optional<Illumination>> distant_;  // of each light that is the same everywhere
  std::vector<Sample> samples_;
  std::vector<SceneRay> rays_;
  std::vector<std::size_t> owners_;  // the sample of each ray
  std::vector<SurfacePoint> points_;
  std::vector<RayHit> hits_;
  std::vector<SceneRay> next_rays_;
  std::vector<std::size_t> next_owners_;
  std::vector<SceneRay> shadow_rays_;
  std::vector<Waiting> waiting_;
  std::vector<Seen> seen_;                                    // of the first samples
  std::vector<std::pair<std::size_t, std::size_t>> between_;  // places in the frame, and samples
};

}  // namespace

void shade_tile(const TileShading& shading, const TileArea& area, Image& image) {
  Tile tile(shading, area);
  tile.shade();
  tile.write(image);
}

void shoot_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                Frame& frame) {
  Tile(shading, area).shoot(parts, frame);
}

}  // namespace ardee
