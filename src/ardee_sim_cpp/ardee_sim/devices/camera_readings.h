// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/devices/camera_params.h"

namespace ardee {

/// The depths of a frame with the device's error, NaN outside its limits; pixel i uses counter i.
std::vector<float> measured_depths(const Frame& frame, const DepthParams& params,
                                   const CounterRng& noise);

ImageReading color_image(const Frame& frame, const CameraParams& params, const CounterRng& noise);
/// 32FC1 in metres, or 16UC1 in millimetres with 0 for not a number.
ImageReading depth_image(const Frame& frame, const std::vector<float>& depths_m,
                         const DepthParams& params);
/// 16UC1: classes, 0 for none.
ImageReading label_image(const Frame& frame);
/// 32SC1: 0 for nothing, else 1 and up.
ImageReading instance_image(const Frame& frame);
/// Organised: x, y, z on optical axes and rgb, 32 bytes a point, as Gazebo packs it. `image` gives
/// the colours, of that format.
PointCloudReading point_cloud(const Camera& camera, const std::vector<float>& depths_m,
                              const ImageReading& image, PixelFormat format);

}  // namespace ardee
