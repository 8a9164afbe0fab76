// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Surfaces from depth: TSDF fusion of one frame, and marching cubes on a dense grid.
#include <optional>

#include "kernels/room_input.hpp"
#include "peak.hpp"

#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/tsdf.hpp>

namespace {

using namespace vantage;

Tsdf::Config room_config(bool colour) {
  const Box3 walls = bench::Room().walls;
  return {.bounds = Box3(walls.min().array() - 0.2, walls.max().array() + 0.2), .colour = colour};
}

// One 512 x 512 frame into 2 cm voxels with 10 cm truncation. Items are voxels of the bricks that the frame touches.
// `fresh`: into an empty volume (memory that was never touched, as the first frames of a mission), else one that has
// seen the place. Bytes are those of the voxels, read and written once.
void tsdf(benchmark::State& state, bool colour, bool fresh) {
  const Frame frame = bench::room_frame(512, look_at({-2.2, -1.5, 1.5}, {1, 0.2, 0.8}));
  std::optional<Tsdf> volume;
  volume.emplace(room_config(colour));
  volume->integrate(frame);
  const auto voxels = static_cast<std::int64_t>(volume->bricks() * brick_samples);
  for (auto _ : state) {
    if (fresh) {
      state.PauseTiming();
      volume.emplace(room_config(colour));
      state.ResumeTiming();
    }
    volume->integrate(frame);
    benchmark::DoNotOptimize(volume->bricks());
  }
  state.SetItemsProcessed(state.iterations() * voxels);
  state.SetBytesProcessed(state.iterations() * voxels * (colour ? 40 : 16));
  state.counters["megabytes"] = static_cast<double>(volume->bytes()) * 1e-6;
}

// Items are samples of the grid.
template <class F>
void surface(benchmark::State& state, F value) {
  constexpr int n = 256;
  std::vector<float> values;
  values.reserve(std::size_t{n} * n * n);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) values.push_back(static_cast<float>(value(x - 127.3, y - 127.9, z - 127.5)));
  const ScalarGrid grid(Eigen::Vector3i::Constant(n), Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(0.01),
                        std::move(values));
  std::size_t triangles = 0;
  for (auto _ : state) {
    const TriangleMesh mesh = marching_cubes(grid);
    triangles = mesh.triangles.size();
    benchmark::DoNotOptimize(triangles);
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["triangles_per_second"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
  state.SetItemsProcessed(state.iterations() * n * n * n);
  state.SetBytesProcessed(state.iterations() * n * n * n * 4);
}
double sphere(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z) - 100; }
double gyroid(double x, double y, double z) {
  const double k = 0.12;
  return std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) + std::sin(k * z) * std::cos(k * x);
}

BENCHMARK_CAPTURE(tsdf, depth, false, false)->Name("geometry/tsdf/512")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(tsdf, colour, true, false)
    ->Name("geometry/tsdf_colour/512")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(tsdf, fresh, true, true)
    ->Name("geometry/tsdf_first_frame/512")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(surface, sphere, sphere)
    ->Name("geometry/marching_cubes/256")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(surface, gyroid, gyroid)
    ->Name("geometry/marching_cubes_gyroid/256")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
