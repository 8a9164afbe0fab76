// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a PLY file: refused with an Error, or read so that what is written again is read as the same.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/ply.hpp>
#include <vantage/io/write_ply.hpp>

namespace {

using namespace vantage;

constexpr PlyLimits limits{.bytes = 1 << 20, .header_bytes = 4096, .triangles = 4096};

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    const TriangleMesh mesh = decode_ply_mesh(bytes, "input", limits);
    for (const PlyFormat format : {PlyFormat::Text, PlyFormat::Binary}) {
      const TriangleMesh again = decode_ply_mesh(encode_ply(mesh, format), "again");
      require(again.vertices == mesh.vertices && again.triangles == mesh.triangles);
    }
  } catch (const Error&) {}
  try {
    PointCloud cloud = decode_ply_points(bytes, "input", limits);
    require(cloud.normals.empty() || cloud.normals.size() == cloud.points.size());
    cloud.scalars.clear();  // their names may be those of others
    require(decode_ply_points(encode_ply(cloud), "again").points == cloud.points);
  } catch (const Error&) {}
  return 0;
}
