// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sampler/yaw_only.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/view_tree.hpp>

namespace vantage {
namespace {

static_assert(Persistent<YawOnly<ViewTree>> && !Persistent<YawOnly<Pool>>);
static_assert(SamplerFor<YawOnly<Pool>, archetype::Map> && !SamplerFor<YawOnly<ViewTree>, archetype::Map>);

/// Proposes what it is given, scored.
struct Paying {
  std::vector<View> views;
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score& score, Rng&) const {
    Candidates c{.views = views, .utilities = std::vector<double>(views.size())};
    score(views, views, c.utilities);
    return c;
  }
};
/// How steeply a view looks up, and those before it.
const auto steepness = [](Views given, Views views, std::span<double> out) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    out[i] = std::abs(views[i].forward().z());
    for (const View& g : given) out[i] += std::abs(g.forward().z());
  }
};

TEST(YawOnly, ProposesAndScoresLevelViewsFromTheSamePlaces) {
  const std::vector<View> views = {look_at({1, 2, 3}, {4, 5, 3}), look_at({1, 2, 3}, {4, 6, -9}), nadir(0, 1, 2),
                                   look_at({0, 0, 0}, {0, 0, 1})};
  YawOnly sampler{Paying{views}};
  Rng rng(1);
  const Candidates c = sampler.sample(archetype::Map{}, Situation{}, Score(steepness), rng);
  ASSERT_EQ(c.views.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NO_THROW(check_view(c.views[i], "level"));
    EXPECT_EQ(c.views[i].position(), views[i].position());
    EXPECT_NEAR(c.views[i].forward().z(), 0, 1e-12);
    EXPECT_NEAR(c.views[i].T_W_C.linear()(2, 1), -1, 1e-12);  // upright
    EXPECT_NEAR(c.utilities[i], 0, 1e-12);
  }
  EXPECT_TRUE(c.views[0].T_W_C.isApprox(views[0].T_W_C, 1e-12));
  EXPECT_TRUE(c.views[1].forward().isApprox(Eigen::Vector3d(0.6, 0.8, 0), 1e-12));
}

}  // namespace
}  // namespace vantage
