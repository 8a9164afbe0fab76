// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/utility/mean_of_channel.hpp>

namespace vantage {

/// How uncertain the map is of what it would see, averaged over the image (eq. 4.3):
///
///     psi(v) = mean over pixels of U_v
///
/// Works with every map: rendering uncertainty is what they all share. In the unit of the map's uncertainty.
class MeanUncertainty : public MeanOfChannel<channel::Uncertainty, &channel::Uncertainty::uncertainty> {
 public:
  using MapNeeds = Needs<need::Uncertainty>;

  MeanUncertainty() : MeanOfChannel(Camera::from_fov(60, 60, deg(60))) {}
  using MeanOfChannel::MeanOfChannel;
};

}  // namespace vantage
