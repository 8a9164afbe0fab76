// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/projection.hpp>
#include <vantage/maps/surfel/tile_sweep.hpp>

// From what tiles have summed of each splat to derivatives by the surfels, sixteen surfels at once.
namespace vantage {

/// Sixteen sums of sixteen splats, each added up over its tiles in their order; lanes beyond n are 0.
inline std::array<Lanes<float>, 16> gather_sums(const TileBins& bins, std::span<const SplatSums> sums,
                                                std::size_t first, std::size_t n) {
  std::array<SplatSums, 16> total;
  for (std::size_t l = 0; l < 16; ++l) {
    total[l] = SplatSums(0);
    if (l >= n) continue;
    for (const std::uint32_t place : bins.places(static_cast<std::uint32_t>(first + l))) total[l] += sums[place];
  }
  std::array<Lanes<float>, 16> out;
  for (std::size_t j = 0; j < 16; ++j)
    out[j] = Lanes<float>::generate([&](std::size_t l) { return total[l].data()[j]; });
  return out;
}

/// By what is drawn of a splat, from the six sums of h, h dx, ... by log alpha.
template <class T>
SplatGradient<T> gradient_by_alpha(const Splat<T>& s, const std::array<T, 6>& h) {
  const T half = T(ScalarOf<T>(-0.5)), zero = T(0);
  return {{s.conic[0] * h[1] + s.conic[1] * h[2], s.conic[1] * h[1] + s.conic[2] * h[2]},
          {half * h[3], -h[4], half * h[5]},
          zero,
          {zero, zero},
          {zero, zero, zero},
          h[0]};
}

/// Adds to the gradient by surfels, and returns that by the pose. O(splats).
template <class Depth>
PoseGradient add_gradient(const Surfels& s, const RasterView& view, const VisibleSplats& splats, const TileBins& bins,
                          std::span<const SplatSums> sums, SurfelGradient& gradient,
                          std::vector<PoseGradient>& pose_of_chunk) {
  using L = Lanes<float>;
  const Projector<float> camera(view, s.scale);
  pose_of_chunk.assign(splats.chunks(), PoseGradient::Zero());
  parallel_for(splats.chunks(), [&](std::size_t c) {
    for (std::size_t i = 0; i < splats.count(c); i += 16) {
      const std::size_t n = std::min<std::size_t>(16, splats.count(c) - i), first = c * VisibleSplats::chunk + i;
      const std::uint32_t* index = splats.surfel.data() + first;
      const std::array<L, 16> v = gather_sums(bins, sums, first, n);
      if (std::ranges::all_of(v, [](const L& sum) { return bits(sum == L(0)) == 0xFFFF; })) continue;  // hidden
      const surfel::Parameters<L> in = gather_surfels(s, index, n);
      const Splat<L> splat = project<Depth>(camera, in);
      SplatGradient<L> g = gradient_by_alpha<L>(splat, {v[10], v[11], v[12], v[13], v[14], v[15]});
      g.z = v[by_depth];
      g.slope = {v[by_depth + 2], v[by_depth + 3]};
      for (std::size_t k = 0; k < 2; ++k) g.centre[k] -= v[by_depth + 1] * splat.slope[k];
      g.normal = {v[by_normal], v[by_normal + 1], v[by_normal + 2]};
      const SurfelChain<L> by = chain<Depth>(camera, in, splat, g);
      const std::array<L, surfel::parameters> out = {
          by.position[0],   by.position[1],   by.position[2],  by.quaternion[0], by.quaternion[1],
          by.quaternion[2], by.quaternion[3], by.log_scale[0], by.log_scale[1],  v[by_colour],
          v[by_colour + 1], v[by_colour + 2], by.logit};
      for (std::size_t p = 0; p < surfel::parameters; ++p) {
        const auto values = out[p].values();
        for (std::size_t l = 0; l < n; ++l) gradient.parameter[p][index[l]] += values[l];
      }
      for (std::size_t p = 0; p < 6; ++p) {
        const auto values = by.pose[p].values();
        for (std::size_t l = 0; l < n; ++l)
          pose_of_chunk[c][static_cast<Eigen::Index>(p)] += static_cast<double>(values[l]);
      }
    }
  });
  PoseGradient pose = PoseGradient::Zero();
  for (const PoseGradient& part : pose_of_chunk) pose += part;
  return pose;
}

/// Marks the surfels that a view shows as touched. O(touched), nothing if there are no new ones.
inline void mark_touched(const VisibleSplats& splats, SurfelGradient& gradient, std::vector<std::uint32_t>& scratch) {
  const auto before = static_cast<std::ptrdiff_t>(gradient.touched.size());
  for (std::size_t c = 0; c < splats.chunks(); ++c)
    for (std::size_t k = c * VisibleSplats::chunk; k < c * VisibleSplats::chunk + splats.count(c); ++k) {
      const std::uint32_t i = splats.surfel[k];
      if (gradient.is_touched[i] != 0) continue;
      gradient.is_touched[i] = 1;
      gradient.touched.push_back(i);
    }
  const auto middle = gradient.touched.begin() + before;
  if (before == 0 || middle == gradient.touched.end()) return;
  scratch.clear();
  std::merge(gradient.touched.begin(), middle, middle, gradient.touched.end(), std::back_inserter(scratch));
  gradient.touched.swap(scratch);
}

/// Adds the diagonal of the Fisher information, surfel-major: for each parameter the sum of (v . h)^2 over the pixels,
/// v the chain rule's row and h a pixel's six derivatives, from the sums of the products of any two of the six.
template <class Depth>
void add_fisher(const Surfels& s, const RasterView& view, const VisibleSplats& splats, const TileBins& bins,
                std::span<const SplatSums> sums, std::span<double> diagonal) {
  using L = Lanes<float>;
  const Projector<float> camera(view, s.scale);
  constexpr std::array<std::array<std::size_t, 2>, 6> power = {{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
  const auto place = [&](std::size_t a, std::size_t b) {
    const std::size_t y = power[a][1] + power[b][1], degree = power[a][0] + power[b][0] + y;
    return degree * (degree + 1) / 2 + y;
  };
  parallel_for(splats.chunks(), [&](std::size_t c) {
    for (std::size_t i = 0; i < splats.count(c); i += 16) {
      const std::size_t n = std::min<std::size_t>(16, splats.count(c) - i), first = c * VisibleSplats::chunk + i;
      const std::uint32_t* index = splats.surfel.data() + first;
      const surfel::Parameters<L> in = gather_surfels(s, index, n);
      const Splat<L> splat = project<Depth>(camera, in);
      const std::array<L, 16> v = gather_sums(bins, sums, first, n);
      std::array<std::array<L, 6>, 6> row;  // [parameter][which of the six]
      for (std::size_t k = 0; k < 6; ++k) {
        std::array<L, 6> h;
        for (std::size_t j = 0; j < 6; ++j) h[j] = L(j == k ? 1.0F : 0.0F);
        const SurfelChain<L> by = chain<Depth>(camera, in, splat, gradient_by_alpha<L>(splat, h));
        const std::array<L, 6> column = {by.position[0],  by.position[1],  by.position[2],
                                         by.log_scale[0], by.log_scale[1], by.logit};
        for (std::size_t p = 0; p < 6; ++p) row[p][k] = column[p];
      }
      constexpr std::array<std::size_t, 6> parameter = {surfel::x,           surfel::y,           surfel::z,
                                                        surfel::log_scale_x, surfel::log_scale_y, surfel::logit};
      const auto add = [&](std::size_t p, const L& value) {
        const auto values = value.values();
        for (std::size_t l = 0; l < n; ++l)
          diagonal[surfel::parameters * index[l] + p] += static_cast<double>(values[l]);
      };
      for (std::size_t p = 0; p < 6; ++p) {
        L sum = 0.0F;
        for (std::size_t a = 0; a < 6; ++a)
          for (std::size_t b = 0; b < 6; ++b) sum += row[p][a] * row[p][b] * v[place(a, b)];
        add(parameter[p], max(sum, L(0)));
      }
      for (std::size_t p = 0; p < 3; ++p) add(surfel::red + p, v[15]);
    }
  });
}

}  // namespace vantage
