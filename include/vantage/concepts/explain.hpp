// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <type_traits>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/world.hpp>

// Refusals that name the policy, what is missing and the remedy, before a constrained call can bury them. Each is a
// static_assert of its own: g++ prints the types that led there, clang the condition with its types and why it fails.
namespace vantage {

namespace need {
struct Uncertainty;
struct Depth;
struct Forecast;
struct Field;
struct Coverage;
struct Occupancy;
struct Voxels;
struct Navigable;
struct Fisher;
template <class Kind>
struct Regions;  ///< frontier or low_confidence
template <class... Cs>
struct Channels;  ///< drawn together, by one call
}  // namespace need

/// A policy's statement of what it asks of a map: `using MapNeeds = Needs<need::Uncertainty>;`
template <class... Ns>
struct Needs {};

/// What a policy states, or Needs<> if it states nothing.
template <class Policy>
struct StatedNeeds {
  using type = Needs<>;
};
template <class Policy>
requires requires { typename Policy::MapNeeds; }
struct StatedNeeds<Policy> {
  using type = typename Policy::MapNeeds;
};
template <class...>
struct JoinedNeeds {
  using type = Needs<>;
};
template <class... A>
struct JoinedNeeds<Needs<A...>> {
  using type = Needs<A...>;
};
template <class... A, class... B, class... Rest>
struct JoinedNeeds<Needs<A...>, Needs<B...>, Rest...> : JoinedNeeds<Needs<A..., B...>, Rest...> {};
/// What several policies state together: for policies made of others.
template <class... Policies>
using NeedsOf = typename JoinedNeeds<typename StatedNeeds<Policies>::type...>::type;

/// Whether a map offers what one `need` stands for; specialise it for needs of your own.
template <class M, class Need>
inline constexpr bool offers = false;
template <class M>
inline constexpr bool offers<M, need::Uncertainty> = UncertainMap<M>;
template <class M>
inline constexpr bool offers<M, need::Depth> = DepthMap<M>;
template <class M>
inline constexpr bool offers<M, need::Forecast> = ForecastMap<M>;
template <class M>
inline constexpr bool offers<M, need::Field> = FieldMap<M>;
template <class M>
inline constexpr bool offers<M, need::Coverage> = CoverageMap<M>;
template <class M>
inline constexpr bool offers<M, need::Occupancy> = OccupancyMap<M>;
template <class M>
inline constexpr bool offers<M, need::Voxels> = VoxelOccupancy<M>;
template <class M>
inline constexpr bool offers<M, need::Navigable> = NavigableMap<M>;
template <class M>
inline constexpr bool offers<M, need::Fisher> = FisherMap<M>;
template <class M, class Kind>
inline constexpr bool offers<M, need::Regions<Kind>> = RegionMap<M, Kind>;
template <class M, class... Cs>
inline constexpr bool offers<M, need::Channels<Cs...>> = Renders<M, Cs...>;

template <class N>
inline constexpr bool is_channels = false;
template <class... Cs>
inline constexpr bool is_channels<need::Channels<Cs...>> = true;

/// The Map concept piece by piece, so that a refusal says which piece is missing.
template <class M>
concept HasMeasurement = requires {
  typename M::Measurement;
};
template <class M>
concept HasIntegrate = requires(M m, const typename M::Measurement& z, Rng& rng) {
  m.integrate(z, rng);
};
template <class M>
concept HasBounds = requires(const M m) {
  { m.bounds() } -> std::convertible_to<Box3>;
};

/// Refuses, by static_assert, a class that is no map.
template <class M>
struct ExplainMap {
  static consteval bool check() {
    static_assert(std::movable<M>,
                  "vantage: this map cannot be moved into the loop: give it a move constructor and a move assignment");
    static_assert(HasMeasurement<M>,
                  "vantage: this map does not say what it learns from: give it `using Measurement = ...`, the type its "
                  "world observes");
    if constexpr (HasMeasurement<M>)
      static_assert(HasIntegrate<M>,
                    "vantage: this map does not learn: give it `void integrate(const Measurement&, Rng&)`");
    static_assert(HasBounds<M>, "vantage: this map does not say where it is: give it `Box3 bounds() const`");
    return Map<M>;
  }
};

/// Refuses, by static_assert, a policy that needs what the map has not. The instantiation names map and policy.
template <class M, class Policy>
struct Explain {
  template <class N>
  static consteval bool has() {
    if constexpr (std::is_same_v<N, need::Uncertainty>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs an UncertainMap: give the map `void render(const View&, const Camera&, "
                    "Rendering<channel::Uncertainty>&) const`");
    else if constexpr (std::is_same_v<N, need::Depth>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a DepthMap: give the map `void render(const View&, const Camera&, "
                    "Rendering<channel::Depth>&) const`");
    else if constexpr (std::is_same_v<N, need::Forecast>)
      static_assert(
          offers<M, N>,
          "vantage: this policy needs a ForecastMap: give the map `void forecast(Views given, Views views, "
          "std::span<double> reduction) const`, or choose a utility that does not forecast, such as MeanUncertainty");
    else if constexpr (std::is_same_v<N, need::Field>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a FieldMap: give the map size(), cell(i), mean(i), variance(i) and "
                    "cell_at(point), or use an IntegralGp");
    else if constexpr (std::is_same_v<N, need::Coverage>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a CoverageMap: give the map `double coverage() const`, or stop by "
                    "MissionTime or Measurements");
    else if constexpr (std::is_same_v<N, need::Occupancy>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs an OccupancyMap: give the map `Space at(const Eigen::Vector3d&) "
                    "const`, or pair it with a VoxelMap");
    else if constexpr (std::is_same_v<N, need::Voxels>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a VoxelOccupancy: give the map grid(), state(voxel), known_blocks(), "
                    "free_in(block), occupied_in(block) and unexplored_in(block), or pair it with a VoxelMap");
    else if constexpr (std::is_same_v<N, need::Navigable>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a NavigableMap: give the map, besides what VoxelOccupancy asks, "
                    "clearance_m(), navigable(voxel) and navigable_in(block), or pair it with a VoxelMap");
    else if constexpr (std::is_same_v<N, need::Fisher>)
      static_assert(offers<M, N>,
                    "vantage: this policy needs a FisherMap: give the map parameters() and `void fisher(const View&, "
                    "const Camera&, std::span<double>) const`");
    else if constexpr (std::is_same_v<N, need::Regions<frontier>> || std::is_same_v<N, need::Regions<low_confidence>>)
      static_assert(
          offers<M, N>,
          "vantage: this policy needs a RegionMap: give the map `std::vector<Region> regions(Kind) const` for this "
          "kind (frontier or low_confidence) and `Space at(const Eigen::Vector3d&) const`, or pair it with a VoxelMap");
    else if constexpr (is_channels<N>)
      static_assert(
          offers<M, N>,
          "vantage: this policy needs a map that draws the channels of this need::Channels<...>: give the map "
          "`void render(const View&, const Camera&, Rendering<...>&) const` for them");
    else
      static_assert(offers<M, N>,
                    "vantage: this policy needs what the map does not offer: specialise vantage::offers<Map, Need> "
                    "where it does");
    return offers<M, N>;
  }
  template <class... Ns>
  static consteval bool all(std::type_identity<Needs<Ns...>>) {
    return (has<Ns>() && ... && true);
  }
  /// A selector that plans with a router names it: `using RouterType = ...`.
  static consteval bool routes() {
    if constexpr (requires { typename Policy::RouterType; }) {
      static_assert(RouterFor<typename Policy::RouterType, M>,
                    "vantage: RouterType finds no way on this map: give the router `std::vector<double> "
                    "lengths_m(const MapT&, const View& from, Views goals) const` and `std::vector<View> path(const "
                    "MapT&, const View& from, const View& goal) const`, or take StraightLine");
      return RouterFor<typename Policy::RouterType, M>;
    }
    return true;
  }
  static consteval bool check() { return all(std::type_identity<NeedsOf<Policy>>{}) && routes(); }
};

/// Refuses, by static_assert, the four policies that make no loop; each only after those that it depends on.
template <class M, class U, class Sa, class Se>
struct ExplainLoop {
  static consteval bool check() {
    if constexpr (!Map<M>)
      return ExplainMap<M>::check();
    else if constexpr (!(Explain<M, U>::check() && Explain<M, Sa>::check() && Explain<M, Se>::check()))
      return false;
    else {
      static_assert(
          UtilityFor<U, M>,
          "vantage: UtilityT scores no view of this map: give it `double operator()(const MapT&, const View&) const`, "
          "the same with `const Situation&` in between, or `auto prepare(const MapT&, const Situation&, Rng) const`");
      static_assert(SamplerFor<Sa, M>,
                    "vantage: SamplerT proposes no views: give it `Candidates sample(const MapT&, const Situation&, "
                    "const Score&, Rng&)`");
      static_assert(SelectorFor<Se, M>,
                    "vantage: SelectorT decides nothing: give it `std::optional<Decision> select(const MapT&, const "
                    "Situation&, const Candidates&, const Score&, Rng&)`");
      return UtilityFor<U, M> && SamplerFor<Sa, M> && SelectorFor<Se, M>;
    }
  }
};

/// Refuses, by static_assert, the world, the stop rule or the clock that a loop over this map cannot run with.
template <class M, class World, class Stop, class Clock>
struct ExplainRun {
  static consteval bool check() {
    static_assert(WorldFor<World, M>,
                  "vantage: the world measures nothing for this map: give it `std::optional<Measurement> observe(const "
                  "View&)` with the map's Measurement");
    if constexpr (Explain<M, Stop>::check())
      static_assert(StopRuleFor<Stop, M>,
                    "vantage: the stop rule does not say when: give it `bool operator()(const MapT&, const Situation&) "
                    "const`, or take MissionTime or Measurements");
    static_assert(ClockLike<Clock>,
                  "vantage: the clock tells no mission time: give it `double elapsed_s() const`, begin(), mapped(), "
                  "planned() and travelled(double s), or take MeasuredClock or ModelledClock");
    return WorldFor<World, M> && StopRuleFor<Stop, M> && ClockLike<Clock>;
  }
};

/// The same questions without an error, for SFINAE.
template <class M, class Policy>
inline constexpr bool needs_met = []<class... Ns>(std::type_identity<Needs<Ns...>>) {
  return (offers<M, Ns> && ... && true);
}(std::type_identity<NeedsOf<Policy>>{});

/// Whether the four policies make a loop.
template <class M, class U, class Sa, class Se>
concept Composable = Map<M> && needs_met<M, U> && needs_met<M, Sa> && needs_met<M, Se> && UtilityFor<U, M> &&
    SamplerFor<Sa, M> && SelectorFor<Se, M>;

}  // namespace vantage
