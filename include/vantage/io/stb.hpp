// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdlib>

// stb_image with its PNG and JPEG decoders only, private to the source that includes it. A program that uses it itself
// does so in another source.
#if defined(STBI_INCLUDE_STB_IMAGE_H)
#error "vantage compiles stb_image with limits of its own: include vantage first, or stb_image in another source"
#endif

namespace vantage::detail {

/// No single allocation of stb_image is larger on this thread [bytes]; set from a picture's header before it is
/// decoded, because compressed data may say something else than the header.
inline thread_local std::size_t stb_most_bytes = 0;

/// Zeros: stb_image reads tables and pixels that a hostile file never set.
inline void* stb_allocate(std::size_t size) { return size > stb_most_bytes ? nullptr : std::calloc(size, 1); }
inline void* stb_reallocate(void* old, std::size_t size) {
  return size > stb_most_bytes ? nullptr : std::realloc(old, size);
}

}  // namespace vantage::detail

// Corrupt JPEG data make its decoder shift a 0 by 32 bits and more, and coefficients overflow: the pixels are as wrong
// as the data, and no more than that. Sanitizers look at all else.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((no_sanitize("shift", "signed-integer-overflow"))), apply_to = function)
#endif
#define STBI_MALLOC(size) vantage::detail::stb_allocate(size)
#define STBI_REALLOC(old, size) vantage::detail::stb_reallocate(old, size)
#define STBI_FREE(old) std::free(old)
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_FAILURE_STRINGS
#define STBI_MAX_DIMENSIONS 32768
#define STBI_ASSERT(condition) ((void)sizeof(condition))
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif
#undef STB_IMAGE_IMPLEMENTATION
