// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/policy.hpp>

#include "policies.hpp"
#include "suite.hpp"

// What a selector must mean: one of the candidates, the lowest of equals, none when there is nothing; finite travel.
namespace vantage::test {
namespace {

template <class S>
std::optional<Decision> select(S& selector, const Situation& q, const Candidates& c, std::uint64_t seed = 1) {
  const archetype::FullMap map;
  const auto scorer = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = 0;
  };
  Rng rng(seed);
  return selector.select(map, q, c, Score(scorer), rng);
}
Candidates random_candidates(std::uint64_t seed, std::size_t n) {
  Rng rng(seed);
  Candidates c;
  for (std::size_t i = 0; i < n; ++i) {
    c.views.push_back(nadir(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(1, 5)));
    c.utilities.push_back(rng.uniform(0, 3));
  }
  return c;
}

template <class S>
class SelectorContract : public testing::Test {
 protected:
  S selector = make<S>();
};
TYPED_TEST_SUITE(SelectorContract, Suite<Selectors>);

TYPED_TEST(SelectorContract, NoCandidatesNoDecision) { EXPECT_FALSE(select(this->selector, {}, {})); }

TYPED_TEST(SelectorContract, DecidesForACandidateWithFiniteTravel) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Candidates c = random_candidates(seed, 1 + seed % 7);
    const Situation q{.here = nadir(0, 0, 1)};
    const std::optional<Decision> d = select(this->selector, q, c, seed);
    ASSERT_TRUE(d);
    ASSERT_LT(d->index, c.views.size());
    EXPECT_TRUE(std::isfinite(d->travel_m) && d->travel_m >= distance_m(q.here, c.views[d->index]) - 1e-9);
    EXPECT_TRUE(std::isfinite(d->travel_s) && d->travel_s > 0);
    if (!d->path.empty()) {
      EXPECT_TRUE(same_place(d->path.front(), q.here));
      EXPECT_TRUE(same_place(d->path.back(), c.views[d->index]));
    }
  }
}

TYPED_TEST(SelectorContract, TiesGoToTheLowestIndex) {
  // Four views at the same distance (by whatever norm) with the same utility.
  const Candidates c{.views = {nadir(3, 0, 1), nadir(0, 3, 1), nadir(-3, 0, 1), nadir(0, -3, 1)},
                     .utilities = {1, 1, 1, 1}};
  const std::optional<Decision> d = select(this->selector, {.here = nadir(0, 0, 1)}, c);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->index, 0u);
}

TYPED_TEST(SelectorContract, DecidesWhenNothingIsWorthAnything) {
  Candidates c = random_candidates(4, 5);
  c.utilities.assign(5, 0.0);
  EXPECT_TRUE(select(this->selector, {.here = nadir(0, 0, 1)}, c));
}

TYPED_TEST(SelectorContract, TheSameInputTheSameDecision) {
  const Candidates c = random_candidates(9, 40);
  TypeParam other = make<TypeParam>();
  const auto a = select(this->selector, {.here = nadir(0, 0, 1)}, c), b = select(other, {.here = nadir(0, 0, 1)}, c);
  EXPECT_EQ(a->index, b->index);
  EXPECT_EQ(a->travel_m, b->travel_m);
  EXPECT_EQ(a->travel_s, b->travel_s);
}

}  // namespace
}  // namespace vantage::test
