// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/file.hpp>

namespace vantage {

/// A raster as the bytes of a .npy file (numpy's format 1.0): float64, shape (rows, columns), C order.
inline std::vector<std::byte> encode_npy(const Image<double>& values) {
  constexpr std::string_view magic = "\x93NUMPY\x01";  // and a version's second byte, 0
  std::string header =
      concat("{'descr': '<f8', 'fortran_order': False, 'shape': (", values.rows(), ", ", values.cols(), "), }");
  const std::size_t before = magic.size() + 3;  // the 0 and a 16-bit length
  header.append(63 - (before + header.size()) % 64, ' ').append("\n");
  const std::size_t data = static_cast<std::size_t>(values.size()) * sizeof(double);
  std::vector<std::byte> bytes(before + header.size() + data);
  std::memcpy(bytes.data(), magic.data(), magic.size());
  const auto length = static_cast<std::uint16_t>(header.size());
  std::memcpy(bytes.data() + magic.size() + 1, &length, sizeof length);
  std::memcpy(bytes.data() + before, header.data(), header.size());
  if (data != 0) std::memcpy(bytes.data() + before + header.size(), values.data(), data);
  return bytes;
}

/// Writes a .npy file, whole or not at all: numpy.load(path) gives the raster.
inline void write_npy(const std::filesystem::path& path, const Image<double>& values) {
  write_file(path, encode_npy(values));
}

}  // namespace vantage
