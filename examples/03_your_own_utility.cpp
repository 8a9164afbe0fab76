// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
//
// A utility of one's own. It is a class with a call operator: the map and a view in, a number out, larger is better. It
// needs no base class and no registration; the loop runs it for all candidates at once.
#include <cmath>
#include <cstdio>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/vantage.hpp>

using namespace vantage;

/// The upper confidence bound, averaged over what the sensor would see: where it is hot, or might be.
struct UpperConfidenceBound {
  /// What it asks of a map. Given one without cells, the first line of the compiler's answer says so.
  using MapNeeds = Needs<need::Field>;

  double kappa = 2;  ///< how much a standard deviation counts
  NadirSensor sensor = {};

  template <FieldMap M>
  double operator()(const M& map, const View& view) const {
    const Box2 seen = sensor.footprint(view);
    double sum = 0, total_m2 = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
      if (const double part_m2 = area(map.cell(i).intersection(seen)); part_m2 > 0) {
        sum += part_m2 * (map.mean(i) + kappa * std::sqrt(map.variance(i)));
        total_m2 += part_m2;
      }
    return total_m2 > 0 ? std::max(0.0, sum / total_m2) : 0;
  }
};
// Two other forms: `operator()(map, situation, view)` for one that looks at what happened so far (situation.visited,
// ...), and `prepare(map, situation, rng)` for one whose candidates share work (see utility/variance_reduction.hpp).

int main() {
  for (const double kappa : {0.0, 1.0, 2.0, 4.0}) {
    FieldWorld world{random_field(Rng{1}), VarianceByHeight{}, Rng{2}};
    NbvLoop loop{IntegralGp<>{}, UpperConfidenceBound{.kappa = kappa}, Lattice{Lattice::thesis()}, ArgMax{}};
    loop.run(world, nadir(0, 0, 0), {}, MissionTime{200}, ModelledClock{}, Rng{7});
    const FieldMetrics m = field_metrics(loop.map, world.truth(), loop.map.interest());
    std::printf("kappa %.0f: error %.3f, in hotspots %.3f\n", kappa, m.rmse, m.rmse_hotspots);
  }
}
