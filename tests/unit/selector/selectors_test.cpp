// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/first_of_branch.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/selector/travel_tradeoff.hpp>

#include "golden.hpp"

namespace vantage {
namespace {

const double infinity = std::numeric_limits<double>::infinity();

template <class S>
std::optional<Decision> select(const S& selector, const Candidates& c, const View& here = View{}) {
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng;
  return selector.select(archetype::Map{}, Situation{.here = here}, c, Score(scorer), rng);
}
Candidates along_x(const std::vector<double>& x_m, const std::vector<double>& utilities) {
  Candidates c{.utilities = utilities};
  for (const double x : x_m) c.views.push_back(nadir(x, 0, 0));
  return c;
}
/// As far as the crow flies, but there is no way to x >= wall.
struct Walled {
  double wall = 0;
  template <Map M>
  std::vector<double> lengths_m(const M&, const View& from, Views goals) const {
    std::vector<double> l;
    for (const View& g : goals) l.push_back(g.position().x() >= wall ? infinity : distance_m(from, g));
    return l;
  }
  template <Map M>
  std::vector<View> path(const M&, const View& from, const View& goal) const {
    return {from, nadir(0, 0, 7), goal};
  }
};

TEST(FirstOfBranch, GoesTheFirstStepOfTheBestSequence) {
  //  root - 0 - 2 - 3 (best)
  //       \ 1 - 4
  Candidates c = along_x({1, -2, 3, 4, -5}, {1, 2, 3, 9, 8});
  c.parent = {-1, -1, 0, 2, 1};
  const auto d = select(FirstOfBranch({.speed_m_s = 2}), c, nadir(0.5, 0, 0));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->index, 0u);
  EXPECT_EQ(d->travel_m, 0.5);
  EXPECT_EQ(d->travel_s, 0.25);
  ASSERT_EQ(d->path.size(), 2u);
  EXPECT_TRUE(same_place(d->path.front(), nadir(0.5, 0, 0)) && same_place(d->path.back(), c.views[0]));
  c.utilities[4] = 9.5;
  EXPECT_EQ(select(FirstOfBranch{}, c)->index, 1u);
  c.parent.clear();  // each for itself: ArgMax
  EXPECT_EQ(select(FirstOfBranch{}, c)->index, 4u);
  c.parent = {-1, 2, 1, 1, -1};
  c.utilities[3] = 10;  // a circle
  EXPECT_THROW(select(FirstOfBranch{}, c), Error);
  EXPECT_THROW(FirstOfBranch({.speed_m_s = 0}), Error);
}

TEST(ArgMax, TakesTheBestAndFliesStraight) {
  const auto d = select(ArgMax({.speed_m_s = 2}), along_x({1, -8, 3}, {1, 5, 4}));
  EXPECT_EQ(d->index, 1u);
  EXPECT_EQ(d->travel_m, 8);
  EXPECT_EQ(d->travel_s, 4);
  EXPECT_EQ(select(ArgMax{}, along_x({1, 2}, {-7, -6}))->index, 1u);
  EXPECT_THROW(ArgMax({.speed_m_s = 0}), Error);
}

TEST(InOrder, TakesTheFirst) {
  const auto d = select(InOrder({.speed_m_s = 0.5}), along_x({3, 1}, {0, 5}));
  EXPECT_EQ(d->index, 0u);
  EXPECT_EQ(d->travel_m, 3);
  EXPECT_EQ(d->travel_s, 6);
  EXPECT_THROW(InOrder({.speed_m_s = -1}), Error);
}

TEST(PerFlightTime, DividesByTheFlight) {
  EXPECT_EQ(select(PerFlightTime{}, along_x({10, 2, 4}, {10, 3, 5}))->index, 1u);                  // 1, 1.5, 1.25
  EXPECT_EQ(select(PerFlightTime({.epsilon_s = 3}), along_x({10, 2, 4}, {10, 3, 5}))->index, 0u);  // .77, .6, .71
  const auto d = select(PerFlightTime({.speed_m_s = 4}), along_x({10, 2}, {10, 3}));
  EXPECT_EQ(d->travel_m, 2);
  EXPECT_EQ(d->travel_s, 0.5);
}

TEST(PerFlightTime, NeverStays) {
  EXPECT_EQ(select(PerFlightTime{}, along_x({0, 5}, {100, 1}))->index, 1u);
  EXPECT_EQ(select(PerFlightTime(PerFlightTime::Config::reference()), along_x({1e-10, 5}, {100, 0}))->index, 1u);
  EXPECT_FALSE(select(PerFlightTime{}, along_x({0}, {100})));
}

TEST(PerFlightTime, RefusesNegativeUtilities) {
  EXPECT_THROW(select(PerFlightTime{}, along_x({1, 2}, {1, -1e-9})), Error);
  EXPECT_THROW(PerFlightTime({.speed_m_s = std::nan("")}), Error);
  EXPECT_THROW(PerFlightTime({.epsilon_s = -1}), Error);
}

TEST(MinusCost, PaysForTheWay) {
  EXPECT_EQ(select(MinusCost<>({.weight_per_m = 1}), along_x({10, 2, 4}, {10, 3, 6}))->index, 2u);  // 0, 1, 2
  EXPECT_EQ(select(MinusCost<>({.weight_per_m = 0}), along_x({10, 2, 4}, {10, 3, 6}))->index, 0u);
  const auto d = select(MinusCost(Walled{9}, {.weight_per_m = 0, .speed_m_s = 2}), along_x({10, 2, 4}, {10, 3, 6}));
  EXPECT_EQ(d->index, 2u);
  EXPECT_EQ(d->travel_m, 4);
  EXPECT_EQ(d->travel_s, 2);
  ASSERT_EQ(d->path.size(), 3u);
  EXPECT_EQ(d->path[1].position().z(), 7);
}

TEST(MinusCost, NoneWhenNothingCanBeReached) {
  EXPECT_FALSE(select(MinusCost(Walled{-100}), along_x({10, 2, 4}, {10, 3, 6})));
  EXPECT_FALSE(select(TravelTradeoff(Walled{-100}), along_x({10, 2, 4}, {10, 3, 6})));
}

TEST(TravelTradeoff, IsTheEquation) {
  // Shares of utility .5 .2 .3, of travel .625 .125 .25.
  const Candidates c = along_x({10, 2, 4}, {5, 2, 3});
  for (const double delta : {0.0, 0.25, 0.5, 1.0, 2.0}) {
    std::size_t best = 0;
    const double psi[] = {5, 2, 3}, u[] = {10, 2, 4};
    for (std::size_t i = 1; i < 3; ++i)
      if (psi[i] / 10 - delta * u[i] / 16 > psi[best] / 10 - delta * u[best] / 16) best = i;
    EXPECT_EQ(select(TravelTradeoff<>({.delta = delta}), c)->index, best) << delta;
  }
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 0}), c)->index, 0u);
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 2}), c)->index, 1u);
}

TEST(TravelTradeoff, SumsOverWhatCanBeReached) {
  // With the first out of reach the shares are .4 .6 and 1/3 2/3: at delta 0.5 the last wins by .267 to .233, while
  // sums over all (.2 .3 and .125 .25) would make it .175 to .1375 as well; at 0.7 they differ.
  const Candidates c = along_x({10, 2, 4}, {5, 2, 3});
  EXPECT_EQ(select(TravelTradeoff(Walled{9}, {.delta = 0.5}), c)->index, 2u);
  EXPECT_EQ(select(TravelTradeoff(Walled{9}, {.delta = 0.7}), c)->index, 1u);  // over all: .1125, .125, so the last
}

TEST(TravelTradeoff, NegativeUtilitiesKeepTheirOrder) {
  // As it stands, eq. 6.11 turns the order of negative utilities round: -3 / -6 is more than -1 / -6.
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 0}), along_x({1, 1, 1}, {-3, -1, -2}))->index, 1u);
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 0}), along_x({1, 1}, {-1, 1}))->index, 1u);  // sum 0
}

TEST(TravelTradeoff, AShareOfNothingIsNothing) {
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 0.5}), along_x({3, 1, 2}, {0, 0, 0}))->index, 1u);
  EXPECT_EQ(select(TravelTradeoff<>({.delta = 0.5}), along_x({0, 0}, {1, 2}))->index, 1u);
}

TEST(Router, ThatBreaksItsPromiseIsFound) {
  struct Short : StraightLine {
    std::vector<double> lengths_m(const archetype::Map&, const View&, Views) const { return {1}; }
  };
  struct Negative : StraightLine {
    std::vector<double> lengths_m(const archetype::Map&, const View&, Views goals) const {
      return std::vector<double>(goals.size(), -1);
    }
  };
  struct Undefined : StraightLine {
    std::vector<double> lengths_m(const archetype::Map&, const View&, Views goals) const {
      return std::vector<double>(goals.size(), std::nan(""));
    }
  };
  EXPECT_THROW(select(MinusCost(Short{}), along_x({1, 2}, {1, 1})), Error);
  EXPECT_THROW(select(MinusCost(Negative{}), along_x({1, 2}, {1, 1})), Error);
  EXPECT_THROW(select(TravelTradeoff(Undefined{}), along_x({1, 2}, {1, 1})), Error);
  EXPECT_THROW(MinusCost<>({.weight_per_m = -1}), Error);
  EXPECT_THROW(TravelTradeoff<>({.delta = infinity}), Error);
}

struct GoldenPerFlightTime : test::Golden {
  GoldenPerFlightTime() : Golden("field") {}
};

TEST_F(GoldenPerFlightTime, ChoosesAsThePublishedPlanner) {
  const CsvTable t = read_csv(test::golden("field/d_plan16_Ours_candidates.csv")),
                 poses = read_csv(test::golden("field/d_plan16_Ours_poses.csv"));
  const auto view = [](const CsvTable& of, std::size_t row) {
    return nadir(of.column("x")[row], of.column("y")[row], of.column("h")[row]);
  };
  std::map<std::size_t, Candidates> steps;  // the start is (0, 0, 0)
  for (std::size_t i = 0; i < t.rows(); ++i) {
    Candidates& c = steps[static_cast<std::size_t>(t.column("step")[i])];
    c.views.push_back(view(t, i));
    c.utilities.push_back(t.column("hs_trace_before")[i] - t.column("hs_trace_after")[i]);
  }
  ASSERT_EQ(steps.size(), 4u);
  ASSERT_EQ(poses.rows(), 4u);
  View here;
  for (const auto& [step, c] : steps) {
    const auto d = select(PerFlightTime(PerFlightTime::Config::reference()), c, here);
    ASSERT_TRUE(d);
    here = view(poses, step);
    EXPECT_TRUE(same_place(c.views[d->index], here)) << "step " << step;
  }
}

}  // namespace
}  // namespace vantage
