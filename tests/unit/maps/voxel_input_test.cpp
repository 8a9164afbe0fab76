// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "message_of.hpp"
#include "voxel_scenes.hpp"

// What a voxel map makes of ranges, missing depth, labels, bad frames and bad bytes.
namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// A corridor along x of 4 x 1 x 1 m, seen from its middle height: one camera row of voxels matters.
template <class Update, class Semantics = NoClasses>
VoxelMap<Update, Semantics> corridor(DepthRange range = {}) {
  typename VoxelMap<Update, Semantics>::Config c;
  c.bounds = Box3(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 1, 1));
  c.clearance_m = 0;
  c.range = range;
  return VoxelMap<Update, Semantics>(c);
}
Frame wall(float depth_m, double eye_x = 0.1) {
  Frame f;
  f.camera = Camera::from_fov(20, 20, deg(10));
  f.view = look_at({eye_x, 0.5, 0.5}, {9, 0.5, 0.5});
  f.depth.setConstant(20, 20, depth_m);
  return f;
}
// States of the middle row of voxels: '.' unknown, '-' free, '#' occupied.
template <class M>
std::string row(const M& map) {
  std::string s;
  for (int x = 0; x < map.grid().size().x(); ++x) {
    const Space space = map.state({x, 2, 2});
    s += space == Space::free ? '-' : space == Space::occupied ? '#' : '.';
  }
  return s;
}
template <class M>
M after(M map, const Frame& f) {
  map.integrate(f);
  return map;
}

TEST(VoxelMapInput, AWallIsHitAndWhatIsBeforeItIsFree) {
  EXPECT_EQ(row(after(corridor<RayCast>(), wall(2.0F))), "----------#.........");
  EXPECT_EQ(row(after(corridor<Projective>(), wall(2.0F))), ".---------#.........") << "the camera's own has no depth";
}

TEST(VoxelMapInput, BeyondItsRangeDepthClearsAndHitsNothing) {
  EXPECT_EQ(row(after(corridor<RayCast>({.max_m = 1.2}), wall(2.0F))), "-------.............");
  EXPECT_EQ(row(after(corridor<Projective>({.max_m = 1.2}), wall(2.0F))), ".-----..............");
}

TEST(VoxelMapInput, OutOfTheGridClearsUpToItsEnd) {
  EXPECT_EQ(row(after(corridor<RayCast>(), wall(30.0F))), "--------------------");
  EXPECT_EQ(row(after(corridor<RayCast>(), wall(5.1F, -3))), "----------#.........") << "from outside";
  EXPECT_EQ(row(after(corridor<RayCast>(), wall(1.0F, -30))), "....................") << "never gets there";
  EXPECT_EQ(row(after(corridor<RayCast>(), wall(1.0F, 30))), "....................");
}

TEST(VoxelMapInput, NoValueSaysWhatTheConfigSays) {
  for (const bool ray : {true, false}) {
    const std::string cleared = ray ? row(after(corridor<RayCast>({.no_return_m = 1.2}), wall(nan)))
                                    : row(after(corridor<Projective>({.no_return_m = 1.2}), wall(nan)));
    EXPECT_EQ(cleared, ray ? "-------............." : ".-----..............");
  }
  const auto map = after(corridor<RayCast>(), wall(nan));
  EXPECT_EQ(map.counts().explored, 0U);
  EXPECT_TRUE(map.known_blocks().empty());
  EXPECT_EQ(map.coverage(), 0);
}

TEST(VoxelMapInput, ClampedLogOddsForgetInTime) {
  auto map = corridor<RayCast>();
  for (int k = 0; k < 50; ++k) map.integrate(wall(2.0F));
  EXPECT_NEAR(map.probability({10, 2, 2}), 0.97, 1e-6);
  EXPECT_NEAR(map.probability({5, 2, 2}), 0.12, 1e-6);
  EXPECT_EQ(map.probability({15, 2, 2}), 0.5);
  for (int k = 0; k < 9; ++k) map.integrate(wall(3.0F));
  EXPECT_EQ(map.state({10, 2, 2}), Space::free);
}

TEST(VoxelMapInput, LabelsAreCountedWhereTheyAreSeen) {
  auto map = corridor<RayCast, ClassCounts<4>>();
  Frame f = wall(2.0F);
  f.labels.setConstant(20, 20, 3);
  f.labels.topRows(9) = 2;
  f.labels.bottomRows(1) = 0;
  map.integrate(f);
  map.integrate(wall(2.0F));  // no labels: no change
  std::array<std::uint64_t, 4> sum{};
  for (const Eigen::Vector3i& block : map.known_blocks())
    map.occupied_in(block).for_each([&](std::size_t local) {
      const auto counts = map.class_counts(voxel_of(block, local));
      for (std::size_t c = 0; c < 4; ++c) sum[c] += counts[c];
    });
  EXPECT_EQ(sum, (std::array<std::uint64_t, 4>{0, 0, 180, 200}));
  EXPECT_EQ(map.label({10, 2, 2}), 3);
  EXPECT_EQ(map.label({15, 2, 2}), 0);
  f.labels(3, 3) = 4;
  EXPECT_REFUSED((map.check(f), 0), "label 4");
  EXPECT_NO_THROW(corridor<RayCast>().check(f)) << "labels do not matter to others";
}

TEST(VoxelMapInput, TakesTheMemoryItSays) {
  const auto used = []<class M>(M map) {
    const std::size_t empty = map.bytes();
    for (std::uint64_t k = 0; k < 8; ++k) map.integrate(test::random_frame(Rng(4).fork(k)));
    return std::pair(map.bytes() - empty, map.known_blocks().size());
  };
  const auto config = []<class C>(C c) {
    c.bounds = test::small_room;
    c.voxel_m = 0.02;
    c.clearance_m = 0.1;
    return c;
  };
  using Plain = VoxelMap<RayCast>;
  using Classed = VoxelMap<RayCast, ClassCounts<6>>;
  const auto [plain, blocks] = used(Plain(config(Plain::Config{})));
  const auto [classed, same_blocks] = used(Classed(config(Classed::Config{})));
  ASSERT_GT(blocks, 640U);
  ASSERT_EQ(blocks, same_blocks);
  const double voxels = 512.0 * static_cast<double>((blocks + 63) / 64 * 64);  // of whole slabs
  EXPECT_NEAR(static_cast<double>(plain) / voxels, 4.65, 0.025);
  EXPECT_EQ(static_cast<double>(classed - plain) / voxels, 4 * 6);
}

TEST(VoxelMapInput, ChecksConfigsAndFrames) {
  using M = VoxelMap<RayCast>;
  M::Config c;
  EXPECT_REFUSED(M(c), "box");
  c.bounds = test::small_room;
  c.voxel_m = 1e-7;
  EXPECT_REFUSED(M(c), "at most along an axis");
  c.voxel_m = 0.0002;
  EXPECT_REFUSED(M(c), "max_bytes");
  c.voxel_m = 0.1;
  c.clearance_m = -1;
  EXPECT_REFUSED(M(c), "clearance_m");
  c.clearance_m = 5;
  EXPECT_REFUSED(M(c), "24 voxels");
  c.clearance_m = 0.1;
  c.range = {.max_m = 0, .no_return_m = nan};
  EXPECT_REFUSED(M(c), "no_return_m");
  c.range = {};
  c.update.miss = 1;
  EXPECT_REFUSED(M(c), "miss");
  c.update = {};
  c.voxel_m = 0.02;
  c.max_bytes = 200000;
  M tight(c);
  const Frame f = test::random_frame(Rng(1));
  EXPECT_REFUSED((tight.check(f), 0), "max_bytes");
  EXPECT_REFUSED((tight.integrate(f), 0), "max_bytes");
  EXPECT_EQ(tight.counts().explored, 0U);
}

template <class M>
std::vector<std::byte> bytes(const M& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}
template <class M>
M room() {
  typename M::Config c;
  c.bounds = test::small_room;
  M map(c);
  for (std::uint64_t k = 0; k < 3; ++k) map.integrate(test::random_frame(Rng(4).fork(k)));
  return map;
}

TEST(VoxelMapInput, WhatWasLoadedIsTheSameMap) {
  using M = VoxelMap<RayCast, ClassCounts<5>>;
  M map = room<M>();
  M loaded(map.config());
  const std::vector<std::byte> saved = bytes(map);
  Source source(saved);
  loaded.load(source);
  source.done();
  EXPECT_EQ(bytes(loaded), saved);
  EXPECT_EQ(loaded.counts().frontier, map.counts().frontier);
  EXPECT_EQ(loaded.counts().navigable, map.counts().navigable);
  const Frame next = test::random_frame(Rng(9));
  map.integrate(next);
  loaded.integrate(next);
  EXPECT_EQ(bytes(loaded), bytes(map));
  VoxelMap<Projective> other = room<VoxelMap<Projective>>();
  Source again(saved);
  EXPECT_REFUSED((other.load(again), 0), "another kind");
}

TEST(VoxelMapInput, AMapOfVeryManyClassesIsLoaded) {
  using M = VoxelMap<RayCast, ClassCounts<4096>>;  // 8 MB a block: more than a stack holds
  const M::Config config{.bounds = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1.8, 1, 1)}, .clearance_m = 0};
  M map(config);
  Frame f = wall(1.6F);
  f.labels.setConstant(20, 20, 4095);
  map.integrate(f);
  ASSERT_EQ(map.known_blocks().size(), 2U);
  const std::vector<std::byte> saved = bytes(map);
  M loaded(config);
  Source source(saved);
  loaded.load(source);
  source.done();
  EXPECT_TRUE(bytes(loaded) == saved);
  EXPECT_EQ(loaded.label({8, 2, 2}), 4095);
  EXPECT_GT(loaded.class_probability({8, 2, 2}, 4095), 0.9);
  Source half(std::span<const std::byte>(saved).first(saved.size() - 1));
  EXPECT_THROW(loaded.load(half), Error);
  EXPECT_TRUE(bytes(loaded) == saved) << "unchanged";
  Rendering<channel::Semantics> image;
  loaded.render(f.view, Camera::from_fov(2, 2, deg(5)), image);
  EXPECT_GT(image.probability[4095](0, 0), image.probability[0](0, 0));
}

/// As an integrate() leaves it that made a block, and then found no memory to go on with.
struct Interrupted : VoxelMap<RayCast> {
  using Known = KnownVoxels<ClassedBlock<NoClasses>, BallInFreeVoxels>;
  explicit Interrupted(VoxelMap<RayCast> map) : VoxelMap<RayCast>(std::move(map)) {}
  void make(const Eigen::Vector3i& block) {
    this->Known::blocks_.reserve(1);
    this->Known::blocks_.make(block);
  }
};
TEST(VoxelMapInput, WhatRanOutOfMemoryIsSavedAsWhatItKnows) {
  Interrupted map(after(corridor<RayCast>(), wall(1.0F)));
  const std::vector<std::byte> saved = bytes(map);
  const std::size_t known = map.known_blocks().size();
  map.make({2, 0, 0});
  ASSERT_EQ(map.known_blocks().size(), known + 1);
  EXPECT_EQ(bytes(map), saved);
  auto loaded = corridor<RayCast>();
  const std::vector<std::byte> again = bytes(map);
  Source source(again);
  loaded.load(source);
  source.done();
  EXPECT_EQ(row(loaded), "-----#..............");
  EXPECT_EQ(row(after(VoxelMap<RayCast>(map), wall(3.6F))), row(after(loaded, wall(3.6F)))) << "it learns on";
}

TEST(VoxelMapInput, DamagedBytesAreRefusedOrAMap) {
  using M = VoxelMap<RayCast, ClassCounts<5>>;
  const M map = room<M>();
  const std::vector<std::byte> saved = bytes(map);
  Rng rng(2);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::byte> damaged = saved;
    if (trial % 2 == 0) damaged.resize(rng.index(damaged.size()));
    const std::size_t first = rng.index(3) == 0 ? 400 : damaged.size();  // where it matters most
    for (int k = 0; k < 4 && !damaged.empty(); ++k)
      damaged[rng.index(std::min(first, damaged.size()))] = static_cast<std::byte>(rng.index(256));
    M loaded = map;
    Source source(damaged);
    try {
      loaded.load(source);
      EXPECT_LE(loaded.counts().free + loaded.counts().occupied, loaded.counts().explored);
    } catch (const Error&) {
      ++refused;
      EXPECT_EQ(bytes(loaded), saved) << "unchanged";
    }
  }
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace vantage
