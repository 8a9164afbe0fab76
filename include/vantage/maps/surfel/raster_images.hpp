// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string_view>
#include <type_traits>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>

namespace vantage {

template <class Channel, class R>
inline constexpr bool draws = std::is_base_of_v<Channel, R>;

/// f(image) for every image of a rendering that rasterisers draw.
template <class R, class F>
void for_images(R& r, F&& f) {
  if constexpr (draws<channel::Colour, R>) {
    channel::Colour& c = r;
    f(c.r), f(c.g), f(c.b);
  }
  if constexpr (draws<channel::Depth, R>) f(r.depth);
  if constexpr (draws<channel::Normal, R>) {
    channel::Normal& n = r;
    f(n.x), f(n.y), f(n.z);
  }
  if constexpr (draws<channel::Opacity, R>) f(r.opacity);
  if constexpr (draws<channel::Confidence, R>) f(r.confidence);
}

/// Throws Error for surfels of unequal lengths or a view that is none.
inline void check_raster_input(const Surfels& s, const RasterView& view, std::string_view where) {
  for (const auto& values : s.parameter)
    if (values.size() != s.size())
      throw Error(where, concat("a parameter has ", values.size(), " values for ", s.size(), " surfels"), "one each");
  Check check(where);
  check.positive("scale.unit_m", s.scale.unit_m);
  check(s.scale.max_m > 0, "scale.max_m", s.scale.max_m, "> 0");
  check.done();
  check_view(view.view, where);
  view.camera.validate();
}

/// Throws Error unless an image is empty or of the camera's size.
inline void check_image_size(const Image<float>& image, const Camera& camera, std::string_view where,
                             std::string_view name) {
  if (image.size() != 0 && (image.rows() != camera.height || image.cols() != camera.width))
    throw Error(where, concat(name, " is ", image.cols(), " x ", image.rows(), " px"),
                concat(camera.width, " x ", camera.height));
}
inline void check_length(std::size_t found, std::size_t expected, std::string_view where, std::string_view name) {
  if (found != expected) throw Error(where, concat(name, " has ", found, " values"), concat(expected));
}
inline void check_gradient_sizes(const ImageGradient& d, const Camera& camera, std::string_view where) {
  check_image_size(d.colour.r, camera, where, "the gradient by red");
  check_image_size(d.colour.g, camera, where, "the gradient by green");
  check_image_size(d.colour.b, camera, where, "the gradient by blue");
  check_image_size(d.depth, camera, where, "the gradient by depth");
  check_image_size(d.opacity, camera, where, "the gradient by opacity");
  check_image_size(d.normal_x, camera, where, "the gradient by normal x");
  check_image_size(d.normal_y, camera, where, "the gradient by normal y");
  check_image_size(d.normal_z, camera, where, "the gradient by normal z");
}

}  // namespace vantage
