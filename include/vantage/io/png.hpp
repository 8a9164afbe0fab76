// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>

namespace vantage {

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

namespace detail {

// libpng's simplified writer takes 16-bit values for linear light and encodes them anew; depth and labels must stay
// what they are, so this is the long way. Nothing with a destructor lives between setjmp and the last call.
inline bool encode_grey_16(const Image<std::uint16_t>& image, std::vector<std::byte>& bytes, std::string& message) {
  const auto refuse = [](png_structp png, png_const_charp why) {
    *static_cast<std::string*>(png_get_error_ptr(png)) = why;
    png_longjmp(png, 1);
  };
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, refuse, [](png_structp, png_const_charp) {});
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  const auto append = [](png_structp p, png_bytep data, std::size_t size) {
    auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    out.insert(out.end(), begin, begin + size);
  };
  png_set_write_fn(png, &bytes, append, [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.cols()), static_cast<png_uint_32>(image.rows()), 16,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_swap(png);  // little-endian values
  for (Eigen::Index row = 0; row < image.rows(); ++row)
    png_write_row(png, reinterpret_cast<png_const_bytep>(image.data() + row * image.cols()));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace detail

/// PNG bytes of 16-bit grey values, such as depth in millimetres or labels. Throws Error if the image is empty or
/// libpng refuses.
inline std::vector<std::byte> encode_png(const Image<std::uint16_t>& image) {
  std::vector<std::byte> bytes;
  std::string message = "an empty image";
  if (image.size() == 0 || !detail::encode_grey_16(image, bytes, message))
    throw Error("encode_png", message, "a picture that libpng can write");
  return bytes;
}

/// Writes a PNG file, whole or not at all.
inline void write_png(const std::filesystem::path& path, const Picture& picture) {
  write_file(path, encode_png(picture));
}
inline void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
  write_file(path, encode_png(image));
}

}  // namespace vantage
