// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/loop/nbv_loop.hpp>

#include "maps.hpp"
#include "message_of.hpp"
#include "policies.hpp"

// Interchangeability, run: every two policies that the concepts allow together go three steps in some loop. Which loops
// these are is worked out at compile time, few enough to build and enough to cover every pair.
namespace vantage::test {
namespace {

struct Loop {
  std::size_t map = 0, utility = 0, sampler = 0, selector = 0;
};
constexpr std::size_t n_maps = Maps::size, n_utilities = Utilities::size, n_samplers = Samplers::size,
                      n_selectors = Selectors::size;
template <std::size_t Rows, std::size_t Columns>
using Table = std::array<std::array<bool, Columns>, Rows>;

template <class M, class P, class Role>
constexpr bool fits() {
  if constexpr (!needs_met<M, P>)
    return false;
  else
    return Role::template fits<P, M>;
}
struct AsUtility {
  template <class P, class M>
  static constexpr bool fits = UtilityFor<P, M>;
};
struct AsSampler {
  template <class P, class M>
  static constexpr bool fits = SamplerFor<P, M>;
};
struct AsSelector {
  template <class P, class M>
  static constexpr bool fits = SelectorFor<P, M>;
};

template <class Role, class... Ms, class... Ps>
constexpr auto table(List<Ms...>, List<Ps...>) {
  const auto row = []<class M>(std::type_identity<M>) {
    return std::array<bool, sizeof...(Ps)>{fits<M, Ps, Role>()...};
  };
  return Table<sizeof...(Ms), sizeof...(Ps)>{row(std::type_identity<Ms>{})...};
}
constexpr auto utility_fits = table<AsUtility>(Maps{}, Utilities{});
constexpr auto sampler_fits = table<AsSampler>(Maps{}, Samplers{});
constexpr auto selector_fits = table<AsSelector>(Maps{}, Selectors{});

/// Which pairs some loop of a set has brought together.
struct Covered {
  Table<n_maps, n_utilities> map_utility{};
  Table<n_maps, n_samplers> map_sampler{};
  Table<n_maps, n_selectors> map_selector{};
  Table<n_utilities, n_samplers> utility_sampler{};
  Table<n_utilities, n_selectors> utility_selector{};
  Table<n_samplers, n_selectors> sampler_selector{};
  constexpr int news(const Loop& l) const {
    return !map_utility[l.map][l.utility] + !map_sampler[l.map][l.sampler] + !map_selector[l.map][l.selector] +
           !utility_sampler[l.utility][l.sampler] + !utility_selector[l.utility][l.selector] +
           !sampler_selector[l.sampler][l.selector];
  }
  constexpr void add(const Loop& l) {
    map_utility[l.map][l.utility] = map_sampler[l.map][l.sampler] = map_selector[l.map][l.selector] =
        utility_sampler[l.utility][l.sampler] = utility_selector[l.utility][l.selector] =
            sampler_selector[l.sampler][l.selector] = true;
  }
};
struct Choice {
  std::array<Loop, n_maps * n_utilities + n_samplers*(n_utilities + n_selectors)> loops{};
  std::size_t count = 0;
  Covered covered{};
  constexpr void add(const Loop& l) {
    covered.add(l);
    loops[count++] = l;
  }
};
/// One loop for each map and utility that fit, with the sampler and the selector that bring most new pairs; then one
/// for each pair that is left.
constexpr Choice choice = [] {
  Choice c;
  for (std::size_t m = 0; m < n_maps; ++m)
    for (std::size_t u = 0; u < n_utilities; ++u) {
      if (!utility_fits[m][u]) continue;
      Loop best{};
      int most = -1;
      for (std::size_t s = 0; s < n_samplers; ++s)
        for (std::size_t d = 0; d < n_selectors; ++d) {
          if (!sampler_fits[m][s] || !selector_fits[m][d]) continue;
          const Loop l{m, u, s, d};
          if (const int news = c.covered.news(l); news > most) most = news, best = l;
        }
      if (most < 0) continue;
      c.add(best);
    }
  for (std::size_t m = 0; m < n_maps; ++m)
    for (std::size_t s = 0; s < n_samplers; ++s)
      for (std::size_t d = 0; d < n_selectors; ++d)
        for (std::size_t u = 0; u < n_utilities; ++u)
          if (sampler_fits[m][s] && selector_fits[m][d] && utility_fits[m][u])
            if (const Loop l{m, u, s, d}; c.covered.news(l) > 0) c.add(l);
  return c;
}();

/// Measured before the steps, as some samplers go on from what is known; one view where the fixture does not say.
template <class M>
std::vector<View> first_views() {
  if constexpr (requires { MapFixture<M>::first_views(); })
    return MapFixture<M>::first_views();
  else
    return {MapFixture<M>::views().front()};
}
template <class M, class U, class Sa, class Se>
MissionState three_steps() {
  NbvLoop loop{MapFixture<M>::make(), make<U>(), make<Sa>(), make<Se>()};
  typename MapFixture<M>::World world;
  const std::vector<View> first = first_views<M>();
  return loop.run(world, nadir(1, 1, 3), first, Measurements(first.size() + 3), ModelledClock{}, Rng{7});
}
/// Whoever looks for regions is done when there are none.
template <class Sa>
constexpr bool may_be_done_early = !needs_met<archetype::Navigable<>, Sa>;

/// Whoever flies through voxels may turn on the spot instead.
template <class Sa>
constexpr bool may_stay = !needs_met<archetype::Map, Sa>;

/// Expected information may be negative, of which a ratio to the flight time makes no sense.
template <class U, class Se>
constexpr bool may_be_refused = std::same_as<U, InformationGain>&& std::same_as<Se, PerFlightTime>;

template <class M, class Sa>
void expect_three_steps(const MissionState& end) {
  const std::size_t first = first_views<M>().size();
  EXPECT_GT(end.visited.size(), first);
  if (!may_be_done_early<Sa>) { EXPECT_EQ(end.visited.size(), first + 3); }
  if (!may_stay<Sa>) { EXPECT_GT(end.travelled_m, 0); }
}

template <std::size_t K>
void run_loop() {
  constexpr Loop l = choice.loops[K];
  using M = typename At<l.map, Maps>::type;
  using U = typename At<l.utility, Utilities>::type;
  using Sa = typename At<l.sampler, Samplers>::type;
  using Se = typename At<l.selector, Selectors>::type;
  static_assert(Composable<M, U, Sa, Se>);
  SCOPED_TRACE(testing::Message() << "map " << l.map << ", utility " << l.utility << ", sampler " << l.sampler
                                  << ", selector " << l.selector);
  // A sensor that can only look down, asked what it would see looking sideways, must say so and not make it up.
  if constexpr (MapFixture<M>::looks_down_only && std::same_as<U, VarianceReduction> && !looks_down<Sa>) {
    EXPECT_THROW((three_steps<M, U, Sa, Se>()), Error);
  } else if constexpr (may_be_refused<U, Se>) {
    std::optional<MissionState> end;
    const std::string message = message_of([&] { end = three_steps<M, U, Sa, Se>(); });
    if (end) {
      expect_three_steps<M, Sa>(*end);
    } else {
      EXPECT_EQ(message.find("PerFlightTime: the utility"), 0U) << message;
    }
  } else {
    expect_three_steps<M, Sa>(three_steps<M, U, Sa, Se>());
  }
}

TEST(Matrix, EveryPairThatFitsGoesThreeSteps) {
  []<std::size_t... Ks>(std::index_sequence<Ks...>) { (run_loop<Ks>(), ...); }
  (std::make_index_sequence<choice.count>{});
}

TEST(Matrix, NoPairIsLeftOut) {
  const Covered& c = choice.covered;
  for (std::size_t m = 0; m < n_maps; ++m) {
    for (std::size_t u = 0; u < n_utilities; ++u) EXPECT_EQ(c.map_utility[m][u], utility_fits[m][u]) << m << " " << u;
    for (std::size_t s = 0; s < n_samplers; ++s) EXPECT_EQ(c.map_sampler[m][s], sampler_fits[m][s]) << m << " " << s;
    for (std::size_t d = 0; d < n_selectors; ++d) EXPECT_EQ(c.map_selector[m][d], selector_fits[m][d]) << m << " " << d;
  }
  const auto some_map = [](auto&& fits) {
    for (std::size_t m = 0; m < n_maps; ++m)
      if (fits(m)) return true;
    return false;
  };
  for (std::size_t u = 0; u < n_utilities; ++u)
    for (std::size_t s = 0; s < n_samplers; ++s)
      EXPECT_EQ(c.utility_sampler[u][s],
                some_map([&](std::size_t m) { return utility_fits[m][u] && sampler_fits[m][s]; }))
          << u << " " << s;
  for (std::size_t u = 0; u < n_utilities; ++u)
    for (std::size_t d = 0; d < n_selectors; ++d)
      EXPECT_EQ(c.utility_selector[u][d],
                some_map([&](std::size_t m) { return utility_fits[m][u] && selector_fits[m][d]; }))
          << u << " " << d;
  for (std::size_t s = 0; s < n_samplers; ++s)
    for (std::size_t d = 0; d < n_selectors; ++d)
      EXPECT_EQ(c.sampler_selector[s][d],
                some_map([&](std::size_t m) { return sampler_fits[m][s] && selector_fits[m][d]; }))
          << s << " " << d;
}

}  // namespace
}  // namespace vantage::test
