// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include <vantage/core/error.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// One measurement of a camera: what all 3-D maps learn from. Each image is of the camera's size, or empty where the
/// sensor lacks that channel.
struct Frame {
  Camera camera;
  View view;                    ///< from where it was taken
  ColourImage colour;           ///< [0, 1]
  Image<float> depth;           ///< camera z [m], > 0; NaN = no value (out of range, invalid)
  Image<std::uint16_t> labels;  ///< class of what is seen; 0 = unknown

  /// Throws Error if camera or pose are bad, an image is of another size, a colour is not in [0, 1], or a depth is
  /// neither > 0 and finite nor NaN. O(pixels).
  void validate(std::string_view where) const;
};

inline void Frame::validate(std::string_view where) const {
  camera.validate(where);
  check_view(view, where);
  const auto sized = [&](const auto& image, std::string_view name) {
    if (image.size() != 0 && (image.rows() != camera.height || image.cols() != camera.width))
      throw Error(where, concat(name, " of ", image.cols(), " x ", image.rows(), " px"),
                  concat("the camera's ", camera.width, " x ", camera.height, ", or none"));
  };
  sized(colour.r, "red");
  sized(colour.g, "green");
  sized(colour.b, "blue");
  sized(depth, "depth");
  sized(labels, "labels");
  if (colour.r.size() != colour.g.size() || colour.r.size() != colour.b.size())
    throw Error(where, "a colour plane is missing", "all of red, green and blue, or none");
  // Whether any is bad, without a branch, so that it is vectorised; where, only if one is. NaN fails a comparison.
  const auto each = [&](const Image<float>& image, std::string_view what, std::string_view expected, auto&& good) {
    int bad = 0;
    for (Eigen::Index k = 0; k < image.size(); ++k) bad |= good(image.data()[k]) ? 0 : 1;
    if (bad == 0) return;
    const float* const value = std::find_if_not(image.data(), image.data() + image.size(), good);
    const Eigen::Index k = value - image.data();
    throw Error(where, concat(what, " ", *value, " at row ", k / camera.width, ", column ", k % camera.width),
                expected);
  };
  for (const Image<float>* plane : {&colour.r, &colour.g, &colour.b})
    each(*plane, "colour", "in [0, 1]", [](float c) { return (c >= 0) & (c <= 1); });
  each(depth, "depth", "finite and > 0 m, or NaN = no value",
       [](float d) { return (d != d) | ((d > 0) & (d <= std::numeric_limits<float>::max())); });
}

/// The frame without the depth beyond `range_m` (camera z): a sensor that saw no farther. O(pixels).
inline Frame within(Frame frame, double range_m) {
  const auto most = static_cast<float>(range_m);
  frame.depth = (frame.depth <= most).select(frame.depth, std::numeric_limits<float>::quiet_NaN());
  return frame;
}

}  // namespace vantage
