// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <concepts>
#include <span>

#include <vantage/concepts/channels.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// From where, and onto what, surfels are drawn.
struct RasterView {
  View view;
  Camera camera;
  std::array<float, 3> background = {0, 0, 0};
  bool front_only = false;  ///< surfels seen from behind are left out
};

/// Derivatives of a loss by the images of a rendering. Empty = all 0.
struct ImageGradient {
  ColourImage colour;
  Image<float> depth, opacity;
  Image<float> normal_x, normal_y, normal_z;
};

/// By the pose: of a small motion of the camera in its own frame, T_W_C exp(xi), translation first [1/m, 1/rad].
using PoseGradient = Eigen::Matrix<double, 6, 1>;

/// Draws surfels from near to far (eqs. 6.2, 6.3), and says how a loss of the images depends on them. Channels, none of
/// them normalised further: Colour with its background, Depth = sum w z / sum w (NaN where the opacity is under 1e-6),
/// Normal = sum w n in the camera frame, Opacity = 1 - T, Confidence = sum w k. A Pass keeps what backward needs of a
/// forward; kept and used again, it costs no allocation. Const members may run concurrently, each with a Pass of its
/// own.
template <class R>
concept SurfelRasteriser = std::default_initializable<typename R::Pass> &&
    requires(const R r, const Surfels& s, const RasterView& v, typename R::Pass& pass,
             Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Opacity>& all,
             Rendering<channel::Depth, channel::Confidence, channel::Opacity>& planning, const ImageGradient& d,
             SurfelGradient& gradient, PoseGradient& pose, const Image<float>& measured, std::span<float> weight,
             std::span<double> diagonal) {
  r.forward(s, v, pass, all);  // any channels
  r.forward(s, v, pass, planning);
  r.backward(s, v, pass, d, gradient);         // adds, exactly (discrete decisions held), after forward of the same
  r.backward(s, v, pass, d, gradient, pose);   // and by the pose
  r.visibility(s, v, pass, measured, weight);  // raises weight[i] to surfel i's largest w at a pixel with measured > 0
  r.fisher(s, v, pass, diagonal);              // adds sum over pixels (sum over channels dC / dtheta)^2, surfel-major
};

}  // namespace vantage
