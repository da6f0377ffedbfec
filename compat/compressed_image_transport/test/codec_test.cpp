// SPDX-License-Identifier: MIT
#include "codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace compressed_image_transport {
namespace {

using sensor_msgs::CompressedImage;
using sensor_msgs::Image;

Image image_of(const std::string& encoding, std::uint32_t width, std::uint32_t height,
               std::uint32_t pixel_bytes, std::uint32_t pad = 0) {
  Image image;
  image.header.frame_id = "optical";
  image.header.stamp.sec = 7;
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = width * pixel_bytes + pad;
  image.data.resize(image.step * height);
  return image;
}

Image constant(const std::string& encoding, const std::vector<std::uint8_t>& pixel) {
  Image image = image_of(encoding, 37, 21, pixel.size());
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = pixel[i % pixel.size()];
  return image;
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const CodecError& error) {
    return error.what();
  }
  return "";
}

/// Peak signal-to-noise ratio of 8-bit data [dB].
double psnr_db(const Image& one, const Image& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.data.size(); ++i) {
    sum += std::pow(double{1.0} * one.data[i] - other.data[i], 2);
  }
  return 10.0 * std::log10(255.0 * 255.0 / (sum / static_cast<double>(one.data.size())));
}

CompressedImage jpeg_of(const Image& image) { return compress(image, {}); }

TEST(Jpeg, AConstantColourComesBack) {
  const std::vector<std::pair<std::string, std::vector<std::uint8_t>>> cases = {
      {"rgb8", {200, 40, 90}},       {"bgr8", {200, 40, 90}}, {"rgba8", {200, 40, 90, 255}},
      {"bgra8", {200, 40, 90, 255}}, {"mono8", {123}},        {"8UC1", {7}},
      {"bayer_rggb8", {77}}};
  for (const auto& [encoding, pixel] : cases) {
    const Image sent = constant(encoding, pixel);
    const Image found = decompress(jpeg_of(sent));
    ASSERT_EQ(found.encoding, encoding);
    ASSERT_EQ(found.data.size(), sent.data.size());
    EXPECT_EQ(found.header.stamp, sent.header.stamp);
    EXPECT_EQ(found.header.frame_id, "optical");
    for (std::size_t i = 0; i < sent.data.size(); ++i) {
      ASSERT_NEAR(found.data[i], sent.data[i], 3) << encoding << " at " << i;
    }
  }
}

TEST(Jpeg, AGradientKeepsItsShape) {
  Image sent = image_of("rgb8", 160, 120, 3, 5);
  for (std::uint32_t y = 0; y < 120; ++y) {
    for (std::uint32_t x = 0; x < 160; ++x) {
      std::uint8_t* pixel = &sent.data[y * sent.step + 3 * x];
      pixel[0] = static_cast<std::uint8_t>(x);
      pixel[1] = static_cast<std::uint8_t>(2 * y);
      pixel[2] = static_cast<std::uint8_t>(255 - x);
    }
  }
  Image tight = image_of("rgb8", 160, 120, 3);
  for (std::uint32_t y = 0; y < 120; ++y) {
    std::copy_n(&sent.data[y * sent.step], tight.step, &tight.data[y * tight.step]);
  }
  const CompressedImage good = jpeg_of(sent);
  EXPECT_GT(psnr_db(decompress(good), tight), 36.0);
  const CompressedImage poor = compress(sent, {"jpeg", 5, 9});
  EXPECT_LT(poor.data.size(), good.data.size());
  EXPECT_LT(psnr_db(decompress(poor), tight), psnr_db(decompress(good), tight));
}

TEST(Jpeg, FormatsAreThoseOfTheOriginal) {
  EXPECT_EQ(jpeg_of(constant("rgb8", {1, 2, 3})).format, "rgb8; jpeg compressed bgr8");
  EXPECT_EQ(jpeg_of(constant("mono8", {1})).format, "mono8; jpeg compressed ");
  EXPECT_EQ(jpeg_of(constant("mono16", {1, 2})).format, "mono16; png compressed ");
  EXPECT_EQ(compress(constant("bgr8", {1, 2, 3}), {"png"}).format, "bgr8; png compressed bgr8");
}

TEST(Jpeg, ADriversFormatLeavesTheEncodingToTheFile) {
  CompressedImage colour = jpeg_of(constant("rgb8", {250, 0, 0}));
  colour.format = "jpeg";
  const Image found = decompress(colour);
  EXPECT_EQ(found.encoding, "bgr8");
  EXPECT_GT(found.data[2], 240);
  CompressedImage grey = jpeg_of(constant("mono8", {50}));
  grey.format = "jpeg";
  EXPECT_EQ(decompress(grey).encoding, "mono8");
}

TEST(Png, SixteenBitsComeBackUnchanged) {
  std::mt19937 random(1);
  for (const std::string encoding : {"mono16", "16UC1"}) {
    for (const bool is_bigendian : {false, true}) {
      Image sent = image_of(encoding, 33, 17, 2);
      sent.is_bigendian = is_bigendian;
      for (auto& byte : sent.data) byte = static_cast<std::uint8_t>(random());
      const Image found = decompress(jpeg_of(sent));
      ASSERT_EQ(found.encoding, encoding);
      ASSERT_FALSE(found.is_bigendian);
      for (std::size_t i = 0; i < sent.data.size(); ++i) {
        ASSERT_EQ(found.data[is_bigendian ? i ^ 1u : i], sent.data[i]);
      }
    }
  }
}

TEST(Png, EightBitsComeBackUnchanged) {
  std::mt19937 random(2);
  for (const std::string encoding : {"mono8", "rgb8", "bgr8"}) {
    Image sent = image_of(encoding, 33, 17, encoding == "mono8" ? 1 : 3);
    for (auto& byte : sent.data) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(decompress(compress(sent, {"png", 80, 1})).data, sent.data) << encoding;
  }
  const Image opaque = constant("rgba8", {9, 8, 7, 255});
  EXPECT_EQ(decompress(compress(opaque, {"png"})).data, opaque.data);
}

TEST(Bad, EncodingsAreNamed) {
  for (const std::string encoding : {"32FC1", "32SC1", "yuv422", "rgb16", ""}) {
    const Image image = image_of(encoding, 4, 4, 4);
    EXPECT_EQ(error_of([&] { jpeg_of(image); }),
              "found an image of encoding '" + encoding +
                  "', expected mono8, rgb8, bgr8, rgba8, bgra8, an 8-bit Bayer pattern, mono16 or "
                  "16UC1");
  }
  EXPECT_EQ(error_of([] { compress(constant("mono8", {1}), {"gif"}); }),
            "found format 'gif', expected jpeg or png");
}

TEST(Bad, ImagesThatAreNotWhole) {
  Image image = constant("rgb8", {1, 2, 3});
  image.data.pop_back();
  EXPECT_EQ(error_of([&] { jpeg_of(image); }),
            "found 2330 bytes for an image of 37x21 pixels and 111 bytes a row, expected rows of "
            "111 bytes or more");
  for (auto change : {+[](Image& i) { i.width = 0; }, +[](Image& i) { i.height = 0; },
                      +[](Image& i) { i.step = 110; }, +[](Image& i) { i.width = 0xFFFFFFFF; },
                      +[](Image& i) { i.height = 0xFFFFFFFF; }}) {
    Image bad = constant("rgb8", {1, 2, 3});
    change(bad);
    EXPECT_NE(error_of([&] { jpeg_of(bad); }), "");
  }
  Image wide = image_of("mono8", 65501, 1, 1);
  EXPECT_NE(error_of([&] { jpeg_of(wide); }).find("at most 65500 a side"), std::string::npos);
}

TEST(Bad, FilesThatEndEarlyAreRefused) {
  for (const char* format : {"jpeg", "png"}) {
    const CompressedImage whole = compress(constant("rgb8", {200, 40, 90}), {format});
    for (std::size_t size = 0; size + 2 < whole.data.size(); ++size) {
      CompressedImage cut = whole;
      cut.data.resize(size);
      ASSERT_NE(error_of([&] { decompress(cut); }), "") << format << " of " << size << " bytes";
    }
  }
}

/// Sides of a JPEG stand in its frame header, after the marker and 3 bytes.
CompressedImage claiming(std::uint16_t side) {
  CompressedImage jpeg = jpeg_of(constant("rgb8", {200, 40, 90}));
  const std::uint8_t marker[] = {0xFF, 0xC0};
  auto at = std::search(jpeg.data.begin(), jpeg.data.end(), marker, marker + 2) + 5;
  for (int i = 0; i < 2; ++i) {
    *at++ = static_cast<std::uint8_t>(side >> 8);
    *at++ = static_cast<std::uint8_t>(side);
  }
  return jpeg;
}

TEST(Bad, ASmallFileMayNotClaimALargeImage) {
  EXPECT_NE(
      error_of([] { decompress(claiming(65000)); }).find("65000x65000 pixels, expected fewer"),
      std::string::npos);
  EXPECT_NE(error_of([] { decompress(claiming(0)); }), "");
}

TEST(Bad, AnyBytesAreReadOrRefused) {
  std::mt19937 random(3);
  int refused = 0;
  constexpr int kTries = 4000;
  const CompressedImage files[] = {compress(constant("rgb8", {200, 40, 90}), {}),
                                   compress(constant("mono16", {200, 40}), {})};
  for (int i = 0; i < kTries; ++i) {
    CompressedImage bad = files[i % 2];
    for (int n = random() % 4 + 1; n > 0; --n) bad.data[random() % bad.data.size()] = random();
    refused += error_of([&] { decompress(bad); }).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, kTries / 10);
  EXPECT_LT(refused, kTries);
}

}  // namespace
}  // namespace compressed_image_transport
