// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Surfels of a furnished room drawn at 512 x 512 px, 60 degrees, and differentiated; the planning view has 128 x 128
// and depth and confidence only. Items are blends: surfels that a pixel draws.
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/surfel_input.hpp"
#include "peak.hpp"

#include <vantage/maps/surfel/tile_rasteriser.hpp>

namespace {

using namespace vantage;
using Raster = TileRasteriser<>;
using Training = Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Opacity>;
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

// The mean absolute error of colour and depth against a second map's images, its gradient by the images included.
void forward_backward(benchmark::State& state, std::size_t n, double sigma_m) {
  const Surfels& s = surfels(n, sigma_m);
  const RasterView view = bench::room_view(512);
  Raster::Pass pass;
  Training out, target;
  Raster().forward(bench::room_surfels(n, sigma_m, 2), view, pass, target);
  ImageGradient d;
  SurfelGradient gradient;
  gradient.reset(s.size());
  const auto sign = [](const Image<float>& a, const Image<float>& b, float scale, Image<float>& to) {
    to.resize(a.rows(), a.cols());
    parallel_for_blocks(static_cast<std::size_t>(a.size()), 1 << 14, [&](std::size_t begin, std::size_t end) {
      const float *p = a.data(), *q = b.data();
      float* into = to.data();
      for (std::size_t i = begin; i < end; ++i)
        into[i] = p[i] > q[i] ? scale : p[i] < q[i] ? -scale : 0;  // 0 for NaN, too
    });
  };
  for (auto _ : state) {
    gradient.reset(s.size());
    Raster().forward(s, view, pass, out);
    const auto pixels = static_cast<float>(out.depth.size());
    const channel::Colour &c = out, &cc = target;
    const channel::Normal &m = out, &mm = target;
    sign(c.r, cc.r, 1 / (3 * pixels), d.colour.r);
    sign(c.g, cc.g, 1 / (3 * pixels), d.colour.g);
    sign(c.b, cc.b, 1 / (3 * pixels), d.colour.b);
    sign(out.depth, target.depth, 0.8F / pixels, d.depth);
    sign(m.x, mm.x, 0.1F / pixels, d.normal_x);
    sign(m.y, mm.y, 0.1F / pixels, d.normal_y);
    sign(m.z, mm.z, 0.1F / pixels, d.normal_z);
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
  Training out;
  for_images(out, [](Image<float>& image) { image.resize(512, 512); });
  std::vector<KeptSums<16>> kept(bins.tiles());
  for (auto _ : state)
    parallel_for(bins.tiles(), [&](std::size_t t) {
      const TilePixels<16> at(bins, t, view.camera);
      TileBlend<16, LinearDepth, Training> tile(view, at);
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
  Training out;
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
    add("forward/" + thousands(n), [n](benchmark::State& s) { forward<Training>(s, n, 0.01, 512); });
  add("forward/300k_dense", [](benchmark::State& s) { forward<Training>(s, 300000, 0.0135, 512); });
  for (const std::size_t n : {100000, 300000, 1000000})
    add("forward_backward/" + thousands(n), [n](benchmark::State& s) { forward_backward(s, n, 0.01); });
  add("forward_planning/300k", [](benchmark::State& s) { forward<Planning>(s, 300000, 0.01, 128); });
  add("project/300k", [](benchmark::State& s) { project(s, 300000); });
  add("bin_and_sort/300k", [](benchmark::State& s) { bin_and_sort(s, 300000); });
  add("blend/300k", [](benchmark::State& s) { blend(s, 300000); });
  add("backward/300k", [](benchmark::State& s) { backward(s, 300000); });
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
