// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a picture: refused with an Error, or decoded to what its header promised. A PNG is tried once more with
// its checksums made right, so that what lies behind them is reached too.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/png.hpp>
#include <vantage/io/read_picture.hpp>

namespace {

using namespace vantage;

constexpr PictureLimits limits{.bytes = 1 << 20, .pixels = 1 << 14};

void decode(const std::string& bytes) {
  try {
    const RawPicture raw = decode_raw_picture(bytes, "input", limits);
    if (raw.values.size() != static_cast<std::size_t>(raw.width * raw.height * raw.channels)) std::abort();
    for (const std::uint16_t v : raw.values)
      if (v > raw.maximum) std::abort();
    const Picture picture = decode_picture(bytes, "input", limits);
    if (picture.width() != raw.width || picture.height() != raw.height) std::abort();
    if (raw.channels == 1 && decode_grey_16(bytes, "input", limits).size() != raw.width * raw.height) std::abort();
  } catch (const Error&) {}
}

std::string with_right_checksums(std::string png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(png[i])); };
    const std::size_t size = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    if (size > png.size() - at - 12) break;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), static_cast<uInt>(size + 4));
    for (std::size_t i = 0; i < 4; ++i) png[at + 8 + size + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += 12 + size;
  }
  return png;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  decode(bytes);
  if (bytes.starts_with(detail::png_signature)) decode(with_right_checksums(bytes));
  return 0;
}
