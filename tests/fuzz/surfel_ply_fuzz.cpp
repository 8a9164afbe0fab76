// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a PLY file of surfels or of Gaussians: refused with an Error, or read so that what is written again is
// read as as many.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/splat_ply.hpp>

namespace {

using namespace vantage;

constexpr PlyLimits limits{.bytes = 1 << 20, .header_bytes = 8192, .triangles = 4096};

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    const Surfels surfels = decode_surfel_ply(bytes, "input", limits);
    require(decode_surfel_ply(encode_surfel_ply(surfels), "again").confidence == surfels.confidence);
  } catch (const Error&) {}
  try {
    const Surfels surfels = decode_splat_ply(bytes, "input", limits);
    require(decode_splat_ply(encode_splat_ply(surfels), "again").size() <= surfels.size());  // colours may overflow
  } catch (const Error&) {}
  return 0;
}
