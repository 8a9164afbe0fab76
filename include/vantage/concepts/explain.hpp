// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <type_traits>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>

// Refusals that name the policy, what is missing and the remedy, before a constrained call can bury them.
namespace vantage {

namespace need {
struct Uncertainty;
struct Depth;
struct Forecast;
struct Field;
struct Coverage;
struct Occupancy;
struct Fisher;
}  // namespace need

/// A policy's statement of what it asks of a map: `using MapNeeds = Needs<need::Uncertainty>;`
template <class... Ns>
struct Needs {};

/// Whether a map offers what one `need` stands for; specialise it for needs of your own.
template <class M, class Need>
inline constexpr bool offers = false;
template <class M> inline constexpr bool offers<M, need::Uncertainty> = UncertainMap<M>;
template <class M> inline constexpr bool offers<M, need::Depth> = DepthMap<M>;
template <class M> inline constexpr bool offers<M, need::Forecast> = ForecastMap<M>;
template <class M> inline constexpr bool offers<M, need::Field> = FieldMap<M>;
template <class M> inline constexpr bool offers<M, need::Coverage> = CoverageMap<M>;
template <class M> inline constexpr bool offers<M, need::Occupancy> = OccupancyMap<M>;
template <class M> inline constexpr bool offers<M, need::Fisher> = FisherMap<M>;

/// Refuses, by static_assert, a policy that needs what the map has not. The instantiation names map and policy.
template <class M, class Policy>
struct Explain {
  template <class N>
  static consteval bool has() {
    constexpr bool ok = offers<M, N>;
    if constexpr (std::is_same_v<N, need::Uncertainty>)
      static_assert(ok, "vantage: this policy needs an UncertainMap: give the map `void render(const View&, const Camera&, Rendering<channel::Uncertainty>&) const`");
    else if constexpr (std::is_same_v<N, need::Depth>)
      static_assert(ok, "vantage: this policy needs a DepthMap: give the map `void render(const View&, const Camera&, Rendering<channel::Depth>&) const`");
    else if constexpr (std::is_same_v<N, need::Forecast>)
      static_assert(ok, "vantage: this policy needs a ForecastMap: give the map `void forecast(Views given, Views views, std::span<double> reduction) const`, or choose a utility that does not forecast, such as MeanUncertainty");
    else if constexpr (std::is_same_v<N, need::Field>)
      static_assert(ok, "vantage: this policy needs a FieldMap: give the map size(), cell(i), mean(i), variance(i) and cell_at(point), or use an IntegralGp");
    else if constexpr (std::is_same_v<N, need::Coverage>)
      static_assert(ok, "vantage: this policy needs a CoverageMap: give the map `double coverage() const`, or stop by MissionTime or Measurements");
    else if constexpr (std::is_same_v<N, need::Occupancy>)
      static_assert(ok, "vantage: this policy needs an OccupancyMap: give the map `Space at(const Eigen::Vector3d&) const`, or pair it with a VoxelMap");
    else if constexpr (std::is_same_v<N, need::Fisher>)
      static_assert(ok, "vantage: this policy needs a FisherMap: give the map parameters() and `void fisher(const View&, const Camera&, std::span<double>) const`");
    else
      static_assert(ok, "vantage: this policy needs what the map does not offer: specialise vantage::offers<Map, Need> where it does");
    return ok;
  }
  template <class... Ns>
  static consteval bool all(std::type_identity<Needs<Ns...>>) { return (has<Ns>() && ... && true); }
  static consteval bool check() {
    if constexpr (requires { typename Policy::MapNeeds; }) return all(std::type_identity<typename Policy::MapNeeds>{});
    return true;
  }
};

/// The same question without an error, for SFINAE.
template <class M, class Policy>
inline constexpr bool needs_met = [] {
  if constexpr (requires { typename Policy::MapNeeds; })
    return []<class... Ns>(std::type_identity<Needs<Ns...>>) {
      return (offers<M, Ns> && ... && true);
    }(std::type_identity<typename Policy::MapNeeds>{});
  else
    return true;
}();

/// Whether the four policies make a loop.
template <class M, class U, class Sa, class Se>
concept Composable = Map<M> && needs_met<M, U> && needs_met<M, Sa> && needs_met<M, Se> && UtilityFor<U, M> &&
                     SamplerFor<Sa, M> && SelectorFor<Se, M>;

}  // namespace vantage
