// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <vantage/loop/mission_state.hpp>

namespace vantage {
namespace {

MissionState state() {
  MissionState s{.here = nadir(1, 2, 3),
                 .rng = Rng(7),
                 .visited = {nadir(0, 0, 1), look_at({1, 1, 1}, {0, 0, 0})},
                 .travelled_m = 12.5};
  s.rng();
  return s;
}
std::vector<std::byte> bytes(const MissionState& s) {
  Sink sink;
  s.save(sink);
  return std::move(sink).take();
}

TEST(MissionState, SavesAndLoads) {
  const auto saved = bytes(state());
  MissionState s;
  Source source(saved);
  s.load(source);
  source.done();
  EXPECT_EQ(bytes(s), saved);
  EXPECT_TRUE(same_place(s.here, nadir(1, 2, 3)));
  EXPECT_EQ(s.rng, state().rng);
  ASSERT_EQ(s.visited.size(), 2u);
  EXPECT_EQ(s.travelled_m, 12.5);
}

TEST(MissionState, RefusesDamage) {
  const auto saved = bytes(state());
  MissionState s = state();
  s.travelled_m = 99;
  const auto before = bytes(s);
  for (std::size_t n = 0; n < saved.size(); n += 7) {
    Source cut(std::span<const std::byte>(saved).first(n));
    EXPECT_THROW(s.load(cut), Error) << n;
    EXPECT_EQ(bytes(s), before);
  }
  MissionState bent = state();
  bent.visited[1].T_W_C.linear() *= 2;  // no pose
  const auto damaged = bytes(bent);
  Source source(damaged);
  EXPECT_THROW(s.load(source), Error);
  EXPECT_EQ(bytes(s), before);
}

}  // namespace
}  // namespace vantage
