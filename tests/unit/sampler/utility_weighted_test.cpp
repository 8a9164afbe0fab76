// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/utility_weighted.hpp>

#include "message_of.hpp"

namespace vantage {
namespace {

/// Views whose x is their utility.
Pool pool(const std::vector<double>& utilities) {
  std::vector<View> views;
  for (const double u : utilities) views.push_back(nadir(u, static_cast<double>(views.size()), 1));
  return Pool(views);
}
template <class Base>
Candidates sample(UtilityWeighted<Base> sampler, std::uint64_t seed) {
  const auto scorer = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = views[i].position().x();
  };
  Rng rng(seed);
  return sampler.sample(archetype::Map{}, {}, Score(scorer), rng);
}
/// How often each of n views is among those kept.
std::vector<double> shares(const std::vector<double>& utilities, int candidates, int rounds) {
  std::vector<double> share(utilities.size());
  for (int k = 0; k < rounds; ++k)
    for (const View& v :
         sample(UtilityWeighted(pool(utilities), {.candidates = candidates}), static_cast<std::uint64_t>(k)).views)
      share[static_cast<std::size_t>(v.position().y())] += 1.0 / rounds;
  return share;
}

TEST(UtilityWeighted, KeepsOneInProportionToItsUtility) {
  const std::vector<double> share = shares({1, 0, 3, 6}, 1, 20000);
  EXPECT_NEAR(share[0], 0.1, 0.01);
  EXPECT_EQ(share[1], 0);
  EXPECT_NEAR(share[2], 0.3, 0.015);
  EXPECT_NEAR(share[3], 0.6, 0.015);
}

TEST(UtilityWeighted, KeepsTwoAsIfDrawnOneAfterTheOther) {
  const std::vector<double> u = {1, 2, 3, 4}, share = shares(u, 2, 20000);
  for (std::size_t i = 0; i < 4; ++i) {
    double expected = u[i] / 10;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) expected += u[j] / 10 * u[i] / (10 - u[j]);
    EXPECT_NEAR(share[i], expected, 0.015) << i;
  }
}

TEST(UtilityWeighted, NegativeUtilitiesAreRaised) {
  const std::vector<double> share = shares({-2, -1, 1}, 1, 20000);
  EXPECT_EQ(share[0], 0);
  EXPECT_NEAR(share[1], 0.25, 0.015);
  EXPECT_NEAR(share[2], 0.75, 0.015);
}

TEST(UtilityWeighted, AllAlikeWhereNothingIsBetter) {
  for (const double u : {0.0, -3.0})
    for (const double s : shares({u, u, u, u}, 1, 20000)) EXPECT_NEAR(s, 0.25, 0.015);
  for (const double s : shares({0, 5, 0, 0}, 2, 20000))
    EXPECT_LT(std::min(std::abs(s - 1), std::abs(s - 1.0 / 3)), s > 0.9 ? 1e-9 : 0.015);
}

TEST(UtilityWeighted, PaysTheUtilitiesAndKeepsTheOrder) {
  const Candidates c = sample(UtilityWeighted(pool({5, 1, 4, 2, 3}), {.candidates = 3}), 7);
  ASSERT_EQ(c.views.size(), 3u);
  ASSERT_EQ(c.utilities.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(c.utilities[i], c.views[i].position().x());
  EXPECT_LT(c.views[0].position().y(), c.views[1].position().y());
  EXPECT_LT(c.views[1].position().y(), c.views[2].position().y());
  EXPECT_EQ(sample(UtilityWeighted(pool({5, 1, 4}), {.candidates = 10}), 7).views.size(), 3u);
  EXPECT_TRUE(sample(UtilityWeighted(pool({})), 7).views.empty());
}

/// Proposes one view, each time another.
struct Counting {
  int calls = 0;
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng&) {
    return {.views = {nadir(++calls, 0, 1)}};
  }
  void save(Sink& sink) const { sink.put(calls); }
  void load(Source& source) { source.get(calls); }
};
static_assert(Persistent<UtilityWeighted<Counting>> && !Persistent<UtilityWeighted<Pool>>);

TEST(UtilityWeighted, RemembersWhatItsBaseRemembers) {
  UtilityWeighted a(Counting{2}), b(Counting{});
  Sink sink;
  a.save(sink);
  Source source(sink.bytes(), "test");
  b.load(source);
  EXPECT_EQ(sample(b, 1).views.front().position().x(), 3);
}

struct Paid {
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng&) const {
    return {.views = {nadir(1, 0, 1), nadir(2, 1, 1)}, .utilities = {8, 9}};
  }
};
struct Chain : Paid {
  template <Map M>
  Candidates sample(const M& map, const Situation& q, const Score& score, Rng& rng) const {
    Candidates c = Paid::sample(map, q, score, rng);
    c.parent = {-1, 0};
    return c;
  }
};

TEST(UtilityWeighted, DoesNotAskForWhatTheBaseHasPaid) {
  EXPECT_EQ(sample(UtilityWeighted(Paid{}), 1).utilities, (std::vector<double>{8, 9}));
}

TEST(UtilityWeighted, Refuses) {
  EXPECT_THROW(UtilityWeighted(Paid{}, {.candidates = 0}), Error);
  EXPECT_REFUSED(sample(UtilityWeighted(Chain{}), 1), "sequences");
  const auto nan = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = std::numeric_limits<double>::quiet_NaN();
  };
  Rng rng(1);
  UtilityWeighted weighted(pool({1}));
  EXPECT_REFUSED(weighted.sample(archetype::Map{}, {}, Score(nan), rng), "candidate 0 is nan");
}

}  // namespace
}  // namespace vantage
