// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>

// stb_image_write, private to the source that includes it. A program that uses it itself does so in another source.
#if defined(INCLUDE_STB_IMAGE_WRITE_H)
#error "vantage compiles stb_image_write for itself: include vantage first, or stb_image_write in another source"
#endif
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#undef STB_IMAGE_WRITE_IMPLEMENTATION

namespace vantage {

/// JPEG bytes of a picture; quality 1 to 100. The same picture gives the same bytes.
inline std::vector<std::byte> encode_jpeg(const Picture& picture, int quality = 90) {
  Check check("encode_jpeg");
  check(quality >= 1 && quality <= 100, "quality", quality, "1 to 100");
  check.done();
  std::vector<std::byte> bytes;
  const auto append = [](void* to, void* data, int size) {
    auto& out = *static_cast<std::vector<std::byte>*>(to);
    out.insert(out.end(), static_cast<const std::byte*>(data), static_cast<const std::byte*>(data) + size);
  };
  if (!stbi_write_jpg_to_func(append, &bytes, picture.width(), picture.height(), 3, picture.data(), quality))
    throw Error("encode_jpeg", "the picture cannot be written");
  return bytes;
}

/// Writes a JPEG file, whole or not at all.
inline void write_jpeg(const std::filesystem::path& path, const Picture& picture, int quality = 90) {
  write_file(path, encode_jpeg(picture, quality));
}

}  // namespace vantage
