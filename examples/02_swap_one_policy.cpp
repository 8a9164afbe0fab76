// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
//
// Swapping one policy. What the mission maps with, what it values, where it may go and how it chooses are four
// arguments; a baseline is the same program with another one. (One field says little about which is best: the studies
// take many. Variance reduction looks only where the map expects a hotspot: one that an early high view missed stays
// missed, and so a utility that looks everywhere can win.)
#include <cstdio>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/vantage.hpp>

using namespace vantage;

/// Flies 100 seconds with these four policies and says how well the hotspots are known.
template <class MapT, class UtilityT, class SamplerT, class SelectorT>
void fly(const char* name, MapT map, UtilityT utility, SamplerT sampler, SelectorT selector) {
  FieldWorld world{random_field(Rng{1}), VarianceByHeight{}, Rng{2}};
  NbvLoop loop{std::move(map), utility, sampler, selector};
  const MissionState end = loop.run(world, nadir(0, 0, 0), {}, MissionTime{100}, ModelledClock{}, Rng{7});
  const FieldMetrics m = field_metrics(loop.map, world.truth(), loop.map.interest());
  std::printf("%-30s %4zu pictures   %4zu cells   error in hotspots %.3f\n", name, end.visited.size(), m.cells,
              m.rmse_hotspots);
}

int main() {
  const IntegralGp<> ours({.prior_mean = 0.7});
  const Lattice lattice{Lattice::thesis()};

  fly("variance reduction per second", ours, VarianceReduction{}, lattice, PerFlightTime{});

  // Another selector: the best view, however far it is; or the best minus the price of the way.
  fly("  the best, however far", ours, VarianceReduction{}, lattice, ArgMax{});
  fly("  the best minus 2 a metre", ours, VarianceReduction{}, lattice, MinusCost<>{{.weight_per_m = 2}});

  // Another utility: where the map is most uncertain; far from all before; any.
  fly("  mean uncertainty", ours, MeanUncertainty{Camera::from_fov(16, 16, deg(90))}, lattice, PerFlightTime{});
  fly("  far from all before", ours, ViewDistance<Nearest>{}, lattice, PerFlightTime{});
  fly("  any view", ours, Uninformed{}, lattice, ArgMax{});

  // Another sampler: a lawnmower, which a selector follows in order.
  fly("  to and fro", ours, Uninformed{}, Lawnmower{{.area = Lattice::field_20m()}}, InOrder{});

  // Another map: cells that know nothing of each other, on a fixed grid.
  using Independent = IntegralGp<SquaredExponential, CellAverage, Diagonal, Fixed<>>;
  fly("  independent cells", Independent({.prior_mean = 0.7}), VarianceReduction{}, lattice, PerFlightTime{});
}
