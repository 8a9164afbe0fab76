// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/ply.hpp>

namespace vantage {

enum class PlyFormat { Text, Binary };

namespace detail {

/// Appends rows of values, as text or little-endian.
class PlyWriter {
 public:
  explicit PlyWriter(PlyFormat format) : text_(format == PlyFormat::Text) {
    bytes_ = concat("ply\nformat ", text_ ? "ascii" : "binary_little_endian", " 1.0\n");
  }
  void element(std::string_view name, std::size_t count) { bytes_ += concat("element ", name, " ", count, "\n"); }
  void property(std::string_view type, std::string_view name) { bytes_ += concat("property ", type, " ", name, "\n"); }
  void end_header() { bytes_ += "end_header\n"; }
  template <class T>
  void put(T value) {
    if (!text_) {
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
      return;
    }
    char digits[32];
    const auto end = [&] {
      if constexpr (std::is_floating_point_v<T>)
        return std::to_chars(digits, digits + sizeof digits, value).ptr;
      else
        return std::to_chars(digits, digits + sizeof digits, static_cast<std::int64_t>(value)).ptr;
    }();
    if (bytes_.back() != '\n') bytes_ += ' ';
    bytes_.append(digits, end);
  }
  void put(const Eigen::Vector3f& v) {
    for (int k = 0; k < 3; ++k) put(v[k]);
  }
  void put_colour(const Eigen::Vector3f& c) {
    for (int k = 0; k < 3; ++k) put(to_byte(c[k]));
  }
  void end_row() {
    if (text_) bytes_ += '\n';
  }
  [[nodiscard]] std::string take() && { return std::move(bytes_); }

 private:
  bool text_;
  std::string bytes_;
};

}  // namespace detail

/// A mesh as PLY, colours as 8 bits. The same mesh gives the same bytes. Throws Error if the mesh is not valid.
inline std::string encode_ply(const TriangleMesh& mesh, PlyFormat format = PlyFormat::Binary) {
  mesh.validate("encode_ply");
  detail::PlyWriter out(format);
  out.element("vertex", mesh.vertices.size());
  for (const char* axis : {"x", "y", "z"}) out.property("float", axis);
  if (!mesh.colours.empty())
    for (const char* channel : {"red", "green", "blue"}) out.property("uchar", channel);
  out.element("face", mesh.triangles.size());
  out.property("list uchar uint", "vertex_indices");
  out.end_header();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    out.put(mesh.vertices[i]);
    if (!mesh.colours.empty()) out.put_colour(mesh.colours[i]);
    out.end_row();
  }
  for (const auto& triangle : mesh.triangles) {
    out.put(std::uint8_t{3});
    for (const std::uint32_t corner : triangle) out.put(corner);
    out.end_row();
  }
  return std::move(out).take();
}

/// Points as PLY: position, normal, colour as 8 bits, then the scalars in their order, all as float. Throws Error if
/// something is not one a point, or a scalar's name is empty or holds a blank.
inline std::string encode_ply(const PointCloud& cloud, PlyFormat format = PlyFormat::Binary) {
  const auto one_each = [&](std::size_t size, std::string_view what) {
    if (size != cloud.points.size())
      throw Error("encode_ply", concat(size, " ", what), concat("one for each of ", cloud.points.size(), " points"));
  };
  if (!cloud.normals.empty()) one_each(cloud.normals.size(), "normals");
  if (!cloud.colours.empty()) one_each(cloud.colours.size(), "colours");
  detail::PlyWriter out(format);
  out.element("vertex", cloud.points.size());
  for (const char* axis : {"x", "y", "z"}) out.property("float", axis);
  if (!cloud.normals.empty())
    for (const char* axis : {"nx", "ny", "nz"}) out.property("float", axis);
  if (!cloud.colours.empty())
    for (const char* channel : {"red", "green", "blue"}) out.property("uchar", channel);
  for (const PointCloud::Scalar& s : cloud.scalars) {
    one_each(s.values.size(), concat("values of '", printable(s.name), "'"));
    if (s.name.empty() || s.name.find_first_of(" \t\r\n") != s.name.npos)
      throw Error("encode_ply", concat("a scalar named '", printable(s.name), "'"), "a word");
    out.property("float", s.name);
  }
  out.end_header();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    out.put(cloud.points[i]);
    if (!cloud.normals.empty()) out.put(cloud.normals[i]);
    if (!cloud.colours.empty()) out.put_colour(cloud.colours[i]);
    for (const PointCloud::Scalar& s : cloud.scalars) out.put(s.values[i]);
    out.end_row();
  }
  return std::move(out).take();
}

/// Writes a PLY file, whole or not at all.
template <class T>
void write_ply(const std::filesystem::path& path, const T& what, PlyFormat format = PlyFormat::Binary) {
  write_file(path, encode_ply(what, format));
}

}  // namespace vantage
