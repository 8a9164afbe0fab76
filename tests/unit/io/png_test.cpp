// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/png.hpp>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/io/colour_map.hpp>

#include "temporary_folder.hpp"

namespace vantage {
namespace {

// What another reader of PNG sees.
std::vector<Rgb> decode(std::span<const std::byte> bytes, int& width, int& height) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
  image.format = PNG_FORMAT_RGB;
  width = static_cast<int>(image.width);
  height = static_cast<int>(image.height);
  std::vector<Rgb> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0) << image.message;
  return pixels;
}

TEST(Png, ComesBackPixelForPixel) {
  Rng rng(2);
  for (const auto& [w, h] : {std::pair{1, 1}, std::pair{3, 5}, std::pair{200, 117}}) {
    Picture picture(w, h);
    for (int row = 0; row < h; ++row)
      for (int column = 0; column < w; ++column)
        for (auto& c : picture(row, column)) c = static_cast<std::uint8_t>(rng.index(256));
    int width = 0, height = 0;
    const auto pixels = decode(encode_png(picture), width, height);
    ASSERT_EQ(width, w);
    ASSERT_EQ(height, h);
    for (int row = 0; row < h; ++row)
      for (int column = 0; column < w; ++column)
        ASSERT_EQ(pixels[static_cast<std::size_t>(row * w + column)], picture(row, column));
  }
}

TEST(Png, WritesFilesAndRepeatsItself) {
  const test::TemporaryFolder folder;
  const Picture picture(40, 30, {10, 200, 30});
  write_png(folder.path() / "a.png", picture);
  const std::string bytes = read_file(folder.path() / "a.png", 1 << 20);
  const auto again = encode_png(picture);
  ASSERT_EQ(bytes.size(), again.size());
  EXPECT_EQ(std::memcmp(bytes.data(), again.data(), bytes.size()), 0);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1A\n");
  EXPECT_THROW(write_png(folder.path() / "no" / "a.png", picture), Error);
}

TEST(Png, RefusesSizesThatAreNone) {
  EXPECT_THROW(Picture(0, 5), Error);
  EXPECT_THROW(Picture(5, -1), Error);
  EXPECT_THROW(Picture(1 << 20, 1), Error);
}

TEST(ColourMap, RunsFromBlueToYellowAndGetsBrighter) {
  EXPECT_EQ(viridis(0), (Rgb{68, 1, 84}));
  EXPECT_EQ(viridis(-3), viridis(0));
  EXPECT_EQ(viridis(1), (Rgb{253, 231, 37}));
  EXPECT_EQ(viridis(7), viridis(1));
  EXPECT_EQ(viridis(std::numeric_limits<double>::quiet_NaN()), (Rgb{224, 224, 224}));
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Rgb c = viridis(0.01 * i);
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GT(luminance, before) << i;
    before = luminance;
  }
}

TEST(ColourMap, DrawsFieldsWithYUp) {
  Image<double> values(2, 3);
  values << 0, 1, 2,  //
      3, std::numeric_limits<double>::quiet_NaN(), 5;
  const Picture p = draw(values, 0, 5, 4);
  ASSERT_EQ(p.width(), 12);
  ASSERT_EQ(p.height(), 8);
  EXPECT_EQ(p(7, 0), viridis(0)) << "row 0 is at the bottom";
  EXPECT_EQ(p(4, 3), viridis(0));
  EXPECT_EQ(p(3, 0), viridis(0.6));
  EXPECT_EQ(p(0, 11), viridis(1));
  EXPECT_EQ(p(0, 4), (Rgb{224, 224, 224}));
  EXPECT_EQ(draw(Image<double>::Constant(1, 1, 4.0), 4, 4)(0, 0), viridis(0)) << "a constant field";
  EXPECT_THROW(draw(values, 1, 0), Error);
  EXPECT_THROW(draw(values, std::numeric_limits<double>::quiet_NaN(), 0), Error);
  EXPECT_THROW(draw(values, 0, 1, 0), Error);
  EXPECT_THROW(draw(values, 0, 1, 20'000), Error);
}

}  // namespace
}  // namespace vantage
