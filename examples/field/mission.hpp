// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <vantage/eval/field_metrics.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/methods.hpp>
#include <vantage/mission/checkpoint.hpp>
#include <vantage/mission/progress.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/variance_reduction.hpp>

#include "input.hpp"
#include "options.hpp"
#include "results.hpp"
#include "survey.hpp"
#include "units.hpp"

namespace field {

template <class Preset>
using WorldNoise =
    std::conditional_t<std::is_same_v<typename FieldPreset<Preset>::HeightNoise, VarianceGrowsWithHeight>,
                       VarianceByHeight, DeviationByHeight>;

/// How good a map is, in the field's unit.
struct Judge {
  const Input& input;
  double threshold;
  [[nodiscard]] bool hot(double value) const { return value > threshold; }

  template <FieldMap M>
  std::vector<Metric> operator()(const M& map) const {
    const FieldMetrics m = field_metrics(map, input.truth, *this);
    const double rmse = input.held_out.empty() ? m.rmse : rmse_at(map, input.held_out);
    return {
        {"rmse", rmse}, {"rmse_hotspots", m.rmse_hotspots}, {"iou", m.iou}, {"cells", static_cast<double>(m.cells)}};
  }
};

/// All that determines the mission, besides the seed.
inline nlohmann::ordered_json config(const Options& o, const Input& input, double threshold, double alpha) {
  const ScalarField& truth = input.truth;
  const auto budget = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  nlohmann::ordered_json c = {{"mission", "field"},
                              {"field", input.name},
                              {"quantity", truth.quantity().name},
                              {"unit", truth.quantity().unit}};
  c["range"] = {truth.minimum(), truth.maximum()};
  c["area_m"] = {truth.area().sizes().x(), truth.area().sizes().y()};
  if (input.scale) c["scale_m_per_unit"] = *input.scale;
  if (input.latitude_deg) c["scale_latitude_deg"] = *input.latitude_deg;
  c["held_out_samples"] = input.held_out.size();
  c["method"] = o.method;
  c["protocol"] = field::name_of(o.protocol);
  c["preset"] = vantage::name_of(o.preset);
  c["clock"] = vantage::name_of(o.clock);
  c["resolution"] = o.cells_a_side();
  c["threshold"] = threshold;
  c["noise_alpha"] = alpha;
  c["sensor_pixels"] = o.pixels;
  c["sensor_half_angle_deg"] = o.half_angle_deg;
  c["budget_s"] = budget(o.budget_s);
  c["budget_travel_m"] = budget(o.travel_m);
  if (o.measurements != std::numeric_limits<std::uint64_t>::max()) c["budget_measurements"] = o.measurements;
  return c;
}

/// One mission with one preset, whatever the method.
template <class Preset>
class Mission {
 public:
  Mission(const Options& options, const Input& input) : o_(options), input_(input) {}

  void run() const {
    const std::string& m = o_.method;
    if (m == "ours")
      measure<Ours<Preset>>();
    else if (m == "latent")
      measure<Ours<Preset, Latent<>>>();
    else if (m == "fr_gpf")
      measure<FrGpf<Preset>>();
    else if (m == "fr_idp")
      measure<FrIdp<Preset>>();
    else if (m == "ar_idp")
      measure<ArIdp<Preset>>();
    else if (m == "ar_gpr_ik")
      follow_lawnmower(map<ArGprIk<Preset>>(FieldTask::mapping));
    else if (m == "ar_bcm")
      follow_lawnmower(map<ArBcm<Preset>>(FieldTask::mapping));
    else if (m == "lawnmower")
      follow_lawnmower(map<Ours<Preset>>(FieldTask::mapping));
    else
      fly(NbvLoop{map<Ours<Preset>>(FieldTask::planning), Uninformed{}, Lattice{lattice()}, ArgMax{}});
  }

 private:
  template <class MapT>
  void measure() const {
    if (o_.protocol != Protocol::plan) return follow_lawnmower(map<MapT>(FieldTask::mapping));
    fly(NbvLoop{map<MapT>(FieldTask::planning), VarianceReduction{}, Lattice{lattice()}, PerFlightTime{}});
  }
  template <class MapT>
  void follow_lawnmower(MapT map) const {
    // 4 x 4 views side by side at 2.5 m over 20 m, or 9 x 9 at 2 m, each of which sees half of the next one's ground.
    const bool dense = o_.protocol == Protocol::lawnmower81;
    const double footprint_m = (dense ? 0.2 : 0.25) * o_.side_m;
    const double height_m = 0.5 * footprint_m / std::tan(deg(o_.half_angle_deg));
    fly(NbvLoop{std::move(map), Uninformed{}, Survey{input_.truth.area(), dense ? 9 : 4, height_m, footprint_m},
                InOrder{}});
  }

  template <class MapT>
  [[nodiscard]] MapT map(FieldTask task) const {
    typename MapT::Config c = configured<MapT, Preset>(task);
    c.tree = {.area = input_.truth.area(), .branching = 2, .depth = o_.depth()};
    c.sensor.camera = sensor();
    if (o_.alpha) c.sensor.alpha = *o_.alpha;
    return MapT(in_unit_of(input_.truth, c, o_.threshold));
  }

  /// The two layers of section 3.2.3, at a tenth and a quarter of the side (2 m and 5 m over 20 m). Over an area that
  /// is no square the views keep their spacing, and over one narrower than a footprint they fly along its middle.
  [[nodiscard]] Lattice::Config lattice() const {
    const Box2& area = input_.truth.area();
    const Lattice::Config square = std::is_same_v<Preset, preset::thesis> ? Lattice::thesis() : Lattice::reference();
    std::vector<Layer> layers;
    for (const Layer& model : square.layers) {
      const double height_m = model.height_m * o_.side_m / 20, inset_m = height_m * std::tan(deg(o_.half_angle_deg));
      Layer layer{height_m, area, 1, 1};
      for (int axis = 0; axis < 2; ++axis) {
        const double span_m = area.sizes()[axis] - 2 * inset_m,
                     spacing_m = model.bounds.sizes()[axis] * o_.side_m / 20 / ((axis == 0 ? model.nx : model.ny) - 1);
        (axis == 0 ? layer.nx : layer.ny) = 1 + std::max(0, static_cast<int>(std::lround(span_m / spacing_m)));
        layer.bounds.min()[axis] = area.center()[axis] - std::max(0.0, 0.5 * span_m);
        layer.bounds.max()[axis] = area.center()[axis] + std::max(0.0, 0.5 * span_m);
      }
      layers.push_back(layer);
    }
    return {.layers = layers};
  }

  [[nodiscard]] AnyOf<MissionTime, Measurements, Travel> stop() const {
    const auto finite = [](double x) { return std::min(x, std::numeric_limits<double>::max()); };
    return AnyOf{MissionTime{finite(o_.budget_s)}, Measurements{o_.measurements}, Travel{finite(o_.travel_m)}};
  }

  template <class Loop>
  void fly(Loop loop) const {
    MissionClock clock(o_.clock);
    const ScalarField& truth = input_.truth;
    const Judge judge{input_, loop.map.interest().threshold};
    const double alpha = o_.alpha.value_or(FieldPreset<Preset>{}.alpha);
    FieldWorld world(truth, WorldNoise<Preset>{.alpha = alpha}, Rng(o_.seed).fork(1), {.sensor = sensor()});
    MissionState state{.here = nadir(truth.area().min().x(), truth.area().min().y(), 0), .rng = Rng(o_.seed)};

    Recorder recorder(
        RecorderConfig{
            .file = o_.out / "mission.json", .config = config(o_, input_, judge.threshold, alpha), .seed = o_.seed},
        judge);
    Checkpoint checkpoint(CheckpointConfig{.file = o_.out / "mission.checkpoint", .every_s = o_.checkpoint_s},
                          recorder);
    Progress progress(recorder.record(), std::cerr,
                      {.budget_s = o_.budget_s,
                       .budget_steps = o_.measurements,
                       .terminal_fd = STDERR_FILENO,
                       .utf8 = locale_is_utf8()});

    if (o_.resume && checkpoint.load(loop, world, clock, state))
      std::cerr << "resumed after step " << state.visited.size() << '\n';
    loop.resume(world, state, {}, stop(), clock, recorder, progress, checkpoint);
    write_results(o_, input_, Snapshot(loop.map, truth), judge.threshold, recorder.record());
    std::cout << (o_.out / "report.html").string() << '\n';
  }

  [[nodiscard]] NadirSensor sensor() const { return {.half_angle_rad = deg(o_.half_angle_deg), .pixels = o_.pixels}; }

  const Options& o_;
  const Input& input_;
};

// Compiled apart, in mission_thesis.cpp and mission_reference.cpp.
extern template class Mission<preset::thesis>;
extern template class Mission<preset::reference>;

}  // namespace field
