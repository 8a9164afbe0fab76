// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

#include <Eigen/Core>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/grid_ray.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/maps/voxel/class_counts.hpp>
#include <vantage/maps/voxel/occupancy_table.hpp>
#include <vantage/maps/voxel/ray_caster.hpp>

namespace vantage {

/// A VoxelOccupancy whose block(b) points to a block's log-odds and occupied voxels, or nowhere if nothing is known.
template <class M>
concept VoxelLogOdds = VoxelOccupancy<M> && requires(const M m, const Eigen::Vector3i& b, std::size_t local) {
  { m.block(b)->log_odds[local] } -> std::convertible_to<float>;
  { m.block(b)->occupied[local] } -> std::convertible_to<bool>;
};
/// How a map learns about a voxel: its log-odds after a hit or a pass, so far from the camera.
template <class S>
concept VoxelUpdate = requires(const S s, float log_odds, float distance_m) {
  { s.after_hit(log_odds, distance_m) } -> std::convertible_to<float>;
  { s.after_pass(log_odds, distance_m) } -> std::convertible_to<float>;
};

/// What a map keeps of classes, NoClasses or ClassCounts<n>: how many; if any, what they are in each voxel of a block
/// (the map's block(b)->classes), and a Mixture of those of several voxels.
template <class K>
concept VoxelSemantics = std::constructible_from<typename K::Mixture, const K&> &&
    (K::classes == 0 || requires(typename K::Mixture sum, const typename K::Block* block, std::size_t i) {
      sum.add(0.5F, block, i);
      { sum[i] } -> std::convertible_to<float>;
    });

/// What render_voxels draws of a map with such semantics.
template <VoxelSemantics K, class... Channels>
inline constexpr bool renders_voxels = sizeof...(Channels) > 0 &&
                                       ((std::same_as<Channels, channel::Depth> ||
                                         std::same_as<Channels, channel::Entropy> ||
                                         std::same_as<Channels, channel::Uncertainty> ||
                                         std::same_as<Channels, channel::InformationGain> ||
                                         (std::same_as<Channels, channel::Semantics> && K::classes > 0)) &&
                                        ...);

namespace detail {

/// What a pixel's ray has gathered. With p_i the probability that the i-th voxel on the ray is occupied, H_i its
/// entropy and T_i = (1 - p_1) ... (1 - p_(i-1)) the chance that the ray gets there:
///
///     entropy = sum_i T_i H_i,    reach = sum_i T_i
///     gain    = sum_i T_i ((1 - p_i) (H_i - H_i after a pass) + p_i (H_i - H_i after a hit))
struct RayInformation {
  float visibility = 1, reach = 0, entropy = 0, gain = 0;

  static constexpr float negligible = 1e-5F;  ///< visibility: what is behind adds less than 1e-4 nats

  /// Each returns the chance that the ray ends in the voxel, T_i p_i.
  float pass(const OccupancyTable& table, float log_odds) {
    const OccupancyTable::Voxel v = table(log_odds);
    const float ends = visibility * v.probability;
    entropy += visibility * v.entropy;
    reach += visibility;
    visibility *= 1 - v.probability;
    return ends;
  }
  template <VoxelUpdate S>
  float pass(const OccupancyTable& table, float log_odds, const S& sensor, float distance_m) {
    const OccupancyTable::Voxel v = table(log_odds);
    const float passed = table(sensor.after_pass(log_odds, distance_m)).entropy,
                hit = table(sensor.after_hit(log_odds, distance_m)).entropy;
    const float ends = visibility * v.probability;
    gain += visibility * ((1 - v.probability) * (v.entropy - passed) + v.probability * (v.entropy - hit));
    entropy += visibility * v.entropy;
    reach += visibility;
    visibility *= 1 - v.probability;
    return ends;
  }
};

/// f(row, column) for every pixel, in tiles, concurrently: rays of a tile meet the same blocks.
template <class F>
void for_each_pixel(const Camera& camera, F&& f) {
  constexpr int tile = 16;
  const int across = (camera.width + tile - 1) / tile, down = (camera.height + tile - 1) / tile;
  const int tiles = across * down;
  parallel_for(static_cast<std::size_t>(tiles), [&](std::size_t i) {
    const int top = static_cast<int>(i) / across * tile, left = static_cast<int>(i) % across * tile;
    for (int row = top; row < std::min(top + tile, camera.height); ++row)
      for (int column = left; column < std::min(left + tile, camera.width); ++column) f(row, column);
  });
}

}  // namespace detail

/// Draws a voxel map, by one march a ray, whatever the channels:
/// - Depth: camera z at which the ray enters the first occupied voxel; the smallest above 0 if it starts in one
/// - Entropy: along the ray [nats], as far as `range_m` (camera z): eq. 5.11, in the form for voxels of Isler et al.
///   ("An information gain formulation for active volumetric 3D reconstruction", ICRA 2016; occlusion aware); a ray
///   through nothing but unknown space has 2 ln 2. It grows with the way that is free, however well that is known
/// - Uncertainty: the mean entropy of the voxels that the ray can see, entropy / reach: ln 2 where nothing is known,
///   less wherever something is, 0 where there is no voxel
/// - InformationGain: how much of the entropy of the voxels a measurement along the ray is expected to take away
///   [nats], expected over where it ends, the first voxel that is occupied: hit there, passed before. The map's own
///   `sensor` says what a hit and a pass change; voxels that it is too sure of add less than 0 (cf. Palazzolo and
///   Stachniss, "Effective exploration for MAVs based on the expected information gain", Drones 2(1), 2018)
/// - Semantics, of a map with `classes`: of which class that voxel is (eq. 5.4), S_c = sum_i T_i p_i s_i(c), with s_i
///   the class probabilities of ClassCounts. Where nothing is met within `range_m` the class is unknown: that chance, T
///   behind the last voxel, is added to S_0. Voxels of which no class was seen count for all classes alike, so that the
///   likeliest class is one that was seen, or unknown
///
/// See detail::RayInformation for the sums. Throws Error unless view and camera are valid. Uses all threads; the same
/// bits with any number. O(pixels * voxels on a ray), with Semantics times their classes.
template <VoxelLogOdds M, VoxelUpdate S, VoxelSemantics K, class... Channels>
requires(renders_voxels<K, Channels...>) void render_voxels(const M& map, const S& sensor, const K& classes,
                                                            double range_m, const View& view, const Camera& camera,
                                                            Rendering<Channels...>& out) {
  constexpr auto asked = []<class C>(C*) { return (std::same_as<C, Channels> || ...); };
  constexpr bool depth = asked(static_cast<channel::Depth*>(nullptr)),
                 entropy = asked(static_cast<channel::Entropy*>(nullptr)),
                 uncertainty = asked(static_cast<channel::Uncertainty*>(nullptr)),
                 gain = asked(static_cast<channel::InformationGain*>(nullptr)),
                 semantics = asked(static_cast<channel::Semantics*>(nullptr));
  camera.validate();
  check_view(view, "render_voxels");
  if constexpr (depth) out.depth.resize(camera.height, camera.width);
  if constexpr (entropy) out.entropy.resize(camera.height, camera.width);
  if constexpr (uncertainty) out.uncertainty.resize(camera.height, camera.width);
  if constexpr (gain) out.information_gain.resize(camera.height, camera.width);
  if constexpr (semantics) {
    out.probability.resize(K::classes);
    for (Image<float>& of_class : out.probability) of_class.resize(camera.height, camera.width);
  }

  using Mixture = typename std::conditional_t<semantics, K, NoClasses>::Mixture;
  const OccupancyTable& table = OccupancyTable::shared();
  const RayCaster<M> caster(map);
  detail::for_each_pixel(camera, [&](int row, int column) {
    const Eigen::Vector3d from = view.position(), direction = view.T_W_C.linear() * camera.ray(column + 0.5, row + 0.5);
    GridRay ray(map.grid(), from, direction);
    std::optional<double> z;
    if constexpr (entropy || uncertainty || gain || semantics) {
      detail::RayInformation sum;
      [[maybe_unused]] Mixture mixture(classes);
      Eigen::Vector3i at = Eigen::Vector3i::Constant(-1);
      decltype(map.block(at)) block = nullptr;
      for (; ray && ray.enter() <= range_m && sum.visibility > sum.negligible; ray.step()) {
        if (ray.block() != at) block = map.block(at = ray.block());
        const float log_odds = block ? block->log_odds[ray.local()] : 0;
        if constexpr (depth)
          if (!z && block && block->occupied[ray.local()]) z = ray.enter();
        [[maybe_unused]] float ends = 0;
        if constexpr (gain)
          ends = sum.pass(table, log_odds, sensor, static_cast<float>((map.grid().centre(ray.voxel()) - from).norm()));
        else
          ends = sum.pass(table, log_odds);
        if constexpr (semantics) mixture.add(ends, block ? &block->classes : nullptr, ray.local());
      }
      if constexpr (entropy) out.entropy(row, column) = sum.entropy;
      if constexpr (uncertainty) out.uncertainty(row, column) = sum.reach > 0 ? sum.entropy / sum.reach : 0;
      if constexpr (gain) out.information_gain(row, column) = sum.gain;
      if constexpr (semantics)
        for (std::size_t c = 0; c < K::classes; ++c)
          out.probability[c](row, column) = std::min(1.0F, mixture[c] + (c == 0 ? sum.visibility : 0.0F));
    }
    if constexpr (depth) {
      if (!z)  // from where the march ended
        if (const auto hit = caster.first_occupied(ray)) z = hit->t;
      out.depth(row, column) = z ? std::max(static_cast<float>(*z), std::numeric_limits<float>::min())
                                 : std::numeric_limits<float>::quiet_NaN();
    }
  });
}

}  // namespace vantage
