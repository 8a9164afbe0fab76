// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <concepts>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/world.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>

#include "maps.hpp"
#include "policies.hpp"
#include "suite.hpp"

// What stop rules, clocks and worlds must mean.
namespace vantage::test {
namespace {

template <class S>
class StopRuleContract : public testing::Test {
 protected:
  S stop = make<S>();
};
TYPED_TEST_SUITE(StopRuleContract, Suite<StopRules>);

TYPED_TEST(StopRuleContract, GoesOnAtTheStartAndStopsAtLast) {
  archetype::FullMap map;
  EXPECT_FALSE(this->stop(map, Situation{}));
  Rng rng;
  for (const double x : {-1.0, 1.0}) map.integrate({nadir(x, 0, 1)}, rng);
  const Situation late{.elapsed_s = 1e9, .travelled_m = 1e9, .best_utility = -1e9, .step = 1'000'000'000};
  EXPECT_TRUE(this->stop(map, late));
}

TYPED_TEST(StopRuleContract, WhatRemainsIsNotNegativeAndFalls) {
  const auto remaining_s = [&](double elapsed_s) {
    Situation q{.elapsed_s = elapsed_s};
    if constexpr (requires { this->stop.remaining_s(q); })
      return static_cast<double>(this->stop.remaining_s(q));
    else
      return q.remaining_s;  // unknown: infinite
  };
  double before = remaining_s(0);
  for (const double elapsed_s : {1.0, 100.0, 300.0, 1e6}) {
    const double now = remaining_s(elapsed_s);
    EXPECT_GE(now, 0);
    EXPECT_LE(now, before);
    before = now;
  }
}

template <class C>
class ClockContract : public testing::Test {
 protected:
  C clock = make<C>();
};
TYPED_TEST_SUITE(ClockContract, Suite<Clocks>);

TYPED_TEST(ClockContract, NeverRunsBackward) {
  double before = this->clock.elapsed_s();
  EXPECT_GE(before, 0);
  const auto later = [&] {
    const double now = this->clock.elapsed_s();
    EXPECT_GE(now, before);
    before = now;
  };
  for (int step = 0; step < 5; ++step) {
    this->clock.begin();
    later();
    this->clock.planned();
    later();
    this->clock.travelled(2.5);
    later();
    this->clock.begin();
    this->clock.mapped();
    later();
  }
}

TYPED_TEST(ClockContract, GoesOnFromWhereItWasSaved) {
  if constexpr (Persistent<TypeParam>) {
    this->clock.travelled(12.5);
    Sink sink;
    this->clock.save(sink);
    TypeParam other = make<TypeParam>();
    Source source(sink.bytes());
    other.load(source);
    source.done();
    EXPECT_EQ(other.elapsed_s(), this->clock.elapsed_s());
    EXPECT_GE(other.elapsed_s(), 12.5);
  } else {
    EXPECT_GE(this->clock.elapsed_s(), 0);  // nothing to save: real time, or a clock of a test
  }
}

template <class WorldT, class MapT>
struct WorldOf {
  using World = WorldT;
  using Map = MapT;
  static WorldT make() {
    if constexpr (std::same_as<WorldT, FieldWorld<>>) {
      Rng rng(5);
      return FieldWorld<>(random_field(rng, {.columns = 64, .rows = 64}), DeviationByHeight{}, Rng(6));
    } else {
      return WorldT{};
    }
  }
};
using Worlds =
    List<WorldOf<archetype::World, archetype::FullMap>, WorldOf<WavyWorld, OursMap>, WorldOf<FieldWorld<>, OursMap>>;

template <class W>
class WorldContract : public testing::Test {
 protected:
  /// What a map makes of two views.
  static std::vector<std::byte> learnt(typename W::World& world) {
    typename W::Map map = MapFixture<typename W::Map>::make();
    for (const View& v : {nadir(2.5, 2.5, 2.5), nadir(10, 10, 2)}) {
      const std::optional<typename W::Map::Measurement> z = world.observe(v);
      if (!z) throw std::runtime_error("none");
      if constexpr (Posed<typename W::Map::Measurement>) check_view(z->view, "measurement");
      Rng rng;
      map.integrate(*z, rng);
    }
    Sink sink;
    map.save(sink);
    return std::move(sink).take();
  }
};
TYPED_TEST_SUITE(WorldContract, Suite<Worlds>);

TYPED_TEST(WorldContract, MeasuresWhatTheMapLearnsFrom) {
  auto world = TypeParam::make();
  EXPECT_NO_THROW(this->learnt(world));
}

TYPED_TEST(WorldContract, TwoOfTheSameSeeTheSame) {
  auto world = TypeParam::make(), other = TypeParam::make();
  EXPECT_EQ(this->learnt(world), this->learnt(other));
}

TYPED_TEST(WorldContract, GoesOnFromWhereItWasSaved) {
  auto world = TypeParam::make(), other = TypeParam::make();
  (void)this->learnt(world);
  if constexpr (Persistent<typename TypeParam::World>) {
    Sink sink;
    world.save(sink);
    Source source(sink.bytes());
    other.load(source);
    source.done();
  }  // one that saves nothing has nothing to remember
  EXPECT_EQ(this->learnt(world), this->learnt(other));
}

}  // namespace
}  // namespace vantage::test
