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
/// Image of the depths: 32FC1 in metres, or 16UC1 in millimetres with 0 for NaN.
ImageReading depth_image(const render::Frame& frame, const std::vector<float>& depths_m,
                         const DepthParams& params);
/// Image of the classes in 16UC1, 0 for none.
ImageReading label_image(const render::Frame& frame);
/// Image of the instances in 32SC1: 0 for none, else 1 and up.
ImageReading instance_image(const render::Frame& frame);
/// Colours of a cloud in the format of <format>: those of `image` if it has that format and is not
/// empty.
std::vector<std::uint8_t> cloud_pixels(const render::Frame& frame, const CameraParams& params,
                                       const ImageReading& image, const CounterRng& noise);
/// Organised cloud: x, y, z in optical axes and rgb, 32 bytes per point, as Gazebo packs it;
/// `pixels` are in `format`.
PointCloudReading point_cloud(const render::Camera& camera, const std::vector<float>& depths_m,
                              const std::vector<std::uint8_t>& pixels, render::PixelFormat format);

}  // namespace ardee::devices
