// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/image.hpp>

namespace vantage {

/// What a map can draw. Channels are types, so that one march or one raster pass computes just those that were asked
/// for.
namespace channel {
struct Colour : ColourImage {};  ///< [0, 1]
struct Depth {
  Image<float> depth;
};  ///< camera z [m], NaN where nothing is hit
struct Opacity {
  Image<float> opacity;
};  ///< [0, 1]
struct Normal {
  Image<float> x, y, z;
};  ///< world frame, unit length
struct Confidence {
  Image<float> confidence;
};  ///< >= 0
struct Entropy {
  Image<float> entropy;
};  ///< [nats]
struct InformationGain {
  Image<float> information_gain;
};  ///< how much entropy of the map a measurement along the ray is expected to take away [nats]
/// Of which class the first surface is, if there is one (eq. 5.4): one image a class, by its number. In [0, 1], with
/// sum 1; class 0 = unknown also has the chance that there is none.
struct Semantics {
  std::vector<Image<float>> probability;
};
struct Labels {
  Image<std::uint16_t> labels;
};  ///< class of what is seen; 0 = unknown
struct Uncertainty {
  Image<float> uncertainty;
};  ///< finite, >= 0: the channel that every map has
}  // namespace channel

/// The channels asked for, each an image of the camera's size after `render`.
template <class... Channels>
struct Rendering : Channels... {};

}  // namespace vantage
