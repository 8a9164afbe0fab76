// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/read_picture.hpp>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/io/png.hpp>
#include <vantage/io/write_jpeg.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"
#include "unit/io/reference_files.hpp"

namespace vantage {
namespace {

using test::reference_file;

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Picture noise(int width, int height) {
  Rng rng(3);
  Picture picture(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (auto& c : picture(row, column)) c = static_cast<std::uint8_t>(rng.index(256));
  return picture;
}

TEST(ReadPicture, PngComesBackPixelForPixel) {
  for (const auto& [w, h] : {std::pair{1, 1}, std::pair{3, 5}, std::pair{200, 117}}) {
    Picture picture = noise(w, h);
    Picture again = decode_picture(text(encode_png(picture)), "a.png");
    ASSERT_EQ(again.width(), w);
    ASSERT_EQ(again.height(), h);
    EXPECT_EQ(std::move(again).take(), std::move(picture).take());
  }
}

TEST(ReadPicture, SixteenBitsComeBackValueForValue) {
  const Image<std::uint16_t> values =
      Image<std::uint16_t>::NullaryExpr(61, 83, [](Eigen::Index r, Eigen::Index c) { return r * 1070 + c * 7; });
  const test::TemporaryFolder folder;
  write_png(folder.path() / "depth.png", values);
  EXPECT_TRUE((read_grey_16(folder.path() / "depth.png") == values).all());
  EXPECT_THROW(static_cast<void>(encode_png(Image<std::uint16_t>())), Error);
}

// What Pillow wrote; see reference_files.hpp.
TEST(ReadPicture, ReadsWhatPillowWrote) {
  const Image<std::uint16_t> deep = decode_grey_16(reference_file("png_grey_16"), "a");
  ASSERT_EQ(deep.rows(), 3);
  ASSERT_EQ(deep.cols(), 4);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(deep.data()[i], i * 5957);
  for (const char* name : {"png_rgb", "png_rgba", "ppm"}) {
    const Picture picture = decode_picture(reference_file(name), name);
    ASSERT_EQ(picture.width(), 4) << name;
    ASSERT_EQ(picture.height(), 3) << name;
    for (int i = 0; i < 36; ++i) EXPECT_EQ(picture.data()[i], i * 7) << name;
  }
  for (const char* name : {"png_grey", "pgm"}) {
    const Image<std::uint16_t> grey = decode_grey_16(reference_file(name), name);
    for (int i = 0; i < 12; ++i) EXPECT_EQ(grey.data()[i], i * 21) << name;
    const Picture picture = decode_picture(reference_file(name), name);
    EXPECT_EQ(picture(2, 3), (Rgb{231, 231, 231})) << name;
  }
  EXPECT_EQ(decode_picture(reference_file("png_palette"), "palette").width(), 4);
  for (const char* name : {"jpeg", "jpeg_progressive"}) {
    const Picture picture = decode_picture(reference_file(name), name);
    ASSERT_EQ(picture.width(), 16);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(picture(y, x)[static_cast<std::size_t>(c)], 30 + 4 * x + 3 * y + 20 * c, 4) << name;
  }
  EXPECT_NEAR(decode_grey_16(reference_file("jpeg_grey"), "grey")(3, 5), 30 + 4 * 5 + 3 * 3, 3);
}

TEST(ReadPicture, DeepPicturesBecomeEightBitsWithRounding) {
  Image<std::uint16_t> values(1, 3);
  values << 0, 65535, 32768;
  const Picture picture = decode_picture(text(encode_png(values)), "a");
  EXPECT_EQ(picture(0, 0)[0], 0);
  EXPECT_EQ(picture(0, 1)[1], 255);
  EXPECT_EQ(picture(0, 2)[2], 128);
}

TEST(ReadPicture, JpegComesBackAlmost) {
  Picture picture(50, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x)
      picture(y, x) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(5 * y), 90};
  const test::TemporaryFolder folder;
  write_jpeg(folder.path() / "a.jpg", picture, 95);
  const Picture again = read_picture(folder.path() / "a.jpg");
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(again(y, x)[c], picture(y, x)[c], 6);
  EXPECT_THROW(static_cast<void>(encode_jpeg(picture, 0)), Error);
}

TEST(ReadPicture, ReadsPortableGreyMaps) {
  EXPECT_EQ(decode_grey_16("P2 # text\n2 2\n9\n 0 3\n 6 9 ", "a")(1, 0), 6);
  EXPECT_EQ(decode_picture("P2 2 2 9 0 3 6 9", "a")(1, 1), (Rgb{255, 255, 255}));
  EXPECT_EQ(decode_grey_16(std::string("P5 2 1 65535\n\x12\x34\xFF\x00", 17), "a")(0, 0), 0x1234);
  EXPECT_EQ(decode_picture("P3 1 1 255 1 2 3", "a")(0, 0), (Rgb{1, 2, 3}));
  EXPECT_REFUSED(decode_grey_16("P5 2 2 255\nabc", "a.pgm"), "a.pgm: ends at byte 14");
  EXPECT_REFUSED(decode_grey_16("P5 2", "a.pgm"), "ends at byte 4; expected a height");
  EXPECT_REFUSED(decode_grey_16("P2 1 1 9 10", "a.pgm"), "a number above 9 at byte");
  EXPECT_REFUSED(decode_grey_16("P2 1 1 9 x", "a.pgm"), "'x' at byte 9");
  EXPECT_REFUSED(decode_grey_16("P5 1 1 0\nx", "a.pgm"), "the largest value is 0");
  EXPECT_REFUSED(decode_grey_16("P5 30000 30000 255\nx", "a.pgm"), "a picture of 30000 x 30000 px");
}

TEST(ReadPicture, NamesTheByteWhereATruncatedFileEnds) {
  for (const char* name : {"png_rgb", "png_grey_16", "jpeg", "jpeg_progressive", "pgm"}) {
    const std::string whole = reference_file(name);
    for (std::size_t size = 10; size < whole.size(); ++size)
      ASSERT_NE(test::message_of([&] {
                  return decode_raw_picture(whole.substr(0, size), name);
                }).find(concat(name, ": ends at byte ", size)),
                std::string::npos)
          << name << " of " << size << ": "
          << test::message_of([&] { return decode_raw_picture(whole.substr(0, size), name); });
  }
}

TEST(ReadPicture, RefusesWhatIsDamagedOrTooLarge) {
  std::string png = reference_file("png_rgb");
  png[50] ^= 1;
  EXPECT_REFUSED(decode_raw_picture(png, "a.png"), "a damaged chunk ends at byte");
  EXPECT_REFUSED(decode_raw_picture("GIF89a", "a.gif"), "a.gif: no picture that is known");
  EXPECT_REFUSED(decode_raw_picture("", "a"), "an empty file");
  EXPECT_REFUSED(decode_raw_picture(reference_file("png_rgb"), "a", {.pixels = 11}), "at most 11 in all");
  EXPECT_REFUSED(decode_raw_picture(reference_file("jpeg"), "a", {.pixels = 100}), "a picture of 16 x 16 px");
  EXPECT_REFUSED(decode_grey_16(reference_file("png_rgb"), "a"), "a picture in colour");
  const test::TemporaryFolder folder;
  EXPECT_REFUSED(read_picture(folder.put("a.png", png), {.bytes = 20}), "at most 20");
  EXPECT_REFUSED(read_picture(folder.path() / "none.png"), "no such file");
}

TEST(Picture, BecomesWhatMapsAndScenesUse) {
  const Picture picture = noise(7, 4);
  const ColourImage colour = to_colour(picture);
  ASSERT_EQ(colour.rows(), 4);
  EXPECT_FLOAT_EQ(colour.g(2, 3), static_cast<float>(picture(2, 3)[1]) / 255.0F);
  EXPECT_EQ(to_picture(colour)(3, 6), picture(3, 6));
  EXPECT_EQ(to_picture(to_texture(picture))(1, 5), picture(1, 5));
  EXPECT_NEAR(to_grey(Picture(2, 2, {255, 0, 0}))(1, 1), 0.299, 1e-6);
  EXPECT_EQ(to_byte(2), 255);
  EXPECT_EQ(to_byte(-1), 0);
  EXPECT_EQ(to_byte(NAN), 0);
  ColourImage uneven = colour;
  uneven.b.resize(1, 1);
  EXPECT_THROW(static_cast<void>(to_picture(uneven)), Error);
}

TEST(Picture, StoresDepthInSteps) {
  Image<float> depth(1, 5);
  depth << 1.2346F, NAN, 70.0F, 0.0001F, 65.535F;
  const Image<std::uint16_t> steps = depth_to_steps(depth, 0.001);
  Image<std::uint16_t> expected(1, 5);
  expected << 1235, 0, 0, 0, 65535;
  EXPECT_TRUE((steps == expected).all());
  const Image<float> again = depth_from_steps(steps, 0.001);
  EXPECT_FLOAT_EQ(again(0, 0), 1.235F);
  EXPECT_TRUE(std::isnan(again(0, 1)));
  EXPECT_THROW(static_cast<void>(depth_to_steps(depth, 0)), Error);
}

}  // namespace
}  // namespace vantage
