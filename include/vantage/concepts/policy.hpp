// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>

// What a utility, a sampler, a selector and a router must offer.
namespace vantage {

/// The mission as a policy may see it: all the history that a pure policy needs. Refers to the loop's own views.
struct Situation {
  View here = {};                                                ///< where the robot is
  Views visited = {};                                            ///< every view measured so far, oldest first
  double elapsed_s = 0;                                          ///< mission time
  double remaining_s = std::numeric_limits<double>::infinity();  ///< if the stop rule knows
  double travelled_m = 0;
  double best_utility =
      std::numeric_limits<double>::infinity();  ///< of this step's candidates; infinite before planning
  std::uint64_t step = 0;                       ///< measurements taken so far
  Views claimed = {};                           ///< goals of other robots
};

/// Scores views, were the views `given` measured before: writes views.size() finite numbers, larger is better.
template <class P>
concept Scorer = requires(const P p, Views given, Views views, std::span<double> out) {
  p(given, views, out);
};

/// For work that a step's candidates share, and for sequences: prepared once a step, before sampling.
template <class U, class M>
concept PreparedUtility = Map<M> && requires(const U u, const M& m, const Situation& q, Rng rng) {
  { u.prepare(m, q, rng) } -> Scorer;
};
/// Needs the mission's history. Called concurrently.
template <class U, class M>
concept HistoryUtility = Map<M> && requires(const U u, const M& m, const Situation& q, const View& v) {
  { u(m, q, v) } -> std::convertible_to<double>;
};
/// The simplest form, psi(M, v) of section 2.2.1. Called concurrently.
template <class U, class M>
concept ViewUtility = Map<M> && requires(const U u, const M& m, const View& v) {
  { u(m, v) } -> std::convertible_to<double>;
};
template <class U, class M>
concept UtilityFor = PreparedUtility<U, M> || HistoryUtility<U, M> || ViewUtility<U, M>;

/// The step's utility as samplers and selectors see it. Refers to a scorer that outlives it; safe to share.
class Score {
 public:
  template <Scorer F>
  requires(!std::same_as<F, Score>) explicit Score(const F& f)
      : object_(&f), call_([](const void* object, Views given, Views views, std::span<double> out) {
          (*static_cast<const F*>(object))(given, views, out);
        }) {}
  template <Scorer F>
  explicit Score(const F&&) = delete;
  void operator()(Views views, std::span<double> out) const { call_(object_, {}, views, out); }
  void operator()(Views given, Views views, std::span<double> out) const { call_(object_, given, views, out); }

 private:
  const void* object_;
  void (*call_)(const void*, Views, Views, std::span<double>);
};

/// What a sampler proposes; an empty set is legal.
struct Candidates {
  std::vector<View> views = {};
  std::vector<double> utilities = {};  ///< empty, or one per view already paid for
  std::vector<int> parent = {};        ///< empty, or the index of the view before (-1: root), for sequences
};

/// What a selector decides.
struct Decision {
  std::size_t index = 0;        ///< into the candidates
  std::vector<View> path = {};  ///< from here to the chosen view, for the robot; empty: straight
  double travel_s = 0, travel_m = 0;
};

/// Proposes reachable views; randomness only from `rng`; may call `score` to refine them.
template <class S, class M>
concept SamplerFor = Map<M> && requires(S s, const M& m, const Situation& q, const Score& score, Rng& rng) {
  { s.sample(m, q, score, rng) } -> std::same_as<Candidates>;
};
/// Decides, or none = stop. Candidates come with one utility each. Ties go to the lowest index. Travel cost lives here.
template <class S, class M>
concept SelectorFor = Map<M> &&
    requires(S s, const M& m, const Situation& q, const Candidates& c, const Score& score, Rng& rng) {
  { s.select(m, q, c, score, rng) } -> std::same_as<std::optional<Decision>>;
};
/// Shortest paths to many goals at once [m], infinity where there is none; the path to one goal includes both ends.
template <class R, class M>
concept RouterFor = Map<M> && requires(const R r, const M& m, const View& from, Views goals, const View& goal) {
  { r.lengths_m(m, from, goals) } -> std::convertible_to<std::vector<double>>;
  { r.path(m, from, goal) } -> std::convertible_to<std::vector<View>>;
};

}  // namespace vantage
