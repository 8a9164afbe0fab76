// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

// What a map must offer; the comments say what it must mean, and the contract tests check the meaning.
namespace vantage {

/// Learns from measurements. `integrate` checks the measurement before it changes anything (a refused one throws Error
/// and leaves the map as it was), then folds it in, training included. Const members may run concurrently.
template <class M>
concept Map = std::movable<M> && requires(M m, const M c, const typename M::Measurement& z, Rng& rng) {
  m.integrate(z, rng);
  { c.bounds() } -> std::convertible_to<Box3>;  // world frame [m]
};

/// Draws the given channels from a view.
template <class M, class... Channels>
concept Renders = Map<M> && requires(const M m, const View& view, const Camera& camera, Rendering<Channels...>& out) {
  m.render(view, camera, out);
};

/// The capability that all maps share, by which they are interchangeable: finite and >= 0 in every pixel.
template <class M>
concept UncertainMap = Renders<M, channel::Uncertainty>;
template <class M>
concept DepthMap = Renders<M, channel::Depth>;

/// Reduction of variance in the region of interest by each of `views` alone, were the views `given` measured before
/// (eq. 3.13). The values that would be measured are not needed. Writes views.size() finite numbers >= 0.
template <class M>
concept ForecastMap = Map<M> && requires(const M m, Views given, Views views, std::span<double> reduction) {
  m.forecast(given, views, reduction);
};

/// A field as Gaussian beliefs about cells: their boxes on the ground [m], means and variances in the field's unit.
template <class M>
concept FieldMap = Map<M> && requires(const M m, std::size_t i, const Eigen::Vector2d& p) {
  { m.size() } -> std::convertible_to<std::size_t>;
  { m.cell(i) } -> std::convertible_to<Box2>;
  { m.mean(i) } -> std::convertible_to<double>;
  { m.variance(i) } -> std::convertible_to<double>;
  { m.cell_at(p) } -> std::convertible_to<std::size_t>;  // the cell that holds p; throws Error outside
};

/// Share of the map that at least one measurement saw, in [0, 1].
template <class M>
concept CoverageMap = Map<M> && requires(const M m) {
  { m.coverage() } -> std::convertible_to<double>;
};

enum class Space : std::uint8_t { unknown, free, occupied };

template <class M>
concept OccupancyMap = Map<M> && requires(const M m, const Eigen::Vector3d& p) {
  { m.at(p) } -> std::same_as<Space>;
};

/// An OccupancyMap that knows about whole voxels of a grid. What it knows lies in blocks (geometry/voxel_bits.hpp):
/// known_blocks() lists those that hold anything, in an order that the measurements alone determine; every other block
/// is unexplored. Explored is what a measurement hit or passed, were it too little to call it free or occupied. Bits
/// beyond the grid are 0 in every mask; a block may be any inside of the grid's.
template <class M>
concept VoxelOccupancy = OccupancyMap<M> &&
    requires(const M m, const Eigen::Vector3i& voxel, const Eigen::Vector3i& block) {
  { m.grid() } -> std::convertible_to<const VoxelGrid&>;
  { m.state(voxel) } -> std::same_as<Space>;  // of a voxel of the grid
  { m.known_blocks() } -> std::convertible_to<std::span<const Eigen::Vector3i>>;
  { m.free_in(block) } -> std::convertible_to<VoxelBits>;
  { m.occupied_in(block) } -> std::convertible_to<VoxelBits>;
  { m.unexplored_in(block) } -> std::convertible_to<VoxelBits>;
};

/// VoxelOccupancy that also keeps where a robot's body fits: a voxel is navigable if all space within clearance_m() of
/// its centre is free (how this is counted is the map's to state), so that a search needs one bit a voxel.
template <class M>
concept NavigableMap = VoxelOccupancy<M> &&
    requires(const M m, const Eigen::Vector3i& voxel, const Eigen::Vector3i& block) {
  { m.clearance_m() } -> std::convertible_to<double>;
  { m.navigable(voxel) } -> std::same_as<bool>;  // any voxel: false outside of the grid
  { m.navigable_in(block) } -> std::convertible_to<VoxelBits>;
};

/// Something worth looking at, and the side from which: world frame [m], unit normal.
struct Region {
  Eigen::Vector3d centre, normal;
};
struct frontier {};
struct low_confidence {};

template <class M, class Kind>
concept RegionMap = OccupancyMap<M> && requires(const M m, Kind kind) {
  { m.regions(kind) } -> std::same_as<std::vector<Region>>;
};

/// Diagonal Fisher information of the map's parameters in a rendering, added to `diagonal` (m.parameters() numbers).
template <class M>
concept FisherMap = Map<M> && requires(const M m, const View& view, const Camera& camera, std::span<double> diagonal) {
  { m.parameters() } -> std::convertible_to<std::size_t>;
  m.fisher(view, camera, diagonal);
};

/// Trains while the robot moves.
template <class M>
concept RefinableMap = Map<M> && requires(M m, int steps, Rng& rng) {
  m.refine(steps, rng);
};

}  // namespace vantage
