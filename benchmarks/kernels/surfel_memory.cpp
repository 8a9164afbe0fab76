// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// What a surfel map takes: 300 k surfels, 100 frames of 512 x 512 px and the voxels (map_megabytes), and the process at
// its most, with all that training needs (peak_rss_megabytes). The time is that of training: 10 iterations, 8 frames
// each. A process of its own, since its peak is measured. Items are pixels of all frames.
#include <sys/resource.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/surfel_frames.hpp"
#include "peak.hpp"

namespace {

using namespace vantage;

/// A map with the surfels of the room, to which frames add none; it trains when it is told to.
SurfelMap<> map_of_room(std::size_t n) {
  SurfelMap<>::Config c;
  c.voxels.bounds = bench::room_bounds();
  c.iterations = 0;
  c.prune.every_frames = 1000;
  c.densify.least_opacity = 0;
  c.densify.most_colour_error = c.densify.most_behind_share = 1e9;
  c.densify.filter.diameter_px = 1;
  SurfelMap<> map(c);
  // By way of a checkpoint, in the order of SurfelMap::save: the head of an empty one says which map it is.
  Sink empty;
  map.save(empty);
  Source head(empty.bytes());
  std::string signature;
  head.get(signature);
  const Surfels s = bench::room_surfels(n);
  Sink sink;
  sink.put(std::string_view(signature));
  sink.put(std::uint64_t{0});  // frames taken
  for (const auto& values : s.parameter) sink.put(values);
  sink.put(s.confidence);
  sink.put(std::vector<float>(s.size() * IncrementalConfidence::numbers));
  sink.put(std::uint64_t{0});  // frames kept
  map.voxels().save(sink);
  Source source(sink.bytes());
  map.load(source);
  return map;
}

SurfelMap<> map_after(int frames, std::size_t n) {
  SurfelMap<> map = map_of_room(n);
  const Surfels truth = bench::room_surfels(n, 0.01, 2);
  Rng rng(1);
  for (int k = 0; k < frames; ++k) map.integrate(bench::surfel_frame(truth, k, frames), rng);
  return map;
}

void memory(benchmark::State& state) {
  static SurfelMap<> map = map_after(100, 300000);
  Rng rng(1);
  for (auto _ : state) map.refine(10, rng);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["surfels"] = static_cast<double>(map.surfels().size());
  state.counters["map_megabytes"] = 1e-6 * static_cast<double>(map.bytes());
  state.counters["peak_rss_megabytes"] = 1.024e-3 * static_cast<double>(usage.ru_maxrss);  // of 1024 bytes
  state.SetItemsProcessed(state.iterations() * 10 * 8 * bench::frame_pixels * bench::frame_pixels);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RegisterBenchmark("surfel/memory/300k", memory)->Unit(benchmark::kMillisecond)->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
