// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/sampler/view_tree.hpp>

#include "../contract/maps.hpp"
#include "../contract/policies.hpp"

// What composes and what must not: the concepts over the full product of maps, utilities, samplers and selectors.
namespace vantage::test {
namespace {

/// For each model of the product: the four compose exactly if the map offers what the four need.
template <class M, class U, class Sa, class Se>
constexpr bool as_stated = Composable<M, U, Sa, Se> == (needs_met<M, U> && needs_met<M, Sa> && needs_met<M, Se>);
template <class M, class U, class Sa, class... Ses>
constexpr bool selectors(List<Ses...>) {
  return (as_stated<M, U, Sa, Ses> && ...);
}
template <class M, class U, class... Sas>
constexpr bool samplers(List<Sas...>) {
  return (selectors<M, U, Sas>(Selectors{}) && ...);
}
template <class M, class... Us>
constexpr bool utilities(List<Us...>) {
  return (samplers<M, Us>(Samplers{}) && ...);
}
template <class... Ms>
constexpr bool product(List<Ms...>) {
  return (utilities<Ms>(Utilities{}) && ...);
}
static_assert(product(Maps{}));

// Some of it by hand, so that the above is no tautology.
template <class M, class U>
constexpr bool plans = Composable<M, U, Lattice, ArgMax>;
static_assert(plans<archetype::Map, Uninformed> && plans<archetype::Map, ViewDistance<Sum>>);
static_assert(!plans<archetype::Map, MeanUncertainty> && !plans<archetype::Map, VarianceReduction>);
static_assert(plans<archetype::Uncertain<>, MeanUncertainty> && !plans<archetype::Uncertain<>, VarianceReduction>);
static_assert(plans<archetype::Forecasting<>, VarianceReduction> && !plans<archetype::Forecasting<>, MeanUncertainty>);
static_assert(plans<OursMap, MeanUncertainty> && plans<OursMap, VarianceReduction> && plans<OursMap, Uninformed>);
static_assert(plans<archetype::Informative<>, RayEntropy> && plans<archetype::Informative<>, InformationGain>);
static_assert(!plans<archetype::Uncertain<>, RayEntropy> && !plans<archetype::Uncertain<>, InformationGain>);
static_assert(plans<archetype::Occupied<archetype::Ranging<>>, Unexplored> && plans<archetype::FullMap, Unexplored> &&
              !plans<archetype::Occupied<>, Unexplored> && !plans<archetype::Ranging<>, Unexplored>);
static_assert(plans<archetype::Occupied<archetype::Confident<>>, ConfidenceExploration<>> &&
              !plans<archetype::Occupied<archetype::Ranging<>>, ConfidenceExploration<>>);
static_assert(plans<archetype::Fisher<>, FisherInformation> && !plans<archetype::Map, FisherInformation>);
static_assert(plans<CarryMap, MeanUncertainty> && plans<CarryMap, VarianceReduction>);

// A policy whose own form is wrong composes with nothing, and does not break the question.
struct NoUtility {
  double operator()(const Eigen::Vector3d&) const;
};
struct MutableUtility {
  template <Map M>
  double operator()(const M&, const View&);
};
struct NoSampler {
  std::vector<View> sample(const archetype::Map&, const Situation&, const Score&, Rng&);
};
struct NoSelector {
  Decision select(const archetype::Map&, const Situation&, const Candidates&, const Score&, Rng&);
};
struct NoRouter {};
struct NeedyRouter : StraightLine {
  using MapNeeds = Needs<need::Occupancy>;
};
static_assert(!plans<archetype::Map, NoUtility> && !plans<archetype::Map, MutableUtility> && !plans<int, Uninformed>);
static_assert(!Composable<archetype::Map, Uninformed, NoSampler, ArgMax>);
static_assert(!Composable<archetype::Map, Uninformed, Lattice, NoSelector>);
static_assert(!Composable<archetype::Map, Uninformed, Lattice, MinusCost<NoRouter>>);
static_assert(!Composable<archetype::Map, Uninformed, Lattice, TravelTradeoff<NeedyRouter>>);
static_assert(Composable<archetype::Occupied<>, Uninformed, Lattice, TravelTradeoff<NeedyRouter>>);

// A map that no policy wrote for: concrete parameter types count as well as templates.
struct OnlyForField {
  double operator()(const archetype::Field<>& map, const View&) const { return map.variance(0); }
};
static_assert(plans<archetype::Field<>, OnlyForField> && !plans<archetype::Map, OnlyForField>);

// The three forms of a utility are told apart.
static_assert(ViewUtility<archetype::ViewUtility, archetype::Map> &&
              !HistoryUtility<archetype::ViewUtility, archetype::Map>);
static_assert(HistoryUtility<archetype::HistoryUtility, archetype::Map> &&
              !ViewUtility<archetype::HistoryUtility, archetype::Map>);
static_assert(PreparedUtility<archetype::PreparedUtility, archetype::Map> &&
              !ViewUtility<archetype::PreparedUtility, archetype::Map>);

// Stop rules, clocks, worlds and routers.
static_assert(StopRuleFor<MissionTime, archetype::Map> && !StopRuleFor<CoverageReached, archetype::Map>);
static_assert(StopRuleFor<CoverageReached, OursMap> && !StopRuleFor<double, archetype::Map>);
static_assert(StopRuleFor<AnyOf<MissionTime, UtilityBelow>, archetype::Map>);
static_assert(!StopRuleFor<AnyOf<MissionTime, CoverageReached>, archetype::Map>);
static_assert(ClockLike<MeasuredClock> && ClockLike<ModelledClock> && ClockLike<WallClock> &&
              ClockLike<archetype::Clock> && !ClockLike<double>);
static_assert(WorldFor<archetype::World, archetype::Map> && !WorldFor<archetype::World, OursMap> &&
              WorldFor<WavyWorld, OursMap>);
static_assert(RouterFor<StraightLine, archetype::Map> && RouterFor<archetype::Router, OursMap> &&
              !RouterFor<NoRouter, archetype::Map>);

static_assert(RouterFor<AStar, archetype::Navigable<>> && RouterFor<Shortcut<AStar>, archetype::FullMap> &&
              !RouterFor<AStar, archetype::Voxelled<>> && !RouterFor<Shortcut<AStar>, archetype::Map>);
static_assert(Composable<archetype::Navigable<>, Uninformed, Lattice, TravelTradeoff<AStar>> &&
              !Composable<archetype::Occupied<>, Uninformed, Lattice, TravelTradeoff<AStar>> &&
              !Composable<OursMap, Uninformed, Lattice, MinusCost<Shortcut<AStar>>>);
static_assert(Composable<archetype::Navigable<>, Uninformed, ViewTree, FirstOfBranch> &&
              !Composable<archetype::Voxelled<>, Uninformed, ViewTree, FirstOfBranch>);

// The loop deduces its four policies.
static_assert(std::is_same_v<decltype(NbvLoop{archetype::Map{}, Uninformed{}, Spiral{}, MinusCost{}}),
                             NbvLoop<archetype::Map, Uninformed, Spiral, MinusCost<StraightLine>>>);

}  // namespace
}  // namespace vantage::test
