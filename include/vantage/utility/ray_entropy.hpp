// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/channels.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/utility/mean_of_channel.hpp>

namespace vantage {

/// How uncertain the map is of what is where along the rays of a view (eq. 5.12, divided by the number of rays):
///
///     psi(v) = mean over rays of H_ray,    H_ray = sum over points of T H(o)
///
/// with o the probability that a point is occupied, H(o) its entropy and T the chance that the ray gets there
/// (eq. 5.10, 5.11); with voxels for points it is the occlusion-aware gain of Isler et al., ICRA 2016. The map renders
/// H_ray, in nats.
class RayEntropy : public MeanOfChannel<channel::Entropy, &channel::Entropy::entropy> {
 public:
  RayEntropy() : MeanOfChannel(Camera::from_fov(128, 128, deg(60))) {}
  using MeanOfChannel::MeanOfChannel;
};

}  // namespace vantage
