// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/ply.hpp>
#include <vantage/io/write_ply.hpp>
#include <vantage/maps/surfel/surfel_normal.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

namespace detail {

/// A surfel with its scales as logarithms of metres, capped, so that a file needs no SurfelScale beside it.
inline Surfel in_metres(const Surfels& surfels, std::size_t i) {
  Surfel s = surfels[i];
  const float unit = std::log(surfels.scale.unit_m), most = std::log(surfels.scale.max_m);
  for (const std::size_t p : {surfel::log_scale_x, surfel::log_scale_y})
    s.parameter[p] = std::min(s.parameter[p] + unit, most);
  return s;
}
inline float quaternion_length(const Surfel& s) {
  const auto& p = s.parameter;
  return std::sqrt(p[surfel::qw] * p[surfel::qw] + p[surfel::qx] * p[surfel::qx] + p[surfel::qy] * p[surfel::qy] +
                   p[surfel::qz] * p[surfel::qz]);
}
/// Those that can be drawn: all numbers finite, and a rotation.
inline std::vector<Surfel> proper_surfels(const Surfels& surfels) {
  std::vector<Surfel> proper;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Surfel s = in_metres(surfels, i);
    const float length = quaternion_length(s);
    if (std::all_of(s.parameter.begin(), s.parameter.end(), [](float x) { return std::isfinite(x); }) &&
        std::isfinite(s.confidence) && std::isfinite(length) && length > 0)
      proper.push_back(s);
  }
  return proper;
}

/// Columns of a PLY file by name. Throws Error for one that is missing or holds a number that is not finite.
class PlyColumns {
 public:
  PlyColumns(const PointCloud& cloud, const std::string& where) : cloud_(cloud), where_(where) {}
  [[nodiscard]] const std::vector<float>& operator()(std::string_view name) const {
    for (const PointCloud::Scalar& s : cloud_.scalars) {
      if (s.name != name) continue;
      for (std::size_t i = 0; i < s.values.size(); ++i)
        if (!std::isfinite(s.values[i]))
          throw Error(where_, concat("vertex ", i, " has ", name, " ", s.values[i]), "finite");
      return s.values;
    }
    throw Error(where_, concat("no property '", name, "'"), "all properties of a surfel");
  }

 private:
  const PointCloud& cloud_;
  const std::string& where_;
};

/// Surfels whose columns are named so; scales are logarithms of metres.
inline Surfels surfels_of(const PointCloud& cloud, const std::string& where,
                          const std::array<std::string_view, surfel::parameters - 3>& names) {
  const PlyColumns column(cloud, where);
  Surfels s;
  s.scale = {.unit_m = 1, .max_m = std::numeric_limits<float>::infinity()};
  for (std::size_t p = 0; p < 3; ++p) {
    s.parameter[p].resize(cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      s.parameter[p][i] = cloud.points[i][static_cast<Eigen::Index>(p)];
  }
  for (std::size_t p = 3; p < surfel::parameters; ++p) s.parameter[p] = column(names[p - 3]);
  s.confidence.resize(cloud.points.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    if (const float length = quaternion_length(s[i]); !(length > 0) || !std::isfinite(length))
      throw Error(where, concat("vertex ", i, " has a quaternion of length ", length), "finite and > 0");
  return s;
}

}  // namespace detail

/// Degree 0 of the real spherical harmonics: colour = 0.5 + this * f_dc.
inline constexpr float splat_colour_unit = 0.28209479177387814F;
/// The thickness of a surfel where a Gaussian has three scales.
inline constexpr float splat_thickness_m = 1e-6F;

/// Surfels as the .ply that viewers of Gaussian splatting read, to the last property: x y z nx ny nz f_dc_0..2
/// f_rest_0..44 opacity scale_0..2 rot_0..3, all float, little-endian; opacities as logits, scales as logarithms of
/// metres (the third that of splat_thickness_m), unit quaternions (w, x, y, z), colour as spherical harmonics of degree
/// 0. The confidence has no place in it. Surfels with a number that is not finite, be it only as the file has it, or
/// without a rotation are left out: no rasteriser draws them, and viewers break on them.
inline std::string encode_splat_ply(const Surfels& surfels) {
  const auto harmonic = [](float colour) { return (colour - 0.5F) / splat_colour_unit; };
  std::vector<Surfel> proper = detail::proper_surfels(surfels);
  std::erase_if(proper, [&](const Surfel& s) {  // near the largest float a harmonic overflows
    const auto& p = s.parameter;
    return !std::isfinite(harmonic(p[surfel::red])) || !std::isfinite(harmonic(p[surfel::green])) ||
           !std::isfinite(harmonic(p[surfel::blue]));
  });
  detail::PlyWriter out(PlyFormat::Binary);
  out.element("vertex", proper.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out.property("float", name);
  for (int k = 0; k < 3; ++k) out.property("float", concat("f_dc_", k));
  for (int k = 0; k < 45; ++k) out.property("float", concat("f_rest_", k));
  out.property("float", "opacity");
  for (int k = 0; k < 3; ++k) out.property("float", concat("scale_", k));
  for (int k = 0; k < 4; ++k) out.property("float", concat("rot_", k));
  out.end_header();
  for (const Surfel& s : proper) {
    const auto& p = s.parameter;
    const float length = detail::quaternion_length(s);
    const std::array<float, 4> q = {p[surfel::qw] / length, p[surfel::qx] / length, p[surfel::qy] / length,
                                    p[surfel::qz] / length};
    for (const std::size_t k : {surfel::x, surfel::y, surfel::z}) out.put(p[k]);
    out.put(normal_of(q[0], q[1], q[2], q[3]));
    for (const std::size_t k : {surfel::red, surfel::green, surfel::blue}) out.put(harmonic(p[k]));
    for (int k = 0; k < 45; ++k) out.put(0.0F);
    out.put(p[surfel::logit]);
    out.put(p[surfel::log_scale_x]);
    out.put(p[surfel::log_scale_y]);
    out.put(std::log(splat_thickness_m));
    for (const float x : q) out.put(x);
  }
  return std::move(out).take();
}

/// Reads what encode_splat_ply writes, and other Gaussians as surfels: the third axis is taken for the normal, and of
/// the colour what does not depend on the direction. Confidence 0; SurfelScale of metres, without a cap. Throws Error
/// if a property is missing, something is not finite, or the file is damaged.
inline Surfels decode_splat_ply(std::string_view bytes, const std::string& where, const PlyLimits& limits = {}) {
  const PointCloud cloud = decode_ply_points(bytes, where, limits);
  Surfels s = detail::surfels_of(
      cloud, where,
      {"rot_0", "rot_1", "rot_2", "rot_3", "scale_0", "scale_1", "f_dc_0", "f_dc_1", "f_dc_2", "opacity"});
  for (const std::size_t p : {surfel::red, surfel::green, surfel::blue})
    for (float& c : s.parameter[p]) c = 0.5F + splat_colour_unit * c;
  return s;
}

/// Surfels as a compact .ply of our own: x y z, the quaternion as it is trained, log_scale_x and log_scale_y (of
/// metres, capped), colour_r, colour_g, colour_b, logit (of the opacity), confidence. Leaves out what encode_splat_ply
/// does.
inline std::string encode_surfel_ply(const Surfels& surfels) {
  const std::vector<Surfel> proper = detail::proper_surfels(surfels);
  detail::PlyWriter out(PlyFormat::Binary);
  out.element("vertex", proper.size());
  for (const char* name : {"x", "y", "z", "qw", "qx", "qy", "qz", "log_scale_x", "log_scale_y", "colour_r", "colour_g",
                           "colour_b", "logit", "confidence"})
    out.property("float", name);
  out.end_header();
  for (const Surfel& s : proper) {
    for (const float x : s.parameter) out.put(x);
    out.put(s.confidence);
  }
  return std::move(out).take();
}

/// Reads what encode_surfel_ply writes, to the bit; SurfelScale of metres, without a cap. Throws as decode_splat_ply.
inline Surfels decode_surfel_ply(std::string_view bytes, const std::string& where, const PlyLimits& limits = {}) {
  const PointCloud cloud = decode_ply_points(bytes, where, limits);
  Surfels s = detail::surfels_of(
      cloud, where,
      {"qw", "qx", "qy", "qz", "log_scale_x", "log_scale_y", "colour_r", "colour_g", "colour_b", "logit"});
  s.confidence = detail::PlyColumns(cloud, where)("confidence");
  return s;
}

inline void write_splat_ply(const std::filesystem::path& path, const Surfels& surfels) {
  write_file(path, encode_splat_ply(surfels));
}
inline Surfels read_splat_ply(const std::filesystem::path& path, const PlyLimits& limits = {}) {
  return decode_splat_ply(read_file(path, limits.bytes), path.string(), limits);
}
inline void write_surfel_ply(const std::filesystem::path& path, const Surfels& surfels) {
  write_file(path, encode_surfel_ply(surfels));
}
inline Surfels read_surfel_ply(const std::filesystem::path& path, const PlyLimits& limits = {}) {
  return decode_surfel_ply(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
