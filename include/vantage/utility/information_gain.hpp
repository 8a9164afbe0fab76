// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/channels.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/utility/mean_of_channel.hpp>

namespace vantage {

/// How much of the map's entropy a measurement from a view is expected to take away, a ray:
///
///     psi(v) = mean over rays of E_z[H(map) - H(map | z)]
///
/// the expectation over where the ray ends, by the map's own belief and its own model of the sensor, which is what the
/// map renders (channel::InformationGain). Rays count as independent, as in Isler et al., "An information gain
/// formulation for active volumetric 3D reconstruction", ICRA 2016. In nats.
class InformationGain : public MeanOfChannel<channel::InformationGain, &channel::InformationGain::information_gain> {
 public:
  InformationGain() : MeanOfChannel(Camera::from_fov(128, 128, deg(60))) {}
  using MeanOfChannel::MeanOfChannel;
};

}  // namespace vantage
