// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
//
// A first mission. A UAV above an unknown field decides, after every picture, from where to take the next, so that the
// map of what matters (values above 0.7) becomes good fast.
#include <cstdio>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/vantage.hpp>

using namespace vantage;

int main() {
  // The world: a random field of 20 m x 20 m that only the sensor sees, pixel by pixel and with noise.
  FieldWorld world{random_field(Rng{1}), VarianceByHeight{}, Rng{2}};

  // The loop: four policies, composed at compile time.
  NbvLoop loop{IntegralGp<>{{.prior_mean = 0.7}},  // what is known so far: a Gaussian process on an adaptive grid
               VarianceReduction{},                // how good is a view? what it would take from the uncertainty
               Lattice{Lattice::thesis()},         // which views are there? 300, at 2 m and at 5 m
               PerFlightTime{}};                   // which one, then? the most utility per second of flight

  const auto report = [&](const char* when) {
    const FieldMetrics m = field_metrics(loop.map, world.truth(), loop.map.interest());
    std::printf("%-7s error in hotspots %.3f, their overlap with the truth %.2f, %zu cells\n", when, m.rmse_hotspots,
                m.iou, m.cells);
  };

  // The mission: from a corner on the ground, no views planned by hand, 100 seconds.
  report("before:");
  const MissionState end = loop.run(world, nadir(0, 0, 0), {}, MissionTime{100}, ModelledClock{}, Rng{7});
  report("after:");
  std::printf("%zu pictures, %.0f m of flight\n", end.visited.size(), end.travelled_m);
}
