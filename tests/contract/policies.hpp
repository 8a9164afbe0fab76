// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/shortcut.hpp>
#include <vantage/planning/straight_line.hpp>
#include <vantage/sampler/all_around.hpp>
#include <vantage/sampler/fallback.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/sampler/hemisphere.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/sampler/lawnmower.hpp>
#include <vantage/sampler/level.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/roi_and_local.hpp>
#include <vantage/sampler/spiral.hpp>
#include <vantage/sampler/utility_weighted.hpp>
#include <vantage/sampler/view_tree.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/first_of_branch.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/confidence_exploration.hpp>
#include <vantage/utility/fisher_information.hpp>
#include <vantage/utility/information_gain.hpp>
#include <vantage/utility/mean_uncertainty.hpp>
#include <vantage/utility/ray_entropy.hpp>
#include <vantage/utility/unexplored.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/unseen_sides.hpp>
#include <vantage/utility/variance_reduction.hpp>
#include <vantage/utility/view_distance.hpp>

#include "lists.hpp"

// Every model of every policy concept, and how to make one. A new policy is one line in a list, and one in `make` if it
// has no default; the contract suites, the matrix and the static product follow.
namespace vantage::test {

using Utilities =
    List<VarianceReduction, MeanUncertainty, ViewDistance<Nearest>, ViewDistance<Mean>, ViewDistance<Sum>, Uninformed,
         Unexplored, UnseenSides, RayEntropy, InformationGain, ConfidenceExploration<>, FisherInformation,
         archetype::ViewUtility, archetype::HistoryUtility, archetype::PreparedUtility>;
using Samplers = List<Lattice, Lawnmower, Hemisphere, Spiral, Pool, Local, Frontier, RoiAndLocal<frontier>,
                      RoiAndLocal<frontier, low_confidence>, ViewTree, UtilityWeighted<Lattice>, Level<Frontier>,
                      AllAround, Fallback<Frontier, AllAround>, archetype::Sampler>;
using Selectors = List<ArgMax, InOrder, FirstOfBranch, PerFlightTime, MinusCost<>, TravelTradeoff<>,
                       MinusCost<archetype::Router>, archetype::Selector>;
using Routers = List<StraightLine, AStar, Shortcut<AStar>, archetype::Router>;
using StopRules = List<MissionTime, Measurements, Travel, CoverageReached, UtilityBelow,
                       AnyOf<MissionTime, CoverageReached>, archetype::StopRule>;
using Clocks = List<MeasuredClock, ModelledClock, WallClock, archetype::Clock>;

template <class P>
P make() {
  const Box2 field = Lattice::field_20m();
  if constexpr (std::same_as<P, MeanUncertainty> || std::same_as<P, RayEntropy> || std::same_as<P, InformationGain>)
    return P(Camera::from_fov(8, 6, deg(60)));
  else if constexpr (std::same_as<P, Unexplored> || std::same_as<P, UnseenSides> ||
                     std::same_as<P, ConfidenceExploration<>> || std::same_as<P, FisherInformation>)
    return P({.camera = Camera::from_fov(16, 12, deg(60))});
  else if constexpr (std::same_as<P, Lattice>)
    return Lattice({.layers = {Layer::inside(field, 2, 5, 4), Layer::inside(field, 5, 2, 3)}});
  else if constexpr (std::same_as<P, Lawnmower>)
    return Lawnmower({.area = field});
  else if constexpr (std::same_as<P, Hemisphere>)
    return Hemisphere({.centre = {10, 10, 0}, .radius_m = 3, .candidates = 10});
  else if constexpr (std::same_as<P, Spiral>)
    return Spiral({.centre = {10, 10, 0}, .radius_m = 3});
  else if constexpr (std::same_as<P, Pool>)
    return Pool({nadir(2.5, 2.5, 2.5), nadir(10, 10, 2), nadir(17.5, 3, 5), nadir(19.9, 19.9, 1), nadir(40, 40, 2)});
  else if constexpr (std::same_as<P, Frontier>)
    return Frontier({.smallest_m2 = 0});
  else if constexpr (std::same_as<P, Level<Frontier>>)
    return Level(make<Frontier>());
  else if constexpr (std::same_as<P, AllAround>)
    return AllAround({.places = 3, .field_of_view_rad = deg(120)});
  else if constexpr (std::same_as<P, Fallback<Frontier, AllAround>>)
    return Fallback(make<Frontier>(), make<AllAround>(), {.least = 2});
  else if constexpr (std::same_as<P, UtilityWeighted<Lattice>>)
    return UtilityWeighted(make<Lattice>());
  else if constexpr (std::same_as<P, MissionTime>)
    return MissionTime(300);
  else if constexpr (std::same_as<P, Measurements>)
    return Measurements(10);
  else if constexpr (std::same_as<P, Travel>)
    return Travel(100);
  else if constexpr (std::same_as<P, CoverageReached>)
    return CoverageReached(0.9);
  else if constexpr (std::same_as<P, UtilityBelow>)
    return UtilityBelow(0.5);
  else if constexpr (std::same_as<P, AnyOf<MissionTime, CoverageReached>>)
    return AnyOf{MissionTime(300), CoverageReached(0.9)};
  else
    return P{};
}

/// Where a sampler's robot is: above the field, or, if the sampler asks where it fits, inside of the archetypes' box.
template <class Sampler>
View start_of() {
  return needs_met<archetype::Map, Sampler> ? nadir(10, 10, 3) : nadir(-0.5, 0.1, 0.9);
}

/// Whether all that a sampler proposes looks straight down, as the field maps' sensor must.
template <class Sampler>
inline constexpr bool looks_down = !std::same_as<Sampler, Hemisphere> && !std::same_as<Sampler, Spiral>;

}  // namespace vantage::test
