// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// What an evaluation costs: picture metrics, and surface metrics of a reconstructed room.
#include "kernels/room_input.hpp"
#include "peak.hpp"

#include <vantage/eval/image_metrics.hpp>
#include <vantage/eval/mesh_metrics.hpp>
#include <vantage/eval/surface_coverage.hpp>
#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/mesh_components.hpp>
#include <vantage/geometry/tsdf.hpp>

namespace {

using namespace vantage;

View corner_view() { return look_at({-2.2, -1.5, 1.5}, {1, 0.2, 0.8}); }

// Three colours, useful flops a pixel and colour: 11 taps of 11 down the columns, 4 x 11 of 2 along the rows, 19 for
// the quotient; in single precision.
void ssim_of_colours(benchmark::State& state) {
  const Frame a = bench::room_frame(512, corner_view()),
              b = bench::room_frame(512, look_at({-2.1, -1.5, 1.5}, {1, 0.2, 0.8}));
  for (auto _ : state) benchmark::DoNotOptimize(ssim(a.colour, b.colour));
  constexpr double values = 3.0 * 512 * 512, flops = values * (11 * 11 + 4 * 11 * 2 + 19);
  state.SetItemsProcessed(state.iterations() * 512 * 512);
  state.counters["gflops"] = benchmark::Counter(flops * 1e-9, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["peak_share"] =
      benchmark::Counter(flops / bench::peak_flops<float>(), benchmark::Counter::kIsIterationInvariantRate);
}

// A room reconstructed from 24 frames with noise, and its truth: 500 k true points, 500 k of the estimate.
struct Rooms {
  TriangleMesh estimate, truth;
  SurfaceSamples points;
  Rooms() {
    const Box3 walls = bench::Room().walls;
    Tsdf tsdf({.bounds = Box3(walls.min().array() - 0.2, walls.max().array() + 0.2), .colour = false});
    for (int i = 0; i < 24; ++i) {
      const Eigen::Vector3d eye(-1, -0.5, 1.3);
      const double turn = deg(30.0 * i), up = i < 12 ? -0.5 : 0.4;
      tsdf.integrate(bench::room_frame(512, look_at(eye, eye + Eigen::Vector3d(std::cos(turn), std::sin(turn), up)),
                                       static_cast<std::uint64_t>(i)));
    }
    estimate = without_small_components(marching_cubes(tsdf));
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(truth.vertices.size());
      for (const auto& [a, b] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
        Eigen::Vector3d p = walls.min();
        p[axis] = side % 2 ? walls.max()[axis] : walls.min()[axis];
        p[u] = a ? walls.max()[u] : walls.min()[u];
        p[v] = b ? walls.max()[v] : walls.min()[v];
        truth.vertices.push_back(p.cast<float>());
      }
      truth.triangles.push_back({first, first + 1, first + 2});
      truth.triangles.push_back({first, first + 2, first + 3});
    }
    points = sample_surface(truth, 500'000, Rng(1));
  }
};
const Rooms& rooms() {
  static const Rooms r;
  return r;
}

// Both directions: trees, queries and point-to-triangle distances. Items are queries.
void completeness(benchmark::State& state, MeshComparison::To to) {
  const Rooms& r = rooms();
  MeshMetrics m;
  for (auto _ : state) m = mesh_metrics(r.estimate, r.truth, r.points, {.samples = 500'000, .to = to}, Rng(2));
  state.SetItemsProcessed(state.iterations() * 1'000'000);
  state.counters["completeness"] = m.completeness;
  state.counters["completeness_mm"] = 1e3 * m.completeness_m;
  state.counters["accuracy_mm"] = 1e3 * m.accuracy_m;
}

// One frame's share of 500 k points, none of them seen before. Items are points.
void coverage(benchmark::State& state) {
  const Frame frame = bench::room_frame(512, corner_view());
  const SurfaceCoverage before(rooms().points);
  for (auto _ : state) {
    state.PauseTiming();
    SurfaceCoverage c = before;
    state.ResumeTiming();
    benchmark::DoNotOptimize(c.add(frame));
  }
  state.SetItemsProcessed(state.iterations() * 500'000);
}

BENCHMARK(ssim_of_colours)->Name("eval/ssim/512")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(completeness, surface, MeshComparison::To::surface)
    ->Name("eval/completeness/500k")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(completeness, points, MeshComparison::To::points)
    ->Name("eval/completeness_to_points/500k")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(coverage)->Name("eval/coverage/500k")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
