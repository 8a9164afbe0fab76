// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/mission/record.hpp>
#include <vantage/planning/collision.hpp>

#include "floor_plan.hpp"
#include "fused_map.hpp"
#include "input.hpp"

namespace scene {

/// Observer of an exploration that knows the truth: fuses what was measured, checks every path that was flown against
/// the scene's triangles, and keeps how the map grew. What it does is not counted as mission time. Persistent but for
/// what it saw, which it can be shown again.
class Referee {
 public:
  Referee(const Input& input, const Options& o)
      : fused_(around(input.bounds, o.voxel_m), input.unseen(o)),
        robot_(CollisionScene(input.scene->mesh), shape::Sphere{o.body_radius_m}),
        low_m_(input.bounds.min().z() + 0.2),
        high_m_(input.bounds.max().z() - 0.4) {}

  template <VoxelOccupancy M>
  void measured(const M& map, const Situation&, const Step<Frame>& step) {
    const View from = here_;
    saw(step.index, step.measurement);
    clearance_m_ = std::numeric_limits<double>::quiet_NaN();
    if (step.plan != nullptr) {
      std::vector<View> path = step.plan->decision.path;
      if (path.empty()) path = {from, step.plan->view};
      const PathCheck check = robot_.check(path);
      clearance_m_ = check.clearance_m;
      collisions_ += check.free() ? 0 : 1;
      paths_.push_back(std::move(path));
    }
    growth_.push_back({step.index, FloorPlan(map, low_m_, high_m_)});
  }
  /// What a measurement shows, whatever led there.
  void saw(std::uint64_t, const Frame& frame) {
    Rng unused;
    fused_.integrate(frame, unused);
    here_ = frame.view;
  }

  /// What is known of the mission but not by the robot: for the recorder, after `measured`.
  template <CoverageMap M>
  [[nodiscard]] std::vector<Metric> metrics(const M& map) const {
    return {{"coverage", fused_.truth()->share()},
            {"explored", map.coverage()},
            {"clearance_m", clearance_m_},
            {"collisions", static_cast<double>(collisions_)},
            {"megabytes", static_cast<double>(map.bytes()) / 1e6}};
  }

  void save(Sink& sink) const {
    sink.put(collisions_);
    sink.put(static_cast<std::uint64_t>(paths_.size()));
    for (const std::vector<View>& path : paths_) save_views(sink, path);
    sink.put(static_cast<std::uint64_t>(growth_.size()));
    for (const Growth& g : growth_) {
      sink.put(g.step);
      g.plan.save(sink);
    }
  }
  void load(Source& source) {
    const auto collisions = source.get<std::uint64_t>();
    std::vector<std::vector<View>> paths;
    for (auto n = source.get<std::uint64_t>(); n > 0; --n) paths.push_back(load_views(source));
    std::vector<Growth> growth;
    for (auto n = source.get<std::uint64_t>(); n > 0; --n) {
      Growth& g = growth.emplace_back();
      source.get(g.step);
      g.plan.load(source);
    }
    collisions_ = collisions;
    paths_ = std::move(paths);
    growth_ = std::move(growth);
  }

  struct Growth {
    std::uint64_t step = 0;
    FloorPlan plan = {};
  };
  [[nodiscard]] const FusedMap& fused() const { return fused_; }
  [[nodiscard]] const std::vector<std::vector<View>>& paths() const { return paths_; }
  [[nodiscard]] const std::vector<Growth>& growth() const { return growth_; }
  [[nodiscard]] std::uint64_t collisions() const { return collisions_; }

 private:
  FusedMap fused_;
  CollisionChecker robot_;
  double low_m_, high_m_, clearance_m_ = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t collisions_ = 0;
  View here_;
  std::vector<std::vector<View>> paths_;
  std::vector<Growth> growth_;
};

}  // namespace scene
