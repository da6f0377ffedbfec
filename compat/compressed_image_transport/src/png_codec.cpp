// SPDX-License-Identifier: MIT
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>

#include "codec.h"
#include "encoding.h"

namespace compressed_image_transport {
namespace {

/// Where libpng's errors go: it leaves by longjmp, over no object that has a destructor.
struct Trouble {
  std::jmp_buf place;
  char what[120] = "";
};

[[noreturn]] void leave(png_structp png, png_const_charp what) {
  auto* trouble = static_cast<Trouble*>(png_get_error_ptr(png));
  std::strncpy(trouble->what, what, sizeof trouble->what - 1);
  std::longjmp(trouble->place, 1);
}

void keep_quiet(png_structp, png_const_charp) {}

constexpr bool is_little_endian() { return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__; }

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Trouble trouble;

  Writer() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &trouble, leave, keep_quiet)) {
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* file = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  try {
    file->insert(file->end(), data, data + size);
    return;
  } catch (const std::bad_alloc&) {
    // below, for png_error() is not to leave a handler
  }
  png_error(png, "no memory");
}

bool write(Writer& writer, const Pixels& pixels, int level) {
  if (setjmp(writer.trouble.place) != 0) return false;
  const Layout& layout = pixels.layout;
  const int colour = layout.is_colour() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY;
  png_set_compression_level(writer.png, level);
  png_set_IHDR(writer.png, writer.info, pixels.width, pixels.height, layout.bits, colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  if (layout.is_bgr) png_set_bgr(writer.png);
  if (layout.channels == 4) png_set_filler(writer.png, 0, PNG_FILLER_AFTER);
  if (layout.bits == 16 && is_little_endian() != pixels.is_swapped) png_set_swap(writer.png);
  for (std::uint32_t row = 0; row < pixels.height; ++row) {
    png_write_row(writer.png, pixels.data + row * pixels.step);
  }
  png_write_end(writer.png, nullptr);
  return true;
}

struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Trouble trouble;
  const std::vector<std::uint8_t>& file;
  std::size_t at = 0;

  explicit Reader(const std::vector<std::uint8_t>& data)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &trouble, leave, keep_quiet)),
        file(data) {
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw CodecError("no memory to read a PNG image");
    png_set_read_fn(png, this, take);
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  static void take(png_structp png, png_bytep data, png_size_t size) {
    auto* reader = static_cast<Reader*>(png_get_io_ptr(png));
    if (size > reader->file.size() - reader->at) png_error(png, "the data end early");
    std::memcpy(data, reader->file.data() + reader->at, size);
    reader->at += size;
  }
  [[noreturn]] void fail() const {
    throw CodecError(std::string("found PNG data that cannot be read: ") + trouble.what);
  }
};

bool read_head(Reader& reader, PngHead& head) {
  if (setjmp(reader.trouble.place) != 0) return false;
  png_read_info(reader.png, reader.info);
  head.width = png_get_image_width(reader.png, reader.info);
  head.height = png_get_image_height(reader.png, reader.info);
  const int type = png_get_color_type(reader.png, reader.info);
  const bool is_colour = (type & PNG_COLOR_MASK_COLOR) != 0;
  const bool is_deep = png_get_bit_depth(reader.png, reader.info) == 16 && !is_colour;
  head.layout = {is_colour ? 3 : 1, is_deep ? 16 : 8, true};
  head.raw_bytes = std::uint64_t{png_get_rowbytes(reader.png, reader.info)} * head.height;
  return true;
}

/// Has libpng give rows of the wanted layout.
bool set_transforms(Reader& reader, const Layout& wanted) {
  if (setjmp(reader.trouble.place) != 0) return false;
  png_structp png = reader.png;
  const int type = png_get_color_type(png, reader.info);
  const bool is_colour = (type & PNG_COLOR_MASK_COLOR) != 0;
  png_set_expand(png);
  png_set_strip_alpha(png);
  if (wanted.bits == 8) png_set_strip_16(png);
  if (wanted.is_colour() && !is_colour) png_set_gray_to_rgb(png);
  if (!wanted.is_colour() && is_colour) png_set_rgb_to_gray(png, 1, -1.0, -1.0);
  if (wanted.is_bgr) png_set_bgr(png);
  if (wanted.channels == 4) png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
  if (wanted.bits == 16 && is_little_endian()) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
  return true;
}

bool read_rows(Reader& reader, png_bytepp rows) {
  if (setjmp(reader.trouble.place) != 0) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Pixels& pixels, int level) {
  std::vector<std::uint8_t> file;
  Writer writer;
  if (writer.info == nullptr) throw CodecError("no memory to compress an image");
  png_set_write_fn(writer.png, &file, append, nullptr);
  if (!write(writer, pixels, level)) {
    throw CodecError(std::string("found an image that is not compressed: ") + writer.trouble.what);
  }
  return file;
}

PngHead read_png_head(const std::vector<std::uint8_t>& file) {
  Reader reader(file);
  PngHead head;
  if (!read_head(reader, head)) reader.fail();
  return head;
}

std::vector<std::uint8_t> decode_png(const std::vector<std::uint8_t>& file, const Layout& wanted) {
  Reader reader(file);
  PngHead head;
  if (!read_head(reader, head) || !set_transforms(reader, wanted)) reader.fail();
  const std::size_t step = head.width * wanted.pixel_bytes();
  if (png_get_rowbytes(reader.png, reader.info) != step) {
    throw CodecError("found PNG data of a kind that is not known, expected grey or colour");
  }
  std::vector<std::uint8_t> data(step * head.height);
  std::vector<png_bytep> rows(head.height);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = data.data() + row * step;
  if (!read_rows(reader, rows.data())) reader.fail();
  return data;
}

}  // namespace compressed_image_transport
