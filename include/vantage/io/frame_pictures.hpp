// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include <vantage/core/error.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/read_picture.hpp>

// The channels of a Frame from picture files. Each reader throws Error, naming the file, if it cannot be read, holds
// another kind of picture, or is not of the camera's size.
namespace vantage {

namespace detail {

inline void check_size(const std::filesystem::path& path, Eigen::Index width, Eigen::Index height,
                       const Camera& camera) {
  if (width != camera.width || height != camera.height)
    throw Error(path.string(), concat("a picture of ", width, " x ", height, " px"),
                concat("the camera's ", camera.width, " x ", camera.height));
}

}  // namespace detail

/// Width and height of a picture [px].
inline std::pair<int, int> picture_size(const std::filesystem::path& path) {
  const Picture picture = read_picture(path);
  return {picture.width(), picture.height()};
}

/// Colours in [0, 1]; a grey picture becomes a grey colour image.
inline ColourImage read_colour(const std::filesystem::path& path, const Camera& camera) {
  const Picture picture = read_picture(path);
  detail::check_size(path, picture.width(), picture.height(), camera);
  return to_colour(picture);
}

/// Depth [m] of a 16-bit grey picture in steps of `unit_m`; 0 is no value, NaN. A picture of 8 bits is refused: it
/// shows depth, and does not hold it.
inline Image<float> read_depth(const std::filesystem::path& path, const Camera& camera, double unit_m) {
  const PictureLimits limits;
  const RawPicture raw = decode_raw_picture(read_file(path, limits.bytes), path.string(), limits);
  if (raw.channels != 1 || raw.maximum <= 255)
    throw Error(path.string(), concat(raw.channels, " channels of values up to ", raw.maximum), "depth: 16-bit grey");
  detail::check_size(path, raw.width, raw.height, camera);
  return depth_from_steps(Eigen::Map<const Image<std::uint16_t>>(raw.values.data(), raw.height, raw.width), unit_m);
}

/// Class numbers of an 8- or 16-bit grey picture.
inline Image<std::uint16_t> read_labels(const std::filesystem::path& path, const Camera& camera) {
  Image<std::uint16_t> labels = read_grey_16(path);
  detail::check_size(path, labels.cols(), labels.rows(), camera);
  return labels;
}

}  // namespace vantage
