// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/utility/variance_reduction.hpp>

#include "field_methods.hpp"
#include "published_clock.hpp"
#include "table.hpp"
#include "units.hpp"

// The mission of section 3.2.3: one unit of the study of Fig. 3.6.
namespace study {

inline constexpr int map_size = 32;

/// Whether there is anything hot in what a measurement saw.
inline bool sees_hotspot(const ScalarField& truth, const Box2& footprint, const auto& interest) {
  for (Eigen::Index row = 0; row < truth.rows(); ++row)
    for (Eigen::Index column = 0; column < truth.columns(); ++column)
      if (interest.hot(truth.values()(row, column)) && footprint.contains(truth.centre(row, column))) return true;
  return false;
}

/// Keeps a mission's history: what the map was worth after each measurement. Not timed: the clock stands still
/// meanwhile.
template <class Interest>
class History {
 public:
  History(const ScalarField& truth, const Interest& interest) : truth_(truth), interest_(interest) {}

  template <class M>
  void started(const M& map, const Situation& q) {
    note(map, q.elapsed_s);
  }
  template <class M, class Z>
  void measured(const M& map, const Situation& q, const Step<Z>& step) {
    note(map, q.elapsed_s);
    planning_s_.push_back(step.planning_s);
    mapping_s_.push_back(step.mapping_s);
    flight_s_.push_back(step.action_s);
    height_m_.push_back(step.measurement.view.position().z());
    hot_.push_back(sees_hotspot(truth_, step.measurement.footprint, interest_) ? 1 : 0);
  }
  /// `elapsed_s` and the metrics begin with the prior, the rest with the first measurement.
  [[nodiscard]] Json json() const {
    const auto list = [](const std::vector<double>& values) {
      Json a = Json::array();
      for (const double v : values) a.push_back(number(v));
      return a;
    };
    return {{"elapsed_s", list(elapsed_s_)},
            {"rmse", list(rmse_)},
            {"rmse_hotspots", list(rmse_hotspots_)},
            {"iou", list(iou_)},
            {"cells", list(cells_)},
            {"planning_s", list(planning_s_)},
            {"mapping_s", list(mapping_s_)},
            {"flight_s", list(flight_s_)},
            {"height_m", list(height_m_)},
            {"sees_hotspot", list(hot_)}};
  }

 private:
  template <class M>
  void note(const M& map, double elapsed_s) {
    const FieldMetrics m = field_metrics(map, truth_, interest_);
    elapsed_s_.push_back(elapsed_s);
    rmse_.push_back(m.rmse);
    rmse_hotspots_.push_back(m.rmse_hotspots);
    iou_.push_back(m.iou);
    cells_.push_back(static_cast<double>(m.cells));
  }
  const ScalarField& truth_;
  Interest interest_;
  std::vector<double> elapsed_s_, rmse_, rmse_hotspots_, iou_, cells_, planning_s_, mapping_s_, flight_s_, height_m_,
      hot_;
};

/// Section 3.2.3: greedy on 300 views, eq. 3.13 per flight time (eq. 3.14), until the mission time is over.
template <class MapT, class Preset>
Json run_mission(const std::string& method, const std::string& clock_name, std::uint64_t seed, std::uint64_t field,
                 double budget_s) {
  auto world = make_world<Preset>(seed, field);
  NbvLoop loop{MapT(map_config<MapT, Preset>(map_size, FieldTask::planning)), VarianceReduction{},
               Lattice{Lattice::thesis()}, PerFlightTime{}};
  const ScalarField truth = world.truth();
  History history(truth, loop.map.interest());
  const View start = nadir(0, 0, 0);  // the UAV stands in a corner
  const auto fly = [&](auto&& clock) { loop.run(world, start, {}, MissionTime{budget_s}, clock, Rng(seed), history); };
  if (clock_name == "measured")
    fly(MeasuredClock{});
  else
    fly(PublishedClock(loop.map, published_costs(method)));
  return history.json();
}

}  // namespace study
