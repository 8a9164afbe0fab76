// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Surfels of a furnished room drawn at 512 x 512 px, 60 degrees, and differentiated: colour, depth, normal and opacity,
// as training needs them. The planning view has 128 x 128 px, and depth, confidence and opacity only. Items are blends,
// surfels that a pixel draws; of project surfels, of bin_and_sort and blend entries in the lists of tiles.
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/surfel_frames.hpp"
#include "peak.hpp"

#include <vantage/maps/surfel/surfel_loss.hpp>
#include <vantage/maps/surfel/surfel_trainer.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>

namespace {

using namespace vantage;
using Raster = TileRasteriser<>;
using Planning = Rendering<channel::Depth, channel::Confidence, channel::Opacity>;

const Surfels& surfels(std::size_t n, double sigma_m) {
  static std::map<std::pair<std::size_t, double>, Surfels> made;
  auto& s = made[{n, sigma_m}];
  if (s.size() == 0) s = bench::room_surfels(n, sigma_m);
  return s;
}

void count(benchmark::State& state, const RasterView& view, Raster::Pass& pass) {
  const auto blends = static_cast<double>(Raster().blends(view, pass));
  state.counters["visible"] = static_cast<double>(pass.visible());
  state.counters["tile_entries"] = static_cast<double>(pass.tile_entries());
  state.counters["blends_per_pixel"] = blends / (view.camera.width * view.camera.height);
  state.SetItemsProcessed(static_cast<std::int64_t>(blends) * state.iterations());
}

template <class Channels>
void forward(benchmark::State& state, std::size_t n, double sigma_m, int pixels) {
  const Surfels& s = surfels(n, sigma_m);
  const RasterView view = bench::room_view(pixels);
  Raster::Pass pass;
  Channels out;
  for (auto _ : state) Raster().forward(s, view, pass, out);
  count(state, view, pass);
}

// What training does with a frame of its batch: the images, the loss (eq. 6.5) with its gradient, through the normals
// of the rendered depth too, and backward to the surfels. The frame shows other surfels of the same room.
void forward_backward(benchmark::State& state, std::size_t n, double sigma_m) {
  const Surfels& s = surfels(n, sigma_m);
  const RasterView view = bench::room_view(bench::frame_pixels);
  const TrainingFrame frame(bench::surfel_frame(bench::room_surfels(n, sigma_m, 2), view.view));
  const SurfelLoss<EdgeAwareVariation> loss;
  Raster::Pass pass;
  TrainingImages out;
  ImageGradient d;
  SurfelGradient gradient;
  gradient.reset(s.size());
  for (auto _ : state) {
    gradient.reset(s.size());
    Raster().forward(s, view, pass, out);
    benchmark::DoNotOptimize(loss(frame.camera, out, frame, d));
    Raster().backward(s, view, pass, d, gradient);
  }
  count(state, view, pass);
}

void project(benchmark::State& state, std::size_t n) {
  const Surfels& s = surfels(n, 0.01);
  const RasterView view = bench::room_view(512);
  VisibleSplats splats;
  for (auto _ : state) splats.project<LinearDepth>(s, view);
  state.counters["visible"] = static_cast<double>(splats.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

void bin_and_sort(benchmark::State& state, std::size_t n) {
  const RasterView view = bench::room_view(512);
  VisibleSplats splats;
  splats.project<LinearDepth>(surfels(n, 0.01), view);
  TileBins bins;
  for (auto _ : state) bins.fill<16>(splats, view.camera);
  state.counters["tile_entries"] = static_cast<double>(bins.entries());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bins.entries()));
}

// Tiles into images, projected and dealt before.
void blend(benchmark::State& state, std::size_t n) {
  const RasterView view = bench::room_view(512);
  VisibleSplats splats;
  splats.project<LinearDepth>(surfels(n, 0.01), view);
  TileBins bins;
  bins.fill<16>(splats, view.camera);
  TrainingImages out;
  for_images(out, [](Image<float>& image) { image.resize(512, 512); });
  std::vector<KeptSums<16>> kept(bins.tiles());
  for (auto _ : state)
    parallel_for(bins.tiles(), [&](std::size_t t) {
      const TilePixels<16> at(bins, t, view.camera);
      TileBlend<16, LinearDepth, TrainingImages> tile(view, at);
      tile.draw(splats, bins.of(t));
      tile.write(out, kept[t]);
    });
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bins.entries()));
}

// From the images' derivatives to the surfels'.
void backward(benchmark::State& state, std::size_t n) {
  const Surfels& s = surfels(n, 0.01);
  const RasterView view = bench::room_view(512);
  Raster::Pass pass;
  TrainingImages out;
  Raster().forward(s, view, pass, out);
  const Image<float> by = Image<float>::Constant(512, 512, 1e-6F);
  const ImageGradient d{{by, by, by}, by, {}, by, by, by};
  SurfelGradient gradient;
  for (auto _ : state) Raster().backward(s, view, pass, d, gradient);
  count(state, view, pass);
}

std::string thousands(std::size_t n) { return n < 1000000 ? concat(n / 1000, "k") : concat(n / 1000000, "M"); }

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto add = [](const std::string& name, auto kernel) {
    benchmark::RegisterBenchmark(("surfel/" + name).c_str(), kernel)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  for (const std::size_t n : {10000, 30000, 100000, 300000, 1000000, 3000000})
    add("forward/" + thousands(n), [n](benchmark::State& s) { forward<TrainingImages>(s, n, 0.01, 512); });
  add("forward/300k_dense", [](benchmark::State& s) { forward<TrainingImages>(s, 300000, 0.0135, 512); });
  for (const std::size_t n : {10000, 30000, 100000, 300000, 1000000, 3000000})
    add("forward_backward/" + thousands(n), [n](benchmark::State& s) { forward_backward(s, n, 0.01); });
  add("forward_planning/300k", [](benchmark::State& s) { forward<Planning>(s, 300000, 0.01, 128); });
  add("project/300k", [](benchmark::State& s) { project(s, 300000); });
  add("bin_and_sort/300k", [](benchmark::State& s) { bin_and_sort(s, 300000); });
  add("blend/300k", [](benchmark::State& s) { blend(s, 300000); });
  add("backward/300k", [](benchmark::State& s) { backward(s, 300000); });
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
