// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/unseen_sides.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>

#include "message_of.hpp"

namespace vantage {
namespace {

/// The sides that a view shows are numbers from its x on, ten of them; none was seen below `seen`.
struct NumberedSides : archetype::Map {
  std::uint64_t seen = 0;
  [[nodiscard]] std::vector<std::uint64_t> unseen_sides(const View& view, const Camera&, double far_m) const {
    std::vector<std::uint64_t> all;
    const auto first = static_cast<std::uint64_t>(view.position().x());
    for (std::uint64_t i = first; i < first + static_cast<std::uint64_t>(far_m); ++i)
      if (i >= seen) all.push_back(i);
    return all;
  }
};
static_assert(SideMap<NumberedSides> && !SideMap<archetype::Map>);

View at(double x) { return look_at({x, 0, 0}, {x, 1, 0}); }

std::vector<double> scores(const NumberedSides& map, const std::vector<View>& given, const std::vector<View>& views) {
  std::vector<double> out(views.size());
  UnseenSides({.far_m = 10}).prepare(map, Situation{}, Rng(1))(given, views, out);
  return out;
}

TEST(UnseenSides, CountsWhatNoMeasurementShowed) {
  NumberedSides map;
  EXPECT_EQ(scores(map, {}, {at(0), at(7)}), (std::vector<double>{10, 10}));
  map.seen = 9;
  EXPECT_EQ(scores(map, {}, {at(0), at(7), at(20)}), (std::vector<double>{1, 8, 10}));
}

TEST(UnseenSides, WhatTheSequenceShowsBeforeCountsOnce) {
  const NumberedSides map;
  EXPECT_EQ(scores(map, {at(3)}, {at(3), at(0), at(7), at(13)}), (std::vector<double>{0, 3, 4, 10}));
  EXPECT_EQ(scores(map, {at(0), at(12)}, {at(5)}), (std::vector<double>{2}));
}

TEST(UnseenSides, RefusesBadConfigs) {
  EXPECT_NE(test::message_of([] { UnseenSides({.far_m = 0}); }).find("far_m"), std::string::npos);
  EXPECT_THROW(UnseenSides({.camera = {}}), Error);
}

}  // namespace
}  // namespace vantage
