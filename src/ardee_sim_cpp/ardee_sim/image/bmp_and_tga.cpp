// SPDX-License-Identifier: MIT
// stb_image knows many formats; these two alone are built.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

#include <memory>

#include "ardee_sim/image/decoders.h"

namespace ardee {

Image decode_bmp_or_tga(const ImageFile& file, Channels wanted) {
  const auto* bytes = reinterpret_cast<const stbi_uc*>(file.bytes.data());
  const int length = static_cast<int>(file.bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes, length, &width, &height, &channels) == 0) {
    throw unreadable(file, stbi_failure_reason());
  }
  Image image =
      image_of(file, static_cast<std::size_t>(width), static_cast<std::size_t>(height), wanted);
  const std::unique_ptr<stbi_uc, void (*)(void*)> samples(
      stbi_load_from_memory(bytes, length, &width, &height, &channels, STBI_rgb_alpha),
      &stbi_image_free);
  if (samples == nullptr) throw unreadable(file, stbi_failure_reason());
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
  take_colors({samples.get(), samples.get() + count}, image);
  return image;
}

}  // namespace ardee
