// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/devices/camera_params.h"

namespace ardee::devices {

/// The depths of a frame with the device's error, NaN outside its limits; pixel i uses counter i.
std::vector<float> measured_depths(const render::Frame& frame, const DepthParams& params,
                                   const CounterRng& noise);

ImageReading color_image(const render::Frame& frame, const CameraParams& params,
                         const CounterRng& noise);
/// 32FC1 in metres, or 16UC1 in millimetres with 0 for not a number.
ImageReading depth_image(const render::Frame& frame, const std::vector<float>& depths_m,
                         const DepthParams& params);
/// 16UC1: classes, 0 for none.
ImageReading label_image(const render::Frame& frame);
/// 32SC1: 0 for nothing, else 1 and up.
ImageReading instance_image(const render::Frame& frame);
/// The colours of a cloud in the format of <format>: those of `image` where it has it, is not
/// empty.
std::vector<std::uint8_t> cloud_pixels(const render::Frame& frame, const CameraParams& params,
                                       const ImageReading& image, const CounterRng& noise);
/// Organised: x, y, z on optical axes and rgb, 32 bytes a point, as Gazebo packs it; the pixels are
/// of that format.
PointCloudReading point_cloud(const render::Camera& camera, const std::vector<float>& depths_m,
                              const std::vector<std::uint8_t>& pixels, render::PixelFormat format);

}  // namespace ardee::devices
