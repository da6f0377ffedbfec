// SPDX-License-Identifier: MIT
#include <turbojpeg.h>

#include <memory>

#include "ardee_sim/image/decoders.h"

namespace ardee {

Image decode_jpeg(const ImageFile& file, Channels wanted) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
  const auto* bytes = reinterpret_cast<const unsigned char*>(file.bytes.data());
  int width = 0, height = 0, subsampling = 0, space = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, file.bytes.size(), &width, &height, &subsampling,
                          &space) != 0) {
    throw unreadable(file, tjGetErrorStr2(decoder.get()));
  }
  Image image =
      image_of(file, static_cast<std::size_t>(width), static_cast<std::size_t>(height), wanted);
  const bool is_print = space == TJCS_CMYK || space == TJCS_YCCK;
  std::vector<std::uint8_t> samples(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height) * 4);
  if (tjDecompress2(decoder.get(), bytes, file.bytes.size(), samples.data(), width, 0, height,
                    is_print ? TJPF_CMYK : TJPF_RGBA, 0) != 0) {
    throw unreadable(file, tjGetErrorStr2(decoder.get()));
  }
  if (is_print) {  // of inks, which Adobe's files give inverted: 255 is none
    for (std::size_t at = 0; at < samples.size(); at += 4) {
      const int black = samples[at + 3];
      for (std::size_t k = at; k < at + 3; ++k) {
        samples[k] = static_cast<std::uint8_t>((samples[k] * black + 127) / 255);
      }
      samples[at + 3] = 255;
    }
  }
  take_colors(samples, image);
  return image;
}

}  // namespace ardee
