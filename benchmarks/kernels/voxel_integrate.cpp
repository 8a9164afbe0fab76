// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A frame of 512 x 512 px, 60 degrees, 5 m, from the inside of a room of 6 x 5 x 2.5 m into a voxel map that has seen
// it before (repeated view) or has not (first view). Items are voxels hit or passed; rays_per_second counts pixels with
// a value. OctoMap 1.9.7 (one thread, discretised: one ray a voxel) on the same points in the same run, if it is
// there; octomap_ratio = its time / ours, measured in turn.
#include <cmath>
#include <optional>
#include <string>

#include "kernels/room_input.hpp"
#include "peak.hpp"

#include <vantage/maps/voxel/voxel_map.hpp>
#ifdef VANTAGE_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

namespace {

using namespace vantage;

Frame frame() {
  Frame f = bench::room_frame(512, look_at({-2.2, -1.5, 1.5}, {1, 0.2, 0.8}));
  f.colour = {};
  return f;
}
template <class M>
typename M::Config config(double voxel_m) {
  typename M::Config c;
  const Box3 walls = bench::Room().walls;
  c.bounds = Box3(walls.min().array() - 0.2, walls.max().array() + 0.2);
  c.voxel_m = voxel_m;
  return c;
}

#ifdef VANTAGE_HAS_OCTOMAP
struct OctoMap {
  OctoMap(const Frame& f, double voxel_m) : tree(voxel_m) {
    const Eigen::Vector3f eye = f.view.position().cast<float>();
    origin = {eye.x(), eye.y(), eye.z()};
    for (int v = 0; v < f.camera.height; ++v)
      for (int u = 0; u < f.camera.width; ++u) {
        if (std::isnan(f.depth(v, u))) continue;
        const Eigen::Vector3f p =
            (f.view.T_W_C * Eigen::Vector3d(f.depth(v, u) * f.camera.ray(u + 0.5, v + 0.5))).cast<float>();
        points.push_back(p.x(), p.y(), p.z());
      }
  }
  void integrate() { tree.insertPointCloud(points, origin, -1, false, true); }
  octomap::OcTree tree;
  octomap::Pointcloud points;
  octomap::point3d origin;
};
#endif

template <class Update>
void integrate(benchmark::State& state, double voxel_m, bool repeated) {
  using M = VoxelMap<Update>;
  const Frame f = frame();
  std::optional<M> map;
  map.emplace(config<M>(voxel_m));
  map->integrate(f);
  const auto touched = static_cast<std::int64_t>(map->counts().explored);
  for (int k = 0; k < 8 && repeated; ++k) map->integrate(f);
  double ours_s = 0, octomap_s = 0;
#ifdef VANTAGE_HAS_OCTOMAP
  std::optional<OctoMap> octomap;
  octomap.emplace(f, voxel_m);
  octomap->integrate();
#endif
  int turns = 0;
  for (auto _ : state) {
    if (!repeated) {
      state.PauseTiming();
      map.emplace(config<M>(voxel_m));
      state.ResumeTiming();
    }
    ours_s += bench::seconds([&] { map->integrate(f); });
#ifdef VANTAGE_HAS_OCTOMAP
    if (turns++ % 16 != 0) continue;
    state.PauseTiming();
    if (!repeated) octomap.emplace(f, voxel_m);
    octomap_s += 16 * bench::seconds([&] { octomap->integrate(); });
    state.ResumeTiming();
#endif
  }
#ifdef VANTAGE_HAS_OCTOMAP
  const double mean_s = octomap_s / 16 / static_cast<double>((turns + 15) / 16);
  state.counters["octomap_ms"] = 1e3 * mean_s;
  state.counters["octomap_ratio"] = mean_s * static_cast<double>(state.iterations()) / ours_s;
#else
  (void)octomap_s, (void)turns;
  state.SetLabel("without OctoMap");
#endif
  state.counters["rays_per_second"] = benchmark::Counter(static_cast<double>((!f.depth.isNaN()).count()),
                                                         benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes_per_voxel"] =
      static_cast<double>(map->bytes()) / static_cast<double>(512 * map->known_blocks().size());
  state.SetItemsProcessed(state.iterations() * touched);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto add = [](const std::string& update, auto kernel) {
    for (const bool repeated : {true, false})
      for (const int cm : {20, 5})
        benchmark::RegisterBenchmark(
            concat("voxel/integrate_", update, repeated ? "" : "_first_view", "/", cm, "cm").c_str(),
            [=](benchmark::State& state) { kernel(state, 0.01 * cm, repeated); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
  };
  add("projective", integrate<Projective>);
  add("raycast", integrate<RayCast>);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
