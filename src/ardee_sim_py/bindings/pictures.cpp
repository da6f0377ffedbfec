// SPDX-License-Identifier: MIT
// Pictures of a simulation by cameras of nobody's.
#include "ardee_sim/render/image_formation.h"
#include "arrays.h"
#include "simulation.h"
#include "unlocked.h"

namespace ardee::python {
namespace {

template <typename T>
py::array_t<T> picture_of(std::vector<T> values, const render::Frame& frame) {
  return hold(std::move(values), {frame.height, frame.width});
}

}  // namespace

py::dict BoundSimulation::picture(const render::Camera& camera, const render::FrameParts& parts,
                                  const render::ImageFormation& development) {
  const Use use(*this);
  render::Frame frame;
  std::vector<std::uint8_t> rgb;
  {
    const Unlocked unlocked;
    frame = use->take_picture(camera, parts);
    if (parts.light) rgb = render::form_image(frame, development, CounterRng(0));
  }
  py::dict made;
  if (parts.light) made["rgb"] = hold(std::move(rgb), {frame.height, frame.width, 3});
  if (parts.depth) made["depth_m"] = picture_of(std::move(frame.depth_m), frame);
  if (parts.ids) {
    made["labels"] = picture_of(std::move(frame.labels), frame);
    std::vector<std::int32_t> instances;
    instances.reserve(frame.entities.size());
    for (const std::uint32_t entity : frame.entities) {
      instances.push_back(static_cast<std::int32_t>(entity + 1));  // none: 0
    }
    made["instances"] = picture_of(std::move(instances), frame);
  }
  if (parts.visuals) made["visuals"] = picture_of(std::move(frame.visuals), frame);
  return made;
}

std::vector<std::size_t> BoundSimulation::lone_pixels(const render::Camera& camera,
                                                      const std::vector<std::int32_t>& instances) {
  const Use use(*this);
  const Unlocked unlocked;
  std::vector<std::uint32_t> entities;
  for (const std::int32_t each : instances)
    entities.push_back(static_cast<std::uint32_t>(each - 1));
  return use->lone_pixels(camera, entities);
}

}  // namespace ardee::python
