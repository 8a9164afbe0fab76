// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/refine_in_flight.hpp>
#include <vantage/loop/skip_refused.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/utility/mean_uncertainty.hpp>
#include <vantage/utility/uninformed.hpp>

namespace vantage {
namespace {

using ToyMap = archetype::FullMap;
const std::vector<View> three = {nadir(-1, 0, 1), nadir(1, 0, 1), nadir(0.5, 0, 1)};

auto toy_loop() { return NbvLoop{ToyMap{}, MeanUncertainty{}, archetype::Sampler{}, archetype::Selector{}}; }
std::vector<std::byte> bytes(const auto&... parts) {
  Sink sink;
  (parts.save(sink), ...);
  return std::move(sink).take();
}

TEST(NbvLoop, MeasuresTheFirstViewsThenPlans) {
  auto loop = toy_loop();
  archetype::World world;
  const MissionState s = loop.run(world, View{}, three, Measurements(5), ModelledClock{}, Rng{7});
  ASSERT_EQ(s.visited.size(), 5u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_place(s.visited[i], three[i]));
  EXPECT_TRUE(same_place(s.here, s.visited.back()));
  const double planned_m = distance_m(s.visited[2], s.visited[3]) + distance_m(s.visited[3], s.visited[4]);
  EXPECT_DOUBLE_EQ(s.travelled_m, planned_m);
}

TEST(NbvLoop, PlansOnThePriorWithoutFirstViews) {
  auto loop = toy_loop();
  archetype::World world;
  EXPECT_EQ(loop.run(world, View{}, {}, Measurements(4), ModelledClock{}, Rng{7}).visited.size(), 4u);
}

TEST(NbvLoop, GoesWhereTheMapIsUncertain) {
  auto loop = toy_loop();
  archetype::World world;
  const MissionState s = loop.run(world, View{}, {}, Measurements(40), ModelledClock{}, Rng{7});
  int left = 0;
  for (const View& v : s.visited) left += v.position().x() < 0;
  EXPECT_EQ(left, 20);  // always the side that was seen less
}

TEST(NbvLoop, TheSameSeedTheSameMission) {
  const auto mission = [](std::uint64_t seed) {
    auto loop = toy_loop();
    archetype::World world;
    ModelledClock clock;
    const MissionState s = loop.run(world, View{}, {}, Measurements(10), clock, Rng{seed});
    return bytes(loop.map, clock, s);
  };
  EXPECT_EQ(mission(1), mission(1));
  EXPECT_NE(mission(1), mission(2));
}

/// A map that counts how often it was trained.
struct Training : archetype::FullMap {
  int* steps;
  void refine(int n, Rng&) { *steps += n; }
};

TEST(NbvLoop, RefinesInFlightByTheTimeOfTheFlight) {
  const auto trained = [](double steps_per_s, std::uint64_t views, MissionState& s) {
    int steps = 0;
    NbvLoop loop{Training{{}, &steps}, MeanUncertainty{}, archetype::Sampler{}, archetype::Selector{}};
    archetype::World world;
    ModelledClock clock;
    s = loop.run(world, View{}, {}, Measurements(views), clock, Rng{7}, RefineInFlight{steps_per_s});
    return std::pair(steps, clock.elapsed_s());
  };
  MissionState s;
  const auto [none, plain_s] = trained(0, 6, s);
  EXPECT_EQ(none, 0);
  ASSERT_GT(s.travelled_m, 1);
  const auto [many, same_s] = trained(100, 6, s);
  EXPECT_NEAR(many, 100 * s.travelled_m, 6);  // 1 m/s; each flight's steps are rounded down
  EXPECT_EQ(same_s, plain_s) << "flying takes that time anyway";
  EXPECT_THROW(RefineInFlight{-1}, Error);
}

/// Keeps what a checkpoint would hold after every measurement.
struct Keeping {
  std::vector<std::vector<std::byte>>* saved;
  template <class Loop, class World, class Clock>
  void completed(const Loop& loop, const World&, const Clock& clock, const MissionState& state) {
    saved->push_back(bytes(loop.map, clock, state));
  }
};

TEST(NbvLoop, ResumedAtAnyStepItEndsInTheSameBytes) {
  std::vector<std::vector<std::byte>> saved;
  auto loop = toy_loop();
  archetype::World world;
  ModelledClock clock;
  const MissionState s = loop.run(world, View{}, three, MissionTime(30), clock, Rng{7}, Keeping{&saved});
  const auto end = bytes(loop.map, clock, s);
  ASSERT_GT(saved.size(), 8u);
  for (std::size_t k = 0; k < saved.size(); ++k) {  // among the first views and after them
    auto again = toy_loop();
    ModelledClock other;
    MissionState state;
    Source source(saved[k]);
    again.map.load(source);
    other.load(source);
    state.load(source);
    source.done();
    EXPECT_EQ(again.resume(world, state, three, MissionTime(30), other), StopReason::stop_rule);
    EXPECT_EQ(bytes(again.map, other, state), end) << "resumed after measurement " << k + 1;
  }
}

struct Watching {
  std::vector<std::string>* log;
  void started(const auto&, const Situation& q) { log->push_back(concat("started ", q.step)); }
  void measured(const auto&, const Situation& q, const auto& step) {
    log->push_back(concat("measured ", step.index, " ", q.step, step.plan ? " planned" : " first"));
  }
  void completed(const auto& loop, const auto&, const auto& clock, const MissionState& state) {
    EXPECT_GT(clock.elapsed_s(), 0);
    log->push_back(concat("completed ", state.visited.size(), " ", loop.map.coverage()));
  }
  void finished(const auto&, const Situation& q, StopReason reason) {
    log->push_back(concat("finished ", q.step, " ", static_cast<int>(reason)));
  }
};
struct OnlyFinished {
  int* times;
  void finished(const auto&, const Situation&, StopReason) { ++*times; }
};
struct Nothing {};

TEST(NbvLoop, TellsItsObserversWhatTheyAskFor) {
  std::vector<std::string> log;
  int times = 0;
  auto loop = toy_loop();
  archetype::World world;
  loop.run(world, View{}, Views(three).first(1), Measurements(2), ModelledClock{}, Rng{7}, Watching{&log}, Nothing{},
           OnlyFinished{&times});
  EXPECT_EQ(log, (std::vector<std::string>{"started 0", "measured 1 1 first", "completed 1 0.5", "measured 2 2 planned",
                                           "completed 2 1", "finished 2 0"}));
  EXPECT_EQ(times, 1);
}

struct Timing {
  std::vector<std::array<double, 4>>* steps;
  void measured(const auto&, const Situation& q, const auto& step) {
    steps->push_back({step.planning_s, step.mapping_s, step.action_s, q.elapsed_s});
  }
};
TEST(NbvLoop, AccountsForAllMissionTime) {
  std::vector<std::array<double, 4>> steps;
  auto loop = toy_loop();
  archetype::World world;
  const MissionState s = loop.run(world, View{}, Views(three).first(2), Measurements(6),
                                  ModelledClock({.mapping_s = 0.25, .planning_s = 0.5}), Rng{7}, Timing{&steps});
  ASSERT_EQ(steps.size(), 6u);
  double sum_s = 0, action_s = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(steps[i][0], i < 2 ? 0 : 0.5);
    EXPECT_NEAR(steps[i][1], 0.25, 1e-12);
    sum_s += steps[i][0] + steps[i][1] + steps[i][2];
    action_s += steps[i][2];
    EXPECT_NEAR(steps[i][3], sum_s, 1e-9);
  }
  EXPECT_NEAR(action_s, s.travelled_m, 1e-9);  // at 1 m/s
}

struct Ending {
  int left;
  std::optional<archetype::Look> observe(const View& v) {
    if (left-- == 0) return std::nullopt;
    return archetype::Look{v};
  }
};
struct Reason {
  StopReason* reason;
  void finished(const auto&, const Situation&, StopReason r) { *reason = r; }
};

TEST(NbvLoop, EndsWithTheWorld) {
  StopReason reason{};
  auto loop = toy_loop();
  Ending world{4};
  EXPECT_EQ(loop.run(world, View{}, three, Measurements(100), ModelledClock{}, Rng{7}, Reason{&reason}).visited.size(),
            4u);
  EXPECT_EQ(reason, StopReason::world_ended);
  Ending empty{0};
  EXPECT_TRUE(toy_loop()
                  .run(empty, View{}, three, Measurements(100), ModelledClock{}, Rng{7}, Reason{&reason})
                  .visited.empty());
  EXPECT_EQ(reason, StopReason::world_ended);
}

TEST(NbvLoop, EndsWhenThereIsNothingToDo) {
  StopReason reason{};
  NbvLoop loop{archetype::Map{}, Uninformed{}, Pool{three}, archetype::Selector{}};
  archetype::World world;
  EXPECT_EQ(loop.run(world, View{}, {}, Measurements(100), ModelledClock{}, Rng{7}, Reason{&reason}).visited.size(),
            3u);
  EXPECT_EQ(reason, StopReason::nothing_to_do);
}

TEST(NbvLoop, StopsAfterPlanningWhenNothingIsWorthIt) {
  StopReason reason{};
  auto loop = toy_loop();
  archetype::World world;
  ModelledClock clock({.mapping_s = 1, .planning_s = 1});
  const MissionState s = loop.run(world, View{}, {}, UtilityBelow(0.4), clock, Rng{7}, Reason{&reason});
  EXPECT_EQ(s.visited.size(), 4u);  // doubts 1, 1, 1/2, 1/2, then 1/3 on both sides
  EXPECT_EQ(reason, StopReason::stop_rule);
  EXPECT_EQ(clock.elapsed_s() - s.travelled_m, 4 + 5);  // planned five times
}

TEST(NbvLoop, ABudgetOfNothingMeasuresTheFirstViewsOnly) {
  archetype::World world;
  EXPECT_EQ(toy_loop().run(world, View{}, three, MissionTime(0), ModelledClock{}, Rng{7}).visited.size(), 3u);
  EXPECT_EQ(toy_loop().run(world, View{}, {}, MissionTime(0), ModelledClock{}, Rng{7}).visited.size(), 0u);
}

/// A world that drifts, and one that is steered.
struct Drifting {
  std::vector<std::size_t> followed = {};
  std::optional<archetype::Look> observe(View v) {
    v.T_W_C.translation().y() += 0.25;
    return archetype::Look{v};
  }
  void follow(const std::vector<View>& path) { followed.push_back(path.size()); }
};
struct ByWayOf {
  template <Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    return Decision{.index = 0, .path = {q.here, nadir(0, 0, 9), c.views[0]}, .travel_s = 1, .travel_m = 2};
  }
};

TEST(NbvLoop, BelievesTheMeasurementAboutWhereItWas) {
  Drifting world;
  NbvLoop loop{archetype::Map{}, Uninformed{}, archetype::Sampler{}, ByWayOf{}};
  const MissionState s = loop.run(world, View{}, Views(three).first(1), Measurements(3), ModelledClock{}, Rng{7});
  EXPECT_DOUBLE_EQ(s.visited[0].position().y(), 0.25);
  EXPECT_TRUE(same_place(s.here, s.visited.back()));
  EXPECT_EQ(world.followed, (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(s.travelled_m, 4);
}

/// Refuses the looks of these measurements, counted from 0.
struct Fussy : archetype::Map {
  std::vector<std::size_t> refuses = {};
  std::size_t asked = 0, taken = 0;
  void integrate(const archetype::Look& z, Rng& rng) {
    if (std::find(refuses.begin(), refuses.end(), asked++) != refuses.end()) throw Error("Fussy", "not this one");
    archetype::Map::integrate(z, rng);
    ++taken;
  }
};
auto fussy_loop(std::vector<std::size_t> refuses) {
  Fussy map;
  map.refuses = std::move(refuses);
  return NbvLoop{std::move(map), Uninformed{}, archetype::Sampler{}, archetype::Selector{}};
}
struct Counting {
  int measured_ = 0, completed_ = 0;
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>&) {
    ++measured_;
  }
  template <class L, class W, class C>
  void completed(const L&, const W&, const C&, const MissionState&) {
    ++completed_;
  }
};

TEST(NbvLoop, PlansFromARealPoseOnly) {
  NbvLoop loop{archetype::Map{}, Uninformed{}, archetype::Sampler{}, archetype::Selector{}};
  Rng rng(1);
  EXPECT_THROW(static_cast<void>(loop.plan({.here = nadir(std::nan(""), 0, 1)}, rng)), Error);
}

TEST(NbvLoop, AMeasurementThatIsRefusedEndsTheMission) {
  auto loop = fussy_loop({2});
  archetype::World world;
  MissionState state{.here = View{}, .rng = Rng{7}};
  ModelledClock clock;
  EXPECT_THROW(loop.resume(world, state, {}, Measurements(5), clock), Error);
  EXPECT_EQ(state.visited.size(), 2u);
  loop.resume(world, state, {}, Measurements(5), clock);  // the sensor is well again
  EXPECT_EQ(state.visited.size(), 5u);
  EXPECT_EQ(loop.map.taken, 5u);
}

TEST(NbvLoop, OrIsSkippedIfSomebodyHearsOfIt) {
  auto loop = fussy_loop({1, 3, 4});
  archetype::World world;
  std::ostringstream log;
  SkipRefused skip(log, {.most_in_a_row = 2});
  Counting counting;
  const MissionState s =
      loop.run(world, View{}, Views(three).first(2), Measurements(6), ModelledClock{}, Rng{7}, skip, counting);
  EXPECT_EQ(s.visited.size(), 6u);
  EXPECT_EQ(loop.map.taken, 3u);
  EXPECT_EQ(counting.measured_, 3);
  EXPECT_EQ(counting.completed_, 6);
  EXPECT_EQ(skip.steps(), (std::vector<std::uint64_t>{2, 4, 5}));
  SkipRefused resumed(log);
  const std::vector<std::byte> saved = bytes(skip);
  Source source(saved);
  resumed.load(source);
  EXPECT_EQ(resumed.steps(), skip.steps());
  EXPECT_EQ(log.str().find("view 2 refused: Fussy: not this one\nview 4 refused"), 0u) << log.str();
}

TEST(NbvLoop, GivesUpOnASensorThatIsBroken) {
  auto loop = fussy_loop({1, 2, 3, 4, 5, 6});
  archetype::World world;
  std::ostringstream log;
  SkipRefused skip(log, {.most_in_a_row = 2});
  EXPECT_THROW(loop.run(world, View{}, {}, Measurements(9), ModelledClock{}, Rng{7}, skip), Error);
  EXPECT_EQ(skip.steps().size(), 2u);
  EXPECT_EQ(loop.map.asked, 4u);

  auto never = fussy_loop({0});
  EXPECT_THROW(never.run(world, View{}, {}, Measurements(9), ModelledClock{}, Rng{7}, SkipRefused(log)), Error);
}

// Policies that break their promises are found out, and the map is as it was.
struct NotANumber {
  template <Map M>
  double operator()(const M&, const View& v) const {
    return v.position().x() > 0.25 ? std::nan("") : 1;
  }
};
struct TooFar {
  template <Map M>
  std::optional<Decision> select(const M&, const Situation&, const Candidates& c, const Score&, Rng&) const {
    return Decision{.index = c.views.size()};
  }
};
struct TooFewUtilities {
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng&) const {
    return {.views = three, .utilities = {1, 2}};
  }
};
template <class Loop>
std::string complaint(Loop loop) {
  const auto before = bytes(loop.map);
  Rng rng(1);
  try {
    loop.plan({}, rng);
  } catch (const Error& e) {
    EXPECT_EQ(bytes(loop.map), before);
    return e.what();
  }
  return "";
}
TEST(NbvLoop, FindsOutBrokenPromises) {
  EXPECT_NE(complaint(NbvLoop{ToyMap{}, NotANumber{}, Pool{three}, InOrder{}}).find("utility of candidate 1"),
            std::string::npos);
  EXPECT_NE(complaint(NbvLoop{ToyMap{}, Uninformed{}, Pool{three}, TooFar{}}).find("the selector chose candidate 3"),
            std::string::npos);
  EXPECT_NE(complaint(NbvLoop{ToyMap{}, Uninformed{}, TooFewUtilities{}, InOrder{}}).find("2 utilities"),
            std::string::npos);
  archetype::World world;
  View bad;
  bad.T_W_C.linear() *= 3;
  EXPECT_THROW(toy_loop().run(world, bad, {}, Measurements(1), ModelledClock{}, Rng{7}), Error);
}

/// Pays for its candidates itself: the utility must not be asked again.
struct Paid {
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng&) const {
    return {.views = three, .utilities = {1, 7, 3}};
  }
};
struct Forbidden {
  template <Map M>
  double operator()(const M&, const View&) const {
    throw Error("Forbidden", "asked");
  }
};
TEST(NbvLoop, PlansStepByStep) {
  NbvLoop loop{archetype::Map{}, Forbidden{}, Paid{}, archetype::Selector{}};
  Rng rng(1);
  const std::optional<Plan> plan = loop.plan({.here = three[0]}, rng);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->decision.index, 1u);
  EXPECT_EQ(plan->utility, 7);
  EXPECT_EQ(plan->best_utility, 7);
  EXPECT_EQ(plan->candidates, 3u);
  EXPECT_EQ(plan->decision.travel_m, 2);
  EXPECT_TRUE(same_place(plan->view, three[1]));
  NbvLoop in_order{archetype::Map{}, Forbidden{}, Paid{}, InOrder{}};
  EXPECT_EQ(in_order.plan({}, rng)->utility, 1);
  EXPECT_EQ(in_order.plan({}, rng)->best_utility, 7);
}

TEST(NbvLoop, TakesWorldsClocksAndStopRulesOfOnesOwn) {
  auto loop = toy_loop();
  archetype::World world;
  archetype::Clock clock;
  const auto stop = [](const auto& map, const Situation& q) { return map.coverage() == 1 || q.step > 50; };
  const MissionState s = loop.run(world, View{}, {}, stop, clock, Rng{7});
  EXPECT_EQ(s.visited.size(), 2u);
  EXPECT_DOUBLE_EQ(clock.elapsed_s(), 4 + s.travelled_m);
}

/// What the policies see of the mission.
struct Seeing {
  std::vector<Situation>* seen;
  template <Map M>
  Candidates sample(const M&, const Situation& q, const Score&, Rng&) const {
    seen->push_back(q);
    return {.views = three};
  }
};
TEST(NbvLoop, TellsThePoliciesHowTheMissionStands) {
  std::vector<Situation> seen;
  NbvLoop loop{archetype::Map{}, Uninformed{}, Seeing{&seen}, archetype::Selector{}};
  archetype::World world;
  loop.run(world, three[0], three, AnyOf{MissionTime(7), Measurements(6)},
           ModelledClock({.mapping_s = 1, .planning_s = 1}), Rng{7});
  ASSERT_GE(seen.size(), 2u);
  EXPECT_EQ(seen[0].step, 3u);
  EXPECT_EQ(seen[0].elapsed_s, 3);
  EXPECT_EQ(seen[0].remaining_s, 4);
  EXPECT_EQ(seen[0].best_utility, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(same_place(seen[0].here, three[2]));
  EXPECT_EQ(seen[1].step, 4u);
  EXPECT_EQ(seen[1].visited.size(), 4u);
  EXPECT_EQ(seen[1].elapsed_s + seen[1].remaining_s, 7);
}

}  // namespace
}  // namespace vantage
