// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Rays into a voxel map of a room of 6 x 5 x 2.5 m seen from eight places, for the first occupied voxel; whole images
// of depth, entropy, expected information gain and 8 classes; and the unexplored voxels and the unseen sides seen from
// 100 candidates. Items are rays, or candidates. voxel/raycast runs on one thread, as OctoMap 1.9.7's castRay does, if
// it is there, on the same map (by way of a .bt file) and the same rays in the same run; octomap_ratio = its time /
// ours, measured in turn. All else uses all threads.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "kernels/room_input.hpp"
#include "peak.hpp"

#include <vantage/io/octomap_bt.hpp>
#include <vantage/maps/voxel/voxel_presets.hpp>
#include <vantage/maps/voxel/with_sides.hpp>
#include <vantage/utility/unexplored.hpp>
#include <vantage/utility/unseen_sides.hpp>
#ifdef VANTAGE_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

namespace {

using namespace vantage;

/// A random view from inside of the room.
View some_view(Rng& rng) {
  const Eigen::Vector3d eye(rng.uniform(-2.7, 0.4), rng.uniform(-2.2, 2.2), rng.uniform(0.8, 1.8));
  const double heading = rng.uniform(0, 2 * std::numbers::pi);
  return look_at(eye, eye + Eigen::Vector3d(std::cos(heading), std::sin(heading), rng.uniform(-0.4, 0.2)));
}
/// `around`: what the map reaches beyond the room.
template <class M = VoxelMap<>>
M room_map(double voxel_m, const Eigen::Vector3d& around = Eigen::Vector3d::Constant(0.2), int frames = 8) {
  const Box3 walls = bench::Room().walls;
  typename M::Config config;
  config.bounds = Box3(walls.min() - around, walls.max() + around);
  config.voxel_m = voxel_m;
  M map(config);
  Rng rng(1);
  for (int i = 0; i < frames; ++i) {
    Frame frame = bench::room_frame(256, some_view(rng));
    frame.labels = (1 + 6.99F * frame.colour.r).cast<std::uint16_t>();  // 1 to 7, along x
    map.integrate(frame);
  }
  return map;
}

void raycast(benchmark::State& state, double voxel_m) {
  const VoxelMap<> map = room_map(voxel_m);
  const RayCaster caster(map);
  const Eigen::Vector3d eye(-1, 0.3, 1.3);
  Rng rng(2);
  std::vector<Eigen::Vector3d> rays(1 << 14);
  for (Eigen::Vector3d& r : rays) r = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
  constexpr double most_m = 10;
  std::uint64_t hits = 0;
  const auto cast = [&] {
    hits = 0;
    for (const Eigen::Vector3d& r : rays) hits += caster.first_occupied(eye, r, most_m).has_value();
  };
  double ours_s = 0;
#ifdef VANTAGE_HAS_OCTOMAP
  octomap::OcTree tree(voxel_m);
  std::istringstream file(encode_bt(map));
  if (!tree.readBinary(file)) state.SkipWithError("OctoMap does not read our file");
  const auto point = [](const Eigen::Vector3d& p) {
    return octomap::point3d(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  std::vector<octomap::point3d> their_rays;
  for (const Eigen::Vector3d& r : rays) their_rays.push_back(point(r));
  std::uint64_t their_hits = 0;
  const auto their_cast = [&] {
    their_hits = 0;
    octomap::point3d end;
    for (const octomap::point3d& r : their_rays) their_hits += tree.castRay(point(eye), r, end, true, most_m);
  };
  double theirs_s = 0;
  int turns = 0, their_turns = 0;
#endif
  for (auto _ : state) {
    ours_s += bench::seconds(cast);
#ifdef VANTAGE_HAS_OCTOMAP
    if (turns++ % 16 != 0) continue;
    state.PauseTiming();
    theirs_s += bench::seconds(their_cast);
    ++their_turns;
    state.ResumeTiming();
#endif
  }
#ifdef VANTAGE_HAS_OCTOMAP
  const double their_mean_s = theirs_s / their_turns;
  state.counters["octomap_rays_per_second"] = static_cast<double>(rays.size()) / their_mean_s;
  state.counters["octomap_ratio"] = their_mean_s * static_cast<double>(state.iterations()) / ours_s;
  state.counters["octomap_hits"] = static_cast<double>(their_hits);
#else
  (void)ours_s;
  state.SetLabel("without OctoMap");
#endif
  state.counters["hits"] = static_cast<double>(hits);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

template <class M, class... Channels>
void render(benchmark::State& state) {
  const M map = room_map<M>(0.2);
  const View view = look_at({-2.2, -1.5, 1.5}, {1, 0.2, 0.8});
  const Camera camera = Camera::from_fov(128, 128, deg(60));
  Rendering<Channels...> image;
  for (auto _ : state) map.render(view, camera, image);
  state.SetItemsProcessed(state.iterations() * camera.width * camera.height);
}

void depth(benchmark::State& state) { render<VoxelMap<>, channel::Depth>(state); }
void entropy(benchmark::State& state) { render<VoxelMap<>, channel::Entropy>(state); }
void gain(benchmark::State& state) { render<VoxelMap<>, channel::InformationGain>(state); }
void semantics(benchmark::State& state) { render<SemanticVoxelMap<8>, channel::Semantics>(state); }

/// 128 x 128 px each, in a box of 12 x 10 x 2.5 m of which a room of 6 x 5 m is known in part; 20 cm voxels.
void unexplored(benchmark::State& state) {
  const VoxelMap<> map = room_map(0.2, {3, 2.5, 0}, 3);
  Rng rng(5);
  std::vector<View> views;
  for (int i = 0; i < 100; ++i) views.push_back(some_view(rng));
  const Unexplored utility;
  std::uint64_t seen = 0;
  for (auto _ : state) {
    seen = 0;
    for (const std::uint64_t n : utility.count(map, views)) seen += n;
  }
  state.counters["voxels_seen"] = static_cast<double>(seen);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(views.size()));
}

/// 64 x 64 px each, of the room in 5 cm voxels.
void unseen_sides(benchmark::State& state) {
  const auto map = room_map<WithSides<>>(0.05);
  Rng rng(5);
  std::vector<View> views;
  for (int i = 0; i < 100; ++i) views.push_back(some_view(rng));
  std::vector<double> sides(views.size());
  const auto score = UnseenSides().prepare(map, Situation{}, rng);
  for (auto _ : state) score({}, views, sides);
  state.counters["sides"] = std::accumulate(sides.begin(), sides.end(), 0.0);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(views.size()));
}

BENCHMARK_CAPTURE(raycast, 20, 0.2)->Name("voxel/raycast/20cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(raycast, 5, 0.05)->Name("voxel/raycast/5cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(depth)->Name("voxel/render_depth/20cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(entropy)->Name("voxel/render_entropy/20cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gain)->Name("voxel/render_information_gain/20cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(semantics)->Name("voxel/render_semantics/20cm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(unexplored)->Name("voxel/unexplored/100")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(unseen_sides)->Name("voxel/unseen_sides/100")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
