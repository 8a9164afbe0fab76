// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/world.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/loop/mission_state.hpp>

namespace vantage {

/// Where to look next, and what it was chosen from.
struct Plan {
  View view;
  Decision decision;
  double utility = 0;       ///< of the chosen view
  double best_utility = 0;  ///< of all candidates
  std::size_t candidates = 0;
};

enum class StopReason { stop_rule, nothing_to_do, world_ended };

/// One measurement of a mission, as observers see it.
template <class Measurement>
struct Step {
  std::uint64_t index = 0;  ///< 1 = the first measurement
  const Measurement& measurement;
  const Plan* plan = nullptr;                          ///< null for the first, unplanned views
  double planning_s = 0, mapping_s = 0, action_s = 0;  ///< by the mission's clock
};

/// The loop of active perception: map, utility, sampler and selector, each a policy checked by a concept, composed at
/// compile time and deduced from the constructor's arguments.
///
///     vantage::NbvLoop loop{map, VarianceReduction{}, Lattice{...}, PerFlightTime{}};
///     loop.run(world, start, first_views, MissionTime{300}, MeasuredClock{}, Rng{7});
///
/// Members are public: they are the user's policies. Not shared between threads; inside, candidates are scored
/// concurrently. The loop itself allocates what a step by hand would: one vector of utilities.
template <class MapT, class UtilityT, class SamplerT, class SelectorT>
class NbvLoop {
  static_assert(ExplainLoop<MapT, UtilityT, SamplerT, SelectorT>::check());

 public:
  using MapType = MapT;
  MapT map;
  UtilityT utility;
  SamplerT sampler;
  SelectorT selector;

  NbvLoop(MapT m, UtilityT u, SamplerT s, SelectorT c)
      : map(std::move(m)), utility(std::move(u)), sampler(std::move(s)), selector(std::move(c)) {}

  /// Where to look next (eq. 2.19), or none when nothing is worth going to. A robot may call this and map.integrate()
  /// in its own rhythm. Throws Error if a policy breaks its promise (a utility that is not finite, a decision for a
  /// candidate that does not exist), or for a situation at no rigid, finite pose; the map is not changed.
  std::optional<Plan> plan(const Situation& q, Rng& rng) {
    check_view(q.here, "NbvLoop::plan (here)");
    const auto scorer = scorer_for(q, rng);
    const Score score(scorer);
    Candidates c = sampler.sample(std::as_const(map), q, score, rng);
    if (c.views.empty()) return std::nullopt;
    if (c.utilities.empty()) {
      c.utilities.resize(c.views.size());
      score(c.views, c.utilities);
    }
    if (c.utilities.size() != c.views.size())
      throw Error("NbvLoop::plan", concat(c.utilities.size(), " utilities"), concat(c.views.size(), ", one per view"));
    for (std::size_t i = 0; i < c.utilities.size(); ++i)
      if (!std::isfinite(c.utilities[i]))
        throw Error("NbvLoop::plan", concat("the utility of candidate ", i, " is ", c.utilities[i]), "a finite number");
    std::optional<Decision> d = selector.select(std::as_const(map), q, std::as_const(c), score, rng);
    if (!d) return std::nullopt;
    if (d->index >= c.views.size())
      throw Error("NbvLoop::plan", concat("the selector chose candidate ", d->index), concat("below ", c.views.size()));
    const std::size_t i = d->index;
    return Plan{.view = c.views[i],
                .decision = *std::move(d),
                .utility = c.utilities[i],
                .best_utility = *std::max_element(c.utilities.begin(), c.utilities.end()),
                .candidates = c.views.size()};
  }

  /// Measures `first` unplanned (none: plans on the prior), then plans and measures until the stop rule holds, until
  /// there is nowhere to go, or until the world ends. Observers may have any of `started(map, situation)`,
  /// `departed(map, decision, rng)` (when the robot sets out; this one may train the map, see RefineInFlight),
  /// `measured(map, situation, step)`, `completed(loop, world, clock, state)` (after every measurement: all that is
  /// needed to go on later) and `finished(map, situation, reason)`; the missing ones cost nothing.
  ///
  /// A measurement that the map refuses ends the mission with the map's Error, unless an observer has
  /// `refused(map, situation, error)`, see SkipRefused: then the map stays as it was, the view counts as visited, and
  /// the mission goes on from there.
  template <class W, class Stop, class C, class... Observers>
  MissionState run(W& world, const View& start, Views first, const Stop& stop, C&& clock, Rng rng,
                   Observers&&... observers) {
    check_view(start, "NbvLoop::run (start)");
    MissionState state{.here = start, .rng = rng};
    resume(world, state, first, stop, clock, observers...);
    return state;
  }

  /// Goes on from `state`: with the map, the policies, the clock and the world as they were then, the mission ends in
  /// the same bytes as without the interruption.
  template <class W, class Stop, class C, class... Observers>
  StopReason resume(W& world, MissionState& state, Views first, const Stop& stop, C& clock, Observers&&... observers) {
    static_assert(ExplainRun<MapT, W, Stop, C>::check());
    const auto situation = [&] {
      Situation q{.here = state.here,
                  .visited = state.visited,
                  .elapsed_s = clock.elapsed_s(),
                  .travelled_m = state.travelled_m,
                  .step = state.visited.size()};
      if constexpr (requires { stop.remaining_s(q); }) q.remaining_s = stop.remaining_s(q);
      return q;
    };
    if (state.visited.empty()) (tell_started(observers, situation()), ...);
    StopReason reason = StopReason::stop_rule;
    for (;;) {
      const std::uint64_t step = state.visited.size();
      std::optional<Plan> plan_made;
      View goal;
      double planning_s = 0, action_s = 0;
      if (step < first.size()) {
        goal = first[step];
      } else {
        Situation q = situation();
        if (stop(std::as_const(map), q)) break;
        Rng planning_rng = state.rng.fork(2 * step);
        clock.begin();
        plan_made = plan(q, planning_rng);
        clock.planned();
        planning_s = clock.elapsed_s() - q.elapsed_s;
        if (!plan_made) {
          reason = StopReason::nothing_to_do;
          break;
        }
        q = situation();
        q.best_utility = plan_made->best_utility;
        if (stop(std::as_const(map), q)) break;
        goal = plan_made->view;
        const Decision& d = plan_made->decision;
        (tell_departed(observers, d, planning_rng), ...);
        if constexpr (requires { world.follow(d.path); }) world.follow(d.path);
        clock.travelled(d.travel_s);
        action_s = d.travel_s;
        state.travelled_m += d.travel_m;
      }
      const std::optional<typename MapT::Measurement> z = world.observe(goal);
      if (!z) {
        reason = StopReason::world_ended;
        break;
      }
      Rng mapping_rng = state.rng.fork(2 * step + 1);
      const double before_s = clock.elapsed_s();
      clock.begin();
      const std::optional<Error> refusal = integrate<Observers...>(*z, mapping_rng);
      clock.mapped();
      state.here = goal;
      if constexpr (Posed<typename MapT::Measurement>)
        if (!refusal) state.here = z->view;
      state.visited.push_back(state.here);
      if (refusal) {
        (tell_refused(observers, situation(), *refusal), ...);
        (tell_completed(observers, world, clock, state), ...);
        continue;
      }
      [[maybe_unused]] const Step<typename MapT::Measurement> done{.index = step + 1,
                                                                   .measurement = *z,
                                                                   .plan = plan_made ? &*plan_made : nullptr,
                                                                   .planning_s = planning_s,
                                                                   .mapping_s = clock.elapsed_s() - before_s,
                                                                   .action_s = action_s};
      (tell_measured(observers, situation(), done), ...);
      (tell_completed(observers, world, clock, state), ...);
    }
    (tell_finished(observers, situation(), reason), ...);
    return reason;
  }

 private:
  // The per-view forms become scorers here, and run the views concurrently.
  auto scorer_for(const Situation& q, const Rng& rng) const {
    if constexpr (PreparedUtility<UtilityT, MapT>)
      return utility.prepare(map, q, rng.fork(0));
    else if constexpr (HistoryUtility<UtilityT, MapT>)
      return [this, &q](Views, Views views, std::span<double> out) {
        parallel_for(views.size(), [&](std::size_t i) { out[i] = static_cast<double>(utility(map, q, views[i])); });
      };
    else
      return [this](Views, Views views, std::span<double> out) {
        parallel_for(views.size(), [&](std::size_t i) { out[i] = static_cast<double>(utility(map, views[i])); });
      };
  }

  template <class O>
  static constexpr bool hears_refusals = requires(O& o, const MapT& m, const Situation& q, const Error& e) {
    o.refused(m, q, e);
  };

  // The Error of a measurement that is refused, if somebody hears of it.
  template <class... Observers>
  std::optional<Error> integrate(const typename MapT::Measurement& z, Rng& rng) {
    if constexpr ((hears_refusals<Observers> || ...)) {
      try {
        map.integrate(z, rng);
      } catch (const Error& e) { return e; }
    } else {
      map.integrate(z, rng);
    }
    return std::nullopt;
  }

  template <class O>
  void tell_refused(O& o, const Situation& q, const Error& e) const {
    if constexpr (hears_refusals<O>) o.refused(map, q, e);
  }
  template <class O>
  void tell_started(O& o, const Situation& q) const {
    if constexpr (requires { o.started(map, q); }) o.started(map, q);
  }
  template <class O>
  void tell_departed(O& o, const Decision& decision, const Rng& rng) {
    if constexpr (requires(Rng & own) { o.departed(map, decision, own); }) {
      Rng own = rng.fork(1);
      o.departed(map, decision, own);
    }
  }
  template <class O, class S>
  void tell_measured(O& o, const Situation& q, const S& step) const {
    if constexpr (requires { o.measured(map, q, step); }) o.measured(map, q, step);
  }
  template <class O, class W, class C>
  void tell_completed(O& o, const W& world, const C& clock, const MissionState& state) const {
    if constexpr (requires { o.completed(*this, world, clock, state); }) o.completed(*this, world, clock, state);
  }
  template <class O>
  void tell_finished(O& o, const Situation& q, StopReason reason) const {
    if constexpr (requires { o.finished(map, q, reason); }) o.finished(map, q, reason);
  }
};

}  // namespace vantage
