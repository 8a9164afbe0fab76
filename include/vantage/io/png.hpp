// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>

namespace vantage {

using Rgb = std::array<std::uint8_t, 3>;

/// A picture of 8-bit sRGB pixels, the first row on top.
class Picture {
 public:
  /// Throws Error unless both sides are 1 to 32768 px.
  Picture(int width, int height, Rgb colour = {255, 255, 255}) : width_(width), height_(height) {
    Check check("Picture");
    check(width >= 1 && width <= 32768, "width", width, "1 to 32768 px");
    check(height >= 1 && height <= 32768, "height", height, "1 to 32768 px");
    check.done();
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour);
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Rgb& operator()(int row, int column) { return pixels_[index(row, column)]; }
  [[nodiscard]] const Rgb& operator()(int row, int column) const { return pixels_[index(row, column)]; }
  [[nodiscard]] const std::uint8_t* data() const { return pixels_.data()->data(); }

 private:
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }
  int width_, height_;
  std::vector<Rgb> pixels_;
};

/// PNG bytes of a picture (libpng). The same picture gives the same bytes. Throws Error if libpng refuses.
inline std::vector<std::byte> encode_png(const Picture& picture) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.data(), 0, nullptr))
    throw Error("encode_png", image.message, "a picture that libpng can write");
  bytes.resize(size);
  return bytes;
}

/// Writes a PNG file, whole or not at all.
inline void write_png(const std::filesystem::path& path, const Picture& picture) {
  write_file(path, encode_png(picture));
}

}  // namespace vantage
