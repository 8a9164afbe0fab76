// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/utility/mean_uncertainty.hpp>

namespace vantage {
namespace {

using Planned = archetype::FullMap;
std::vector<std::byte> bytes(const auto& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}

/// Refuses looks from high up, after it has drawn a number; keeps the numbers that it drew.
struct Timid : archetype::Map {
  std::vector<std::uint64_t> drawn = {};
  void integrate(const archetype::Look& z, Rng& rng) {
    if (z.view.position().z() > 10) throw Error("Timid", "too high");
    archetype::Map::integrate(z, rng);
    drawn.push_back(rng());
  }
  void save(Sink& sink) const {
    for (const std::uint64_t n : looks_) sink.put(n);
    sink.put(drawn);
  }
  void load(Source& source) {
    for (std::uint64_t& n : looks_) source.get(n);
    source.get(drawn);
  }
};
/// The same, but says so beforehand, and counts its copies.
struct Foretelling : Timid {
  int copies = 0;
  Foretelling() = default;
  Foretelling(const Foretelling& o) : Timid(o), copies(o.copies + 1) {}
  Foretelling(Foretelling&&) = default;
  Foretelling& operator=(const Foretelling&) = default;
  Foretelling& operator=(Foretelling&&) = default;
  void check(const archetype::Look& z) const {
    check_view(z.view, "Foretelling");
    if (z.view.position().z() > 10) throw Error("Foretelling", "too high");
  }
};
/// A planned map that is afraid as well.
struct TimidPlanned : Planned {
  void integrate(const archetype::Look& z, Rng& rng) {
    if (z.view.position().y() > 10) throw Error("TimidPlanned", "too far");
    Planned::integrate(z, rng);
    last = rng();
  }
  std::uint64_t last = 0;
};

template <class Rider>
void expect_all_or_none() {
  Carry carry{TimidPlanned{}, Rider{}, Planned{}};
  Rng rng(1);
  carry.integrate({nadir(1, 0, 1)}, rng);
  const auto before = bytes(carry);
  const Rng rng_before = rng;
  EXPECT_THROW(carry.integrate({nadir(1, 0, 11)}, rng), Error);  // the rider refuses
  EXPECT_EQ(bytes(carry), before);
  EXPECT_EQ(rng, rng_before);
  EXPECT_THROW(carry.integrate({nadir(1, 11, 1)}, rng), Error);  // the planned map refuses
  EXPECT_EQ(bytes(carry), before);
  carry.integrate({nadir(-1, 0, 1)}, rng);
  EXPECT_EQ(carry.coverage(), 1);
  EXPECT_EQ(std::get<1>(carry.riders).coverage(), 1);
  EXPECT_EQ(std::get<0>(carry.riders).drawn.size(), 2u);
}
TEST(Carry, AllMapsLearnOrNone) {
  expect_all_or_none<Timid>();
  expect_all_or_none<Foretelling>();
}

TEST(Carry, ThePlannedMapIsAsWithoutRiders) {
  TimidPlanned alone;
  Carry carry{TimidPlanned{}, Timid{}, Timid{}};
  Rng one(3), other(3);
  for (const double x : {-1.0, 1.0, 0.5}) {
    alone.integrate({nadir(x, 0, 1)}, one);
    carry.integrate({nadir(x, 0, 1)}, other);
    EXPECT_EQ(carry.last, alone.last);
  }
  EXPECT_NE(std::get<0>(carry.riders).drawn, std::get<1>(carry.riders).drawn);  // a stream each
}

TEST(Carry, DoesNotCopyARiderThatForetells) {
  Carry carry{Planned{}, Foretelling{}};
  const int copies = std::get<0>(carry.riders).copies;
  Rng rng(1);
  for (int i = 0; i < 5; ++i) carry.integrate({nadir(1, 0, 1)}, rng);
  EXPECT_EQ(std::get<0>(carry.riders).copies, copies);
  static_assert(ForetellsRefusal<Foretelling> && !ForetellsRefusal<Timid>);
}

TEST(Carry, SavesAndLoadsAllOrNothing) {
  Carry carry{Planned{}, Timid{}};
  Rng rng(1);
  for (const double x : {-1.0, 1.0, 0.5}) carry.integrate({nadir(x, 0, 1)}, rng);
  const auto saved = bytes(carry);
  Carry loaded{Planned{}, Timid{}};
  const auto before = bytes(loaded);
  for (std::size_t n = 0; n < saved.size(); ++n) {
    Source cut(std::span<const std::byte>(saved).first(n));
    EXPECT_THROW(loaded.load(cut), Error);
    EXPECT_EQ(bytes(loaded), before) << n;
  }
  Source source(saved);
  loaded.load(source);
  source.done();
  EXPECT_EQ(bytes(loaded), saved);
}

TEST(Carry, IsPlannedOnLikeThePlannedMap) {
  NbvLoop alone{Planned{}, MeanUncertainty{}, archetype::Sampler{}, archetype::Selector{}};
  NbvLoop loop{Carry{Planned{}, Timid{}}, MeanUncertainty{}, archetype::Sampler{}, archetype::Selector{}};
  archetype::World world;
  const MissionState a = alone.run(world, View{}, {}, Measurements(6), ModelledClock{}, Rng{7});
  const MissionState b = loop.run(world, View{}, {}, Measurements(6), ModelledClock{}, Rng{7});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(same_place(a.visited[i], b.visited[i]));
  EXPECT_EQ(std::get<0>(loop.map.riders).drawn.size(), 6u);
}

}  // namespace
}  // namespace vantage
