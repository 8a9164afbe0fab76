// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/scene.hpp>

namespace vantage {

using Rgb = std::array<std::uint8_t, 3>;

/// A picture of 8-bit sRGB pixels, the first row on top.
class Picture {
 public:
  /// Throws Error unless both sides are 1 to 32768 px.
  Picture(int width, int height, Rgb colour = {255, 255, 255}) : Picture(width, height, std::vector<Rgb>()) {
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour);
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Rgb& operator()(int row, int column) { return pixels_[index(row, column)]; }
  [[nodiscard]] const Rgb& operator()(int row, int column) const { return pixels_[index(row, column)]; }
  [[nodiscard]] const std::uint8_t* data() const { return pixels_.data()->data(); }
  [[nodiscard]] std::uint8_t* data() { return pixels_.data()->data(); }
  /// The pixels, row by row.
  [[nodiscard]] std::vector<Rgb> take() && { return std::move(pixels_); }

 private:
  Picture(int width, int height, std::vector<Rgb> pixels) : width_(width), height_(height), pixels_(std::move(pixels)) {
    Check check("Picture");
    check(width >= 1 && width <= 32768, "width", width, "1 to 32768 px");
    check(height >= 1 && height <= 32768, "height", height, "1 to 32768 px");
    check.done();
  }
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }
  int width_, height_;
  std::vector<Rgb> pixels_;
};

/// The nearest 8-bit value of x in [0, 1]; values outside are clamped, NaN is 0.
inline std::uint8_t to_byte(float x) {
  return static_cast<std::uint8_t>(x > 0 ? std::lround(255.0F * std::min(x, 1.0F)) : 0);
}

/// Colours in [0, 1].
inline ColourImage to_colour(const Picture& picture) {
  ColourImage image;
  image.resize(picture.height(), picture.width());
  const std::array<Image<float>*, 3> planes = {&image.r, &image.g, &image.b};
  const std::uint8_t* bytes = picture.data();
  for (Eigen::Index k = 0; k < image.r.size(); ++k)
    for (Image<float>* plane : planes) plane->data()[k] = static_cast<float>(*bytes++) / 255.0F;
  return image;
}

/// The nearest 8-bit picture. Throws Error if the image is empty or its planes differ in size.
inline Picture to_picture(const ColourImage& image) {
  for (const Image<float>* plane : {&image.g, &image.b})
    if (plane->rows() != image.rows() || plane->cols() != image.cols())
      throw Error("to_picture", "colour planes of different size", "red, green and blue of one size");
  Picture picture(static_cast<int>(image.cols()), static_cast<int>(image.rows()));
  std::uint8_t* bytes = picture.data();
  for (Eigen::Index k = 0; k < image.r.size(); ++k)
    for (const Image<float>* plane : {&image.r, &image.g, &image.b}) *bytes++ = to_byte(plane->data()[k]);
  return picture;
}

/// Brightness in [0, 1]: luma of ITU-R BT.601, of the display-encoded values.
inline Image<float> to_grey(const Picture& picture) {
  Image<float> grey(picture.height(), picture.width());
  const std::uint8_t* p = picture.data();
  for (Eigen::Index k = 0; k < grey.size(); ++k, p += 3)
    grey.data()[k] =
        (0.299F * static_cast<float>(p[0]) + 0.587F * static_cast<float>(p[1]) + 0.114F * static_cast<float>(p[2])) /
        255.0F;
  return grey;
}

inline Texture to_texture(Picture picture) {
  const int width = picture.width(), height = picture.height();
  return {width, height, std::move(picture).take()};
}

/// Throws Error if the texture is empty or not of its size.
inline Picture to_picture(const Texture& texture) {
  Picture picture(texture.width, texture.height);
  if (texture.rgb.size() != static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height))
    throw Error("to_picture", concat("a texture with ", texture.rgb.size(), " texels"), "width x height");
  std::copy(texture.rgb.begin(), texture.rgb.end(), reinterpret_cast<Rgb*>(picture.data()));
  return picture;
}

/// Depth in steps of `unit_m`, as depth pictures store it: 0 where there is none, or more than 65535 steps.
inline Image<std::uint16_t> depth_to_steps(const Image<float>& depth_m, double unit_m) {
  Check check("depth_to_steps");
  check.positive("unit_m", unit_m);
  check.done();
  return depth_m.unaryExpr([unit_m](float d) {
    const double steps = std::round(static_cast<double>(d) / unit_m);
    return static_cast<std::uint16_t>(steps >= 1 && steps <= 65535 ? steps : 0);
  });
}

/// Depth [m] from steps of `unit_m`; NaN where they are 0.
inline Image<float> depth_from_steps(const Image<std::uint16_t>& steps, double unit_m) {
  Check check("depth_from_steps");
  check.positive("unit_m", unit_m);
  check.done();
  return steps.unaryExpr([unit_m](std::uint16_t s) {
    return s == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(s * unit_m);
  });
}

}  // namespace vantage
