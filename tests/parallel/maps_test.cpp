// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include <tbb/task_arena.h>

#include <vantage/core/bytes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/maps/voxel/voxel_presets.hpp>

#include "voxel_scenes.hpp"

// Maps of space and surfaces, for ThreadSanitizer to watch: they learn on all threads, and answer several at once.
namespace vantage::test {
namespace {

using Bytes = std::vector<std::byte>;

template <class Config>
Config in_small_room(Config c) {
  c.bounds = small_room;
  c.voxel_m = 0.1;
  c.clearance_m = 0.15;
  return c;
}
template <class M>
M empty() {
  return M(in_small_room(typename M::Config{}));
}
template <SurfelConfidence Confidence>
auto empty_surfels() {
  using M = ActiveGsMap<preset::reference, Confidence>;
  auto c = surfel_config<M>(small_room);
  c.voxels = in_small_room(c.voxels);
  c.iterations = 2;
  c.batch = {.newest = 1, .earlier = 1};
  c.prune.every_frames = 2;
  return M(c);
}

// What a planner asks.
template <class M>
Bytes answers(const M& map) {
  const View view = random_frame(Rng(9)).view;
  const Camera camera = Camera::from_fov(32, 32, deg(70));
  Rendering<channel::Depth, channel::Uncertainty> image;
  map.render(view, camera, image);
  Sink answer;
  answer.put(image.depth);
  answer.put(image.uncertainty);
  if constexpr (Renders<M, channel::Semantics>) {
    Rendering<channel::Semantics> classes;
    map.render(view, camera, classes);
    for (const Image<float>& of_class : classes.probability) answer.put(of_class);
  }
  if constexpr (FisherMap<M>) {
    std::vector<double> fisher(map.parameters());
    map.fisher(view, camera, fisher);
    answer.put(fisher);
    answer.put(map.regions(low_confidence{}).size());
  } else {
    answer.put(map.counts().navigable);
  }
  answer.put(map.regions(frontier{}).size());
  for (const Eigen::Vector3i& block : map.known_blocks()) {
    answer.put(map.state(block * block_edge));
    answer.put(map.unexplored_in(block).count());
  }
  return std::move(answer).take();
}

// What it is after some frames.
template <class M>
Bytes learned(int threads, M map) {
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    for (std::uint64_t k = 0; k < 2; ++k) {
      Rng rng(k);
      map.integrate(random_frame(Rng(11).fork(k), 40), rng);
    }
    const Bytes alone = answers(map);
    std::array<Bytes, 3> told;
    std::vector<std::thread> asking;
    for (Bytes& to : told) asking.emplace_back([&map, &to] { to = answers(map); });
    for (std::thread& t : asking) t.join();
    for (const Bytes& t : told) EXPECT_TRUE(t == alone);
    Sink sink;
    map.save(sink);
    return std::move(sink).take();
  });
}
template <class M>
void expect_same(const M& map) {
  const Bytes one = learned(1, map);
  EXPECT_GT(one.size(), 10'000U);
  EXPECT_TRUE(learned(4, map) == one);
}

TEST(Parallel, VoxelsByRays) { expect_same(empty<PresetVoxelMap<preset::thesis>>()); }
TEST(Parallel, VoxelsByProjection) { expect_same(empty<PresetVoxelMap<preset::reference>>()); }
TEST(Parallel, VoxelsWithClasses) { expect_same(empty<SemanticVoxelMap<5>>()); }
TEST(Parallel, Surfels) { expect_same(empty_surfels<IncrementalConfidence>()); }

}  // namespace
}  // namespace vantage::test
