// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// RRT* for a box of 1 m x 0.4 m x 0.4 m through four rooms of an apartment half known, whose doors it fits through
// lengthwise only: 2000 draws, upright at one height and with all rotations.
#include <cstdint>

#include "peak.hpp"

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/planning/box_in_voxels.hpp>
#include <vantage/planning/rrt_star.hpp>
#include "kernels/apartment_input.hpp"

namespace {

using namespace vantage;

// One thread; items are draws.
template <class Space>
void rrt_star(benchmark::State& state, double voxel_m, const Space& space) {
  constexpr int samples = 2000;
  const bench::Apartment map(voxel_m);
  const BoxInVoxels body(map, shape::Box{{0.5, 0.2, 0.2}});
  const auto diagonal = [](double x, double y) {
    Eigen::Isometry3d pose(Eigen::Translation3d(x, y, 1));
    pose.rotate(Eigen::AngleAxisd(deg(45), Eigen::Vector3d::UnitZ()));
    return pose;
  };
  const RrtStar<Space> planner({.space = space, .samples = samples});
  const auto plan = [&](std::uint64_t seed) {
    return planner.plan(diagonal(1.4, 1.5), diagonal(4.4, 4.8), body, Rng(seed));
  };
  if (!plan(0)) state.SkipWithError("no path");
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(plan(seed++));
  state.SetItemsProcessed(state.iterations() * samples);
}

const Box3 level(Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(6, 6.7, 1)),
    space(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 6.7, 2.5));

#define VANTAGE_RRT_STAR(name, voxel_m, poses) \
  BENCHMARK_CAPTURE(rrt_star, name, voxel_m, poses)->Name(name)->Unit(benchmark::kMillisecond)

VANTAGE_RRT_STAR("planning/rrt_star/upright_20cm", 0.2, UprightPoses{.bounds = level});
VANTAGE_RRT_STAR("planning/rrt_star/upright_5cm", 0.05, UprightPoses{.bounds = level});
VANTAGE_RRT_STAR("planning/rrt_star/free_20cm", 0.2, FreePoses{.bounds = space});

}  // namespace

BENCHMARK_MAIN();
