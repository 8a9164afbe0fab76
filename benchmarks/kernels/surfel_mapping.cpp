// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The mapping step of the surfel map and its parts, on a furnished room, with frames of 512 x 512 px, 60 degrees.
// mapping_step is all of SurfelMap::integrate on the 10th frame, pruning over all of them included, and
// mapping_step_only on the 9th, without: check, voxels, densification, 10 iterations on 8 frames each, confidence.
// `surfels` says how many there were. training is the iterations alone on 300 k. Items are pixels (of training: of all
// frames), of adam surfels.
#include <cstddef>
#include <vector>

#include "kernels/surfel_frames.hpp"
#include "peak.hpp"

#include <vantage/maps/surfel/densify.hpp>
#include <vantage/maps/surfel/surfel_map.hpp>
#include <vantage/maps/surfel/surfel_trainer.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>

namespace {

using namespace vantage;
using Raster = TileRasteriser<>;

constexpr int pixels = bench::frame_pixels;

void mapping_step(benchmark::State& state, int frames) {
  const SurfelMap<>& before = bench::map_after(frames);
  const Frame next = bench::surfel_frame(bench::room_surfels(300000, 0.01, 2), frames, 10);
  for (auto _ : state) {
    state.PauseTiming();
    SurfelMap<> map = before;
    Rng rng(1);
    state.ResumeTiming();
    map.integrate(next, rng);
    state.PauseTiming();
    state.counters["surfels_after"] = static_cast<double>(map.surfels().size());
    state.ResumeTiming();
  }
  state.counters["surfels"] = static_cast<double>(before.surfels().size());
  state.counters["megabytes"] = 1e-6 * static_cast<double>(before.bytes());
  state.SetItemsProcessed(state.iterations() * 10 * 8 * pixels * pixels);
}

void training(benchmark::State& state, std::size_t n) {
  const Surfels truth = bench::room_surfels(n, 0.01, 2);
  std::vector<TrainingFrame> frames;
  for (int k = 0; k < 20; ++k) frames.emplace_back(bench::surfel_frame(truth, k, 20));
  Surfels s = bench::room_surfels(n);
  SurfelTrainer<Raster, EdgeAwareVariation> train({}, {});
  Raster::Pass pass;
  Rng rng(1);
  for (auto _ : state) train(s, frames, {}, 10, Raster(), pass, rng);
  state.SetItemsProcessed(state.iterations() * 10 * 8 * pixels * pixels);
}

void loss(benchmark::State& state) {
  const Surfels s = bench::room_surfels(300000);
  const TrainingFrame f(bench::surfel_frame(bench::room_surfels(300000, 0.01, 2), 1, 4));
  Raster::Pass pass;
  TrainingImages drawn;
  Raster().forward(s, {.view = f.view, .camera = f.camera}, pass, drawn);
  const SurfelLoss<> loss;
  ImageGradient gradient;
  for (auto _ : state) benchmark::DoNotOptimize(loss(f.camera, drawn, f, gradient));
  state.SetItemsProcessed(state.iterations() * pixels * pixels);
}

void normals(benchmark::State& state) {
  const Frame f = bench::surfel_frame(bench::room_surfels(300000), 1, 4);
  for (auto _ : state) benchmark::DoNotOptimize(normals_of(bilateral_filter(f.depth), f.camera));
  state.SetItemsProcessed(state.iterations() * pixels * pixels);
}

// Every eighth block of surfels untouched, as if the cameras had not seen them.
void adam(benchmark::State& state, std::size_t n) {
  Surfels s = bench::room_surfels(n);
  SurfelGradient gradient;
  gradient.reset(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i / SurfelAdam::block % 8 == 0) continue;
    gradient.touched.push_back(static_cast<std::uint32_t>(i));
    for (auto& p : gradient.parameter) p[i] = 1e-3F * static_cast<float>(i % 7);
  }
  SurfelAdam adam;
  adam.restart(n);
  for (auto _ : state) adam.step(s, gradient);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(gradient.touched.size()));
}

void densify_all(benchmark::State& state) {
  const Frame f = bench::surfel_frame(bench::room_surfels(300000), 1, 4);
  TrainingImages nothing;
  Raster::Pass pass;
  Raster().forward(Surfels{}, {.view = f.view, .camera = f.camera}, pass, nothing);
  std::size_t spawned = 0;
  for (auto _ : state) {
    Surfels s;
    Rng rng(1);
    spawned = densify(s, f, nothing, {}, rng);
  }
  state.counters["spawned"] = static_cast<double>(spawned);
  state.SetItemsProcessed(state.iterations() * pixels * pixels);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto add = [](const char* name, auto&& kernel) {
    benchmark::RegisterBenchmark(name, kernel)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  add("surfel/mapping_step/300k", [](benchmark::State& s) { mapping_step(s, 9); });
  add("surfel/mapping_step_only/300k", [](benchmark::State& s) { mapping_step(s, 8); });
  add("surfel/training/300k", [](benchmark::State& s) { training(s, 300000); });
  add("surfel/loss/512", loss);
  add("surfel/normals/512", normals);
  add("surfel/densify_first/512", densify_all);
  add("surfel/adam/300k", [](benchmark::State& s) { adam(s, 300000); });
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
