// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_readings.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "ardee_sim/core/normal_table.h"

namespace ardee::devices {
namespace {

constexpr std::uint32_t kPointBytes = 32;
constexpr std::uint32_t kColorOffset = 16;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <typename Number>
ImageReading image_of(const render::Frame& frame, const char* encoding,
                      const std::vector<Number>& numbers) {
  ImageReading image;
  image.width = static_cast<std::uint32_t>(frame.width);
  image.height = static_cast<std::uint32_t>(frame.height);
  image.encoding = encoding;
  image.step = image.width * static_cast<std::uint32_t>(sizeof(Number));
  image.data.resize(numbers.size() * sizeof(Number));
  std::memcpy(image.data.data(), numbers.data(), image.data.size());
  return image;
}

/// 0x00RRGGBB of a pixel; a Bayer pixel counts as grey.
std::uint32_t packed_color(const std::vector<std::uint8_t>& pixels, render::PixelFormat format,
                           std::size_t pixel) {
  const std::uint8_t* at =
      &pixels[pixel * static_cast<std::size_t>(render::bytes_per_pixel(format))];
  const auto pack = [](std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    return r << 16 | g << 8 | b;
  };
  if (format == render::PixelFormat::kRgb8) return pack(at[0], at[1], at[2]);
  if (format == render::PixelFormat::kBgr8) return pack(at[2], at[1], at[0]);
  if (format == render::PixelFormat::kMono16) return pack(at[1], at[1], at[1]);
  return pack(at[0], at[0], at[0]);
}

}  // namespace

std::vector<float> measured_depths(const render::Frame& frame, const DepthParams& params,
                                   const CounterRng& noise) {
  std::vector<float> depths_m(frame.depth_m.size());
  const bool noisy = params.has_noise();
  const NormalTable& normals = NormalTable::get();
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    auto z = static_cast<double>(frame.depth_m[i]);
    if (noisy && std::isfinite(z)) {
      const double std_m =
          params.noise_constant_m + z * (params.noise_linear + z * params.noise_quadratic_per_m);
      z += std_m * static_cast<double>(normals[static_cast<std::uint16_t>(noise.bits(i))]);
    }
    depths_m[i] = z >= params.nearest_m && z <= params.farthest_m ? static_cast<float>(z) : kNan;
  }
  return depths_m;
}

ImageReading color_image(const render::Frame& frame, const CameraParams& params,
                         const CounterRng& noise) {
  ImageReading image;
  image.width = static_cast<std::uint32_t>(frame.width);
  image.height = static_cast<std::uint32_t>(frame.height);
  image.encoding = params.encoding;
  image.step =
      image.width * static_cast<std::uint32_t>(render::bytes_per_pixel(params.development.format));
  image.data = render::form_image(frame, params.development, noise);
  return image;
}

ImageReading depth_image(const render::Frame& frame, const std::vector<float>& depths_m,
                         const DepthParams& params) {
  if (!params.millimetres) return image_of(frame, "32FC1", depths_m);
  std::vector<std::uint16_t> depths_mm;
  depths_mm.reserve(depths_m.size());
  for (const float z : depths_m) {
    const float z_mm = std::round(1000.0f * z);
    depths_mm.push_back(z_mm <= 65535.0f ? static_cast<std::uint16_t>(z_mm) : std::uint16_t{0});
  }
  return image_of(frame, "16UC1", depths_mm);
}

ImageReading label_image(const render::Frame& frame) {
  return image_of(frame, "16UC1", frame.labels);
}

ImageReading instance_image(const render::Frame& frame) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(frame.entities.size());
  for (const std::uint32_t entity : frame.entities)
    numbers.push_back(entity + 1);  // no instance: 0
  return image_of(frame, "32SC1", numbers);
}

std::vector<std::uint8_t> cloud_pixels(const render::Frame& frame, const CameraParams& params,
                                       const ImageReading& image, const CounterRng& noise) {
  if (params.cloud_format == params.development.format && !image.data.empty()) return image.data;
  render::ImageFormation colored = params.development;
  colored.format = params.cloud_format;
  return render::form_image(frame, colored, noise);
}

PointCloudReading point_cloud(const render::Camera& camera, const std::vector<float>& depths_m,
                              const std::vector<std::uint8_t>& pixels, render::PixelFormat format) {
  PointCloudReading cloud;
  cloud.width = static_cast<std::uint32_t>(camera.width);
  cloud.height = static_cast<std::uint32_t>(camera.height);
  cloud.fields = {{"x", 0}, {"y", 4}, {"z", 8}, {"rgb", kColorOffset}};
  cloud.point_step = kPointBytes;
  cloud.is_dense = false;
  cloud.data.resize(depths_m.size() * kPointBytes);
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    const double column = static_cast<double>(i % cloud.width);
    const double row = static_cast<double>(i / cloud.width);
    const float z = depths_m[i];
    const Eigen::Vector3f way_C = camera.direction_C(column + 0.5, row + 0.5).cast<float>();
    const float point[3] = {-way_C.y() * z, -way_C.z() * z, z};
    const std::uint32_t color = packed_color(pixels, format, i);
    std::uint8_t* at = &cloud.data[i * kPointBytes];
    std::memcpy(at, point, sizeof(point));
    std::memcpy(at + kColorOffset, &color, sizeof(color));
  }
  return cloud;
}

}  // namespace ardee::devices
