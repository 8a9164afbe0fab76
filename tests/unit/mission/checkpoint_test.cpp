// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vantage/mission/checkpoint.hpp>
#include <vantage/mission/recorder.hpp>
#include <vector>

#include "toy/folder.hpp"
#include "toy/mission.hpp"

namespace {

using namespace vantage;

constexpr auto metrics = [](const toy::ToyMap& map) { return std::vector<Metric>{{"variance", map.total_variance()}}; };

using Metrics = std::remove_const_t<decltype(metrics)>;

// One process's share of a mission: everything made anew, then loaded, then run to the budget.
struct Process {
  Recorder<Metrics> recorder{RecorderConfig{.seed = 5}, metrics};
  decltype(toy::toy_loop()) loop = toy::toy_loop();
  toy::ToyWorld world;
  ModelledClock clock;
  MissionState state{.here = nadir(4, 4, 2), .rng = Rng(5)};

  void run(double budget_s, Checkpoint<Recorder<Metrics>>& checkpoint) {
    loop.resume(world, state, {}, toy::ToyStop{budget_s}, clock, recorder, checkpoint);
  }
  [[nodiscard]] std::vector<std::byte> bytes() const {
    return checkpoint_bytes(loop.map, loop.sampler, world, clock, state, recorder);
  }
};

TEST(Checkpoint, AnInterruptedMissionEndsInTheSameBytes) {
  const toy::Folder folder;
  Process whole;
  Checkpoint unused(CheckpointConfig{.file = folder.path / "whole"}, whole.recorder);
  whole.run(80, unused);

  int parts = 0;
  for (const double until_s : {0.0, 5.0, 5.0, 17.0, 61.0, 80.0}) {  // each a new process
    Process part;
    Checkpoint checkpoint(CheckpointConfig{.file = folder.path / "part"}, part.recorder);
    parts += checkpoint.load(part.loop, part.world, part.clock, part.state);
    part.run(until_s, checkpoint);
    if (until_s == 80.0) { EXPECT_EQ(part.bytes(), whole.bytes()); }
  }
  EXPECT_EQ(parts, 4);  // the first process measured nothing, so that the second found no file
  EXPECT_GT(whole.state.visited.size(), 10u);
}

TEST(Checkpoint, SavesEverySoManySteps) {
  const toy::Folder folder;
  Process p;
  Checkpoint checkpoint(CheckpointConfig{.file = folder.path / "c", .every_steps = 4}, p.recorder);
  p.run(40, checkpoint);
  Process q;
  Checkpoint back(CheckpointConfig{.file = folder.path / "c"}, q.recorder);
  ASSERT_TRUE(back.load(q.loop, q.world, q.clock, q.state));
  EXPECT_EQ(q.state.visited.size(), p.state.visited.size() / 4 * 4);

  Process seldom;
  Checkpoint hourly(CheckpointConfig{.file = folder.path / "hourly", .every_s = 3600}, seldom.recorder);
  seldom.run(40, hourly);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "hourly"));
}

TEST(Checkpoint, SavesLessOftenWhatTakesLong) {
  const toy::Folder folder;
  Process p, q;
  Checkpoint dear(CheckpointConfig{.file = folder.path / "c", .most_share = 1e-9}, p.recorder);
  p.run(40, dear);
  Checkpoint back(CheckpointConfig{.file = folder.path / "c"}, q.recorder);
  ASSERT_TRUE(back.load(q.loop, q.world, q.clock, q.state));
  EXPECT_EQ(q.state.visited.size(), 1U);
}

struct Plain {
  int value = 0;
  bool refuse = false;
  void save(Sink& sink) const { sink.put(value); }
  void load(Source& source) {
    const int v = source.get<int>();
    if (refuse) throw Error(source.where(), "refused");
    value = v;
  }
};
struct Other : Plain {};

std::string refusal(std::span<const std::byte> bytes, Plain& a, Plain& b) {
  try {
    restore_checkpoint(bytes, "file", a, b);
  } catch (const Error& e) { return e.what(); }
  return "accepted";
}

TEST(Checkpoint, RefusesEveryTruncationAndBitFlip) {
  const std::vector<std::byte> bytes = checkpoint_bytes(Plain{1}, Plain{2});
  Plain a{7}, b{8};
  EXPECT_EQ(refusal(bytes, a, b), "accepted");
  EXPECT_EQ(a.value, 1);
  EXPECT_EQ(b.value, 2);
  a.value = 7, b.value = 8;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_NE(refusal(std::span(bytes).first(n), a, b), "accepted") << n << " bytes";
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::vector<std::byte> flipped = bytes;
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(refusal(flipped, a, b), "accepted") << "bit " << bit;
  }
  std::vector<std::byte> longer = bytes;
  longer.push_back({});
  EXPECT_NE(refusal(longer, a, b), "accepted");
  EXPECT_EQ(a.value, 7);
  EXPECT_EQ(b.value, 8);
}

// The same, but with the checksum made right: what a forger or another program would write.
std::vector<std::byte> signed_again(std::vector<std::byte> bytes) {
  const auto body = std::span(bytes).first(bytes.size() - 8);
  const std::uint64_t sum = fnv1a(body);
  std::memcpy(bytes.data() + body.size(), &sum, sizeof sum);
  return bytes;
}

TEST(Checkpoint, SaysWhatIsWrong) {
  Plain a, b;
  const auto expect = [&](const std::vector<std::byte>& bytes, const std::string& words) {
    const std::string text = refusal(bytes, a, b);
    EXPECT_NE(text.find(words), text.npos) << text;
  };
  std::vector<std::byte> bytes = checkpoint_bytes(Plain{1}, Plain{2});
  expect({}, "is no checkpoint");
  expect(std::vector<std::byte>(100), "is no checkpoint");
  std::vector<std::byte> format = bytes;
  format[8] = std::byte{9};
  expect(signed_again(format), "has format 9");
  std::vector<std::byte> version = bytes;
  version[20] = std::byte{'9'};  // after magic, format and the length of the text
  expect(signed_again(version), "was written by vantage 9");
  bytes.back() ^= std::byte{1};
  expect(bytes, "checksum");
  expect(checkpoint_bytes(Plain{1}), "holds 1 parts");
  expect(checkpoint_bytes(Plain{1}, Other{}), "Other");
}

TEST(Checkpoint, SurvivesHostileSizes) {
  const std::vector<std::byte> bytes = checkpoint_bytes(Plain{1}, Plain{2});
  Plain a{7}, b{8};
  for (std::size_t at = 0; at + 8 < bytes.size(); ++at)
    for (const std::uint64_t size :
         {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}, (~std::uint64_t{0}) / 8}) {
      std::vector<std::byte> hostile = bytes;
      std::memcpy(hostile.data() + at, &size, std::min<std::size_t>(8, hostile.size() - 8 - at));
      hostile = signed_again(hostile);
      if (refusal(hostile, a, b) == "accepted") a.value = 7, b.value = 8;  // only the values were overwritten
      EXPECT_TRUE(a.value == 7 && b.value == 8);
    }
}

TEST(Checkpoint, ARefusalByALaterPartChangesNoEarlierOne) {
  const std::vector<std::byte> bytes = checkpoint_bytes(Plain{1}, Plain{2});
  Plain a{7}, b{8, true};
  EXPECT_NE(refusal(bytes, a, b), "accepted");
  EXPECT_EQ(a.value, 7);
  EXPECT_EQ(b.value, 8);
}

TEST(Checkpoint, RefusesABadConfig) {
  EXPECT_THROW(Checkpoint<>(CheckpointConfig{}), Error);
  EXPECT_THROW(Checkpoint<>(CheckpointConfig{.file = "c", .every_steps = 0}), Error);
  EXPECT_THROW(Checkpoint<>(CheckpointConfig{.file = "c", .every_s = -1}), Error);
  for (const double share : {0.0, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Checkpoint<>(CheckpointConfig{.file = "c", .most_share = share}), Error);
}

TEST(Checkpoint, AnotherMapsCheckpointLeavesTheMissionAlone) {
  const toy::Folder folder;
  Process p;
  Checkpoint checkpoint(CheckpointConfig{.file = folder.path / "c"}, p.recorder);
  p.run(10, checkpoint);
  Process q;
  q.loop.map = toy::ToyMap(9);
  Checkpoint other(CheckpointConfig{.file = folder.path / "c"}, q.recorder);
  const auto before = q.bytes();
  EXPECT_THROW(other.load(q.loop, q.world, q.clock, q.state), Error);
  EXPECT_EQ(q.bytes(), before);
}

}  // namespace
