// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <vantage/concepts/channels.hpp>
#include <vantage/maps/surfel/raster_images.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>

namespace vantage {

/// What render_surfels draws.
template <class... Channels>
inline constexpr bool renders_surfels =
    sizeof...(Channels) > 0 &&
    ((std::same_as<Channels, channel::Colour> || std::same_as<Channels, channel::Depth> ||
      std::same_as<Channels, channel::Opacity> || std::same_as<Channels, channel::Normal> ||
      std::same_as<Channels, channel::Confidence> || std::same_as<Channels, channel::Uncertainty>)&&...);

namespace detail {

// The channels to rasterise for some: each once, Confidence for Uncertainty.
template <class Done, class... Left>
struct Rasterised {
  using type = Done;
};
template <class... Done, class C, class... Left>
struct Rasterised<Rendering<Done...>, C, Left...> {
  using Needed = std::conditional_t<std::same_as<C, channel::Uncertainty>, channel::Confidence, C>;
  using Next = std::conditional_t<(std::same_as<Needed, Done> || ...), Rendering<Done...>, Rendering<Done..., Needed>>;
  using type = typename Rasterised<Next, Left...>::type;
};

// From what a rasteriser draws to what the channels mean.
template <class R>
void finish_images(R& r, const View& view) {
  if constexpr (draws<channel::Colour, R>)
    for (Image<float>* plane : {&r.r, &r.g, &r.b}) *plane = plane->max(0.0F).min(1.0F);
  if constexpr (draws<channel::Depth, R>)  // the plane of a surfel may lie behind the camera at its rim
    for (Eigen::Index k = 0; k < r.depth.size(); ++k)
      if (float& d = r.depth.data()[k]; !(d > 0)) d = std::numeric_limits<float>::quiet_NaN();
  if constexpr (draws<channel::Normal, R>) {
    channel::Normal& n = r;
    const Eigen::Matrix3f R_W_C = view.T_W_C.linear().cast<float>();
    for (Eigen::Index k = 0; k < n.x.size(); ++k) {
      const Eigen::Vector3f v(n.x.data()[k], n.y.data()[k], n.z.data()[k]);
      const float length = v.norm();
      const Eigen::Vector3f world = length > 1e-6F ? (R_W_C * v / length).eval() : Eigen::Vector3f::Zero().eval();
      n.x.data()[k] = world.x(), n.y.data()[k] = world.y(), n.z.data()[k] = world.z();
    }
  }
  if constexpr (draws<channel::Confidence, R>) r.confidence = r.confidence.max(0.0F);
}

}  // namespace detail

/// Draws surfels: Colour (clamped to [0, 1]), Depth (NaN where nothing is), Opacity, Normal (world frame, 0 where
/// nothing is), Confidence (sum w k, at least 0: not divided by the opacity) and Uncertainty = 1 - Confidence clamped
/// to [0, 1], so that what was never seen has 1. Throws Error unless view and camera are valid.
template <SurfelRasteriser Rasteriser, class... Channels>
requires(renders_surfels<Channels...>) void render_surfels(const Surfels& surfels, const Rasteriser& rasteriser,
                                                           typename Rasteriser::Pass& pass, const View& view,
                                                           const Camera& camera, Rendering<Channels...>& out) {
  using Drawn = typename detail::Rasterised<Rendering<>, Channels...>::type;
  const RasterView from{.view = view, .camera = camera};
  if constexpr (std::same_as<Drawn, Rendering<Channels...>>) {
    rasteriser.forward(surfels, from, pass, out);
    detail::finish_images(out, view);
  } else {
    Drawn drawn;
    rasteriser.forward(surfels, from, pass, drawn);
    detail::finish_images(drawn, view);
    const auto hand_over = [&]<class C>(C& to) {
      if constexpr (std::same_as<C, channel::Uncertainty>)
        to.uncertainty = 1 - drawn.confidence.min(1.0F);
      else if constexpr (!std::same_as<C, channel::Confidence>)
        to = std::move(static_cast<C&>(drawn));
    };
    (hand_over(static_cast<Channels&>(out)), ...);
    if constexpr (draws<channel::Confidence, Rendering<Channels...>>) out.confidence = std::move(drawn.confidence);
  }
}

}  // namespace vantage
