// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// What composing policies in a loop costs: the same 20 planning steps on a 16 x 16 field map, composed and written by
// hand, in 31 alternating pairs. Counters: the median ratio of times, and how many more allocations a composed step
// makes.
#include <atomic>
#include <cstdlib>
#include <new>

#include "kernels/field_input.hpp"
#include "peak.hpp"

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/utility/variance_reduction.hpp>

namespace {
std::atomic<long> allocations{0};
}
// Everything goes through these: aligned requests, arrays and Eigen's own malloc are alike on both sides.
[[gnu::noinline]] void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace {

using namespace vantage;
using Gp = IntegralGp<SquaredExponential, CellAverage, Full<>, Merging<>, bench::Sensor>;
using World = FieldWorld<DeviationByHeight>;
constexpr std::size_t steps = 20;

Gp prior() {
  Gp::Config c = bench::config<Gp>(4);
  c.prior_mean = 0.7;
  return Gp(c);
}

double composed(World world, Gp map) {
  NbvLoop loop{std::move(map), VarianceReduction{}, Lattice{Lattice::thesis()}, PerFlightTime{}};
  const MissionState end = loop.run(world, nadir(10, 10, 2), {}, Measurements{steps}, ModelledClock{}, Rng{7});
  return end.travelled_m;
}

double by_hand(World world, Gp map) {
  const Lattice lattice(Lattice::thesis());
  View here = nadir(10, 10, 2);
  double travelled_m = 0;
  std::vector<View> visited;
  for (std::size_t step = 0; step < steps; ++step) {
    std::vector<View> views;
    views.reserve(lattice.views().size());
    for (const View& v : lattice.views())
      if (!same_place(v, here)) views.push_back(v);
    std::vector<double> reduction(views.size());
    map.forecast({}, views, reduction);
    std::size_t best = 0;
    for (std::size_t i = 1; i < views.size(); ++i)
      if (reduction[i] / distance_m(here, views[i]) > reduction[best] / distance_m(here, views[best])) best = i;
    travelled_m += distance_m(here, views[best]);
    here = views[best];
    const auto image = world.observe(here);
    Rng rng = Rng{7}.fork(2 * step + 1);
    map.integrate(*image, rng);
    visited.push_back(here);
  }
  return travelled_m;
}

void overhead(benchmark::State& state) {
  const World world(random_field(Rng(1)), DeviationByHeight{0.05}, Rng(2));
  const Gp map = prior();
  if (composed(world, map) != by_hand(world, map))
    throw Error("loop/overhead", "the two fly different missions", "the same");
  std::vector<double> ratio;
  double extra = 0;
  for (auto _ : state) {
    for (int pair = 0; pair < 31; ++pair) {
      World a = world, b = world;
      Gp x = map, y = map;
      long before = allocations;
      const double composed_s = bench::seconds([&] { benchmark::DoNotOptimize(composed(std::move(a), std::move(x))); });
      const long composed_n = allocations - before;
      before = allocations;
      const double hand_s = bench::seconds([&] { benchmark::DoNotOptimize(by_hand(std::move(b), std::move(y))); });
      extra = static_cast<double>(composed_n - (allocations - before)) / static_cast<double>(steps);
      ratio.push_back(composed_s / hand_s);
    }
  }
  std::nth_element(ratio.begin(), ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2), ratio.end());
  state.counters["ratio"] = ratio[ratio.size() / 2];
  state.counters["extra_allocations_a_step"] = extra;
  state.SetItemsProcessed(state.iterations() * 31 * static_cast<std::int64_t>(steps));
}
BENCHMARK(overhead)->Name("loop/overhead")->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
