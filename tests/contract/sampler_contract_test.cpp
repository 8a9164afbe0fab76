// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/geometry/view.hpp>

#include "policies.hpp"
#include "suite.hpp"

// What a sampler must mean: valid views, one utility and one parent each if any, and the same ones for the same seed.
namespace vantage::test {
namespace {

template <class S>
Candidates sample(S& sampler, const Situation& q, std::uint64_t seed) {
  archetype::FullMap map;  // one side of it was seen
  Rng mapping(1);
  map.integrate({nadir(-0.5, 0, 1)}, mapping);
  const auto scorer = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = views[i].position().x();
  };
  Rng rng(seed);
  return sampler.sample(map, q, Score(scorer), rng);
}
std::vector<double> numbers(const Candidates& c) {
  std::vector<double> n = c.utilities;
  for (const View& v : c.views) n.insert(n.end(), v.T_W_C.data(), v.T_W_C.data() + 16);
  for (const int p : c.parent) n.push_back(p);
  return n;
}

template <class S>
class SamplerContract : public testing::Test {
 protected:
  S sampler = make<S>();
  Situation start = {.here = start_of<S>()};
};
TYPED_TEST_SUITE(SamplerContract, Suite<Samplers>);

TYPED_TEST(SamplerContract, ProposesValidViews) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Candidates c = sample(this->sampler, this->start, seed);
    EXPECT_FALSE(c.views.empty());
    for (const View& v : c.views) EXPECT_NO_THROW(check_view(v, "candidate"));
    EXPECT_TRUE(c.utilities.empty() || c.utilities.size() == c.views.size());
    EXPECT_TRUE(c.parent.empty() || c.parent.size() == c.views.size());
    for (std::size_t i = 0; i < c.parent.size(); ++i)
      EXPECT_TRUE(c.parent[i] >= -1 && c.parent[i] < static_cast<int>(i));
  }
}

TYPED_TEST(SamplerContract, TheSameSeedGivesTheSameViews) {
  auto other = make<TypeParam>();
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    EXPECT_EQ(numbers(sample(this->sampler, this->start, seed)), numbers(sample(other, this->start, seed)));
}

TYPED_TEST(SamplerContract, TheSameViewsWithAnyNumberOfThreads) {
  const auto ask = [&] {
    auto fresh = make<TypeParam>();
    return numbers(sample(fresh, this->start, 5));
  };
  const std::vector<double> one = with_threads(1, ask);
  EXPECT_EQ(one, with_threads(2, ask));
  EXPECT_EQ(one, with_threads(8, ask));
}

TYPED_TEST(SamplerContract, WorksAnywhere) {
  const std::vector<View> visited = {nadir(1e6, -1e6, 1e6), nadir(0, 0, 0), look_at({1, 2, 3}, {0, 0, 0})};
  for (const View& here : visited)
    for (const View& v : sample(this->sampler, {.here = here, .visited = visited}, 1).views)
      EXPECT_NO_THROW(check_view(v, "candidate"));
}

}  // namespace
}  // namespace vantage::test
