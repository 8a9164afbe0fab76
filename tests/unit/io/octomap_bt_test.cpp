// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/octomap_bt.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "drawn_voxels.hpp"
#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

using test::DrawnVoxels;
using Leaf = OccupancyOctree::Leaf;

const std::string title = "# Octomap OcTree binary file\n";
std::string file(std::size_t size, const std::string& data, const std::string& edge = "0.25") {
  return title + "# made by hand\nid OcTree\nsize " + std::to_string(size) + "\nres " + edge + "\ndata\n" + data;
}
/// The two bytes of an inner node with one child.
std::string only_child(unsigned child, unsigned kind) {
  const unsigned bits = kind << 2 * child;
  return {static_cast<char>(bits & 0xFF), static_cast<char>(bits >> 8)};
}
VoxelGrid grid(const Eigen::Vector3i& low, const Eigen::Vector3i& size, double edge_m) {
  return VoxelGrid::on_lattice({edge_m * low.cast<double>(), edge_m * (low + size).cast<double>()}, edge_m);
}
/// A random world with large cubes in it, so that something can be pruned.
DrawnVoxels random_map(std::uint64_t seed, const Eigen::Vector3i& low, const Eigen::Vector3i& size) {
  Rng rng(seed);
  DrawnVoxels map(grid(low, size, 0.1), 0.2);
  std::vector<Space> coarse(64);
  for (Space& s : coarse) s = static_cast<Space>(rng.index(3));
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const Eigen::Vector3i v(x, y, z), w = v + low;
        const Space space =
            rng.index(40) == 0
                ? static_cast<Space>(rng.index(3))
                : coarse[static_cast<std::size_t>((w.x() >> 3 & 3) | (w.y() >> 3 & 3) << 2 | (w.z() >> 3 & 3) << 4)];
        if (rng.index(500) != 0) map.draw(v, space);
      }
  return map;
}

TEST(OctomapBt, OneVoxelByHand) {
  // Voxel (0, 0, 0) is child 7 of the root and child 0 from there on.
  std::string data = only_child(7, 3);
  for (int level = 0; level < 14; ++level) data += only_child(0, 3);
  data += only_child(0, 2);
  const std::string bytes = file(17, data);
  const OccupancyOctree tree = decode_bt(bytes, "hand");
  ASSERT_EQ(tree.leaves().size(), 1u);
  EXPECT_EQ(tree.voxel_m(), 0.25);
  EXPECT_EQ(tree.bounds().min(), Eigen::Vector3d::Zero());
  EXPECT_EQ(tree.bounds().max(), Eigen::Vector3d::Constant(0.25));
  EXPECT_EQ(tree.at({0.1, 0.1, 0.1}), Space::occupied);
  EXPECT_EQ(tree.at({-0.1, 0.1, 0.1}), Space::unknown);

  DrawnVoxels map(grid({0, 0, 0}, {1, 1, 1}, 0.25), 0.1);
  map.draw({0, 0, 0}, Space::occupied);
  const std::string ours = encode_bt(map);
  EXPECT_TRUE(ours.ends_with("\nid OcTree\nsize 17\nres 0.25\ndata\n" + data)) << ours;
}

TEST(OctomapBt, EightEqualVoxelsAreOneCube) {
  DrawnVoxels map(grid({-8, 8, 0}, {8, 8, 8}, 0.1), 0.1);
  map.draw_all([](const Eigen::Vector3i&) { return Space::free; });
  OccupancyOctree tree = OccupancyOctree::of(map);
  ASSERT_EQ(tree.leaves().size(), 1u);
  EXPECT_EQ(tree.leaves()[0].height, 3);
  EXPECT_TRUE(tree.box_of(tree.leaves()[0]).isApprox(map.bounds()));

  map.draw({3, 3, 3}, Space::occupied);
  tree = OccupancyOctree::of(map);
  EXPECT_EQ(tree.leaves().size(), 3u * 7 + 1);
}

TEST(OctomapBt, EveryVoxelIsAsTheMapHasIt) {
  const Eigen::Vector3i size(21, 17, 26);
  for (const Eigen::Vector3i& low :
       {Eigen::Vector3i(0, 0, 0), Eigen::Vector3i(-9, -3, 5), Eigen::Vector3i(100, -64, -1)}) {
    const DrawnVoxels map = random_map(3, low, size);
    const OccupancyOctree tree = decode_bt(encode_bt(map), "map");
    EXPECT_EQ(tree, OccupancyOctree::of(map));
    for (int z = -1; z <= size.z(); ++z)
      for (int y = -1; y <= size.y(); ++y)
        for (int x = -1; x <= size.x(); ++x) {
          const Eigen::Vector3d p = map.grid().centre({x, y, z});
          ASSERT_EQ(tree.at(p), map.at(p)) << p.transpose();
        }
    std::uint64_t voxels = 0, known = 0;
    for (const Leaf& leaf : tree.leaves()) voxels += leaf.span();
    for (const Eigen::Vector3i& block : map.known_blocks())
      known += static_cast<std::uint64_t>((map.free_in(block) | map.occupied_in(block)).count());
    EXPECT_EQ(voxels, known);
    EXPECT_EQ(tree.grid().voxel_m(), map.grid().voxel_m());
    EXPECT_TRUE(map.bounds().contains(Box3(tree.bounds().min().array() + 1e-9, tree.bounds().max().array() - 1e-9)));
  }
}

TEST(OctomapBt, CodesAreTheTreesOrder) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3i v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<int>(rng.index(65536)) - 32768;
    std::uint64_t code = 0;
    for (int bit = 0; bit < 16; ++bit)
      for (int axis = 0; axis < 3; ++axis)
        code |= static_cast<std::uint64_t>((v[axis] + 32768) >> bit & 1) << (3 * bit + axis);
    ASSERT_EQ(OccupancyOctree::code_of(v), code);
    ASSERT_EQ(OccupancyOctree::world_voxel(code), v);
  }
}

TEST(OctomapBt, TheCornersOfTheWorld) {
  const OccupancyOctree tree(1, {{0, 0, Space::free}, {(std::uint64_t{1} << 48) - 1, 0, Space::occupied}});
  EXPECT_EQ(tree.at(Eigen::Vector3d::Constant(-32767.5)), Space::free);
  EXPECT_EQ(tree.at(Eigen::Vector3d::Constant(32767.5)), Space::occupied);
  EXPECT_EQ(tree.at(Eigen::Vector3d::Constant(32768)), Space::unknown);
  EXPECT_EQ(tree.at(Eigen::Vector3d::Constant(-1e300)), Space::unknown);
  EXPECT_EQ(tree.at(Eigen::Vector3d::Constant(std::nan(""))), Space::unknown);
  EXPECT_EQ(decode_bt(encode_bt(tree), "corners"), tree);
}

TEST(OctomapBt, NothingKnown) {
  const OccupancyOctree tree = decode_bt(encode_bt(DrawnVoxels(grid({0, 0, 0}, {4, 4, 4}, 0.2), 0.1)), "nothing");
  EXPECT_TRUE(tree.leaves().empty());
  EXPECT_TRUE(tree.bounds().isEmpty());
  EXPECT_EQ(tree.at({0, 0, 0}), Space::unknown);
  EXPECT_THROW(static_cast<void>(tree.grid()), Error);
}

TEST(OctomapBt, TheEdgeKeepsAllItsDigits) {
  for (const double edge : {0.05, 1.0 / 3, 0.1 + 0.2, 1e-3, 12345.678}) {
    const OccupancyOctree tree(edge, {{0, 0, Space::free}});
    EXPECT_EQ(decode_bt(encode_bt(tree), "edge").voxel_m(), edge);
  }
}

TEST(OctomapBt, UnprunedTreesStayAsTheyAre) {
  std::vector<Leaf> leaves;
  for (std::uint64_t i = 0; i < 8; ++i) leaves.push_back({i, 0, Space::free});
  const OccupancyOctree tree(0.1, leaves);
  EXPECT_EQ(decode_bt(encode_bt(tree), "unpruned"), tree);
}

TEST(OctomapBt, MapsOffTheLatticeAreRefused) {
  const Box3 box(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1.05));
  EXPECT_REFUSED(encode_bt(DrawnVoxels(VoxelGrid::dividing(box, 0.2), 0.1)), "on_lattice");
  const Box3 shifted(Eigen::Vector3d(0.05, 0, 0), Eigen::Vector3d(1.05, 1, 1));
  EXPECT_THROW(encode_bt(DrawnVoxels(VoxelGrid::dividing(shifted, 0.2), 0.1)), Error);
  EXPECT_THROW(encode_bt(DrawnVoxels(grid({32760, 0, 0}, {9, 1, 1}, 1), 0.1)), Error);
  EXPECT_NO_THROW(encode_bt(DrawnVoxels(grid({32760, -32768, 0}, {8, 1, 1}, 1), 0.1)));
}

TEST(OctomapBt, LeavesThatMakeNoTreeAreRefused) {
  EXPECT_THROW(OccupancyOctree(0, {}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{0, 16, Space::free}}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{0, 0, Space::unknown}}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{1, 1, Space::free}}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{0, 1, Space::free}, {7, 0, Space::free}}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{8, 0, Space::free}, {7, 0, Space::free}}), Error);
  EXPECT_THROW(OccupancyOctree(1, {{std::uint64_t{1} << 48, 0, Space::free}}), Error);
}

TEST(OctomapBt, HostileFilesAreRefusedWithTheirByte) {
  const auto refused = [](const std::string& bytes, const std::string& part) {
    const std::string message = test::message_of([&] { return decode_bt(bytes, "x.bt", {.leaves = 100}); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.rfind("x.bt: ", 0), 0u) << message;
  };
  const std::size_t begin = file(400'000, "").size();
  refused("", "ends at byte 0");
  refused("hello\n", "no OctoMap .bt file");
  refused(title + "id OcTree\nsize 3\n", concat("ends at byte ", title.size() + 17));
  refused(title + "id OcTree\nsize 3\ndata\n", "'res'");
  refused(title + "id ColorOcTree\n", "id OcTree");
  refused(title + "size -3\n", concat("byte ", title.size()));
  refused(title + "size 99999999999999999999\n", "nodes");
  for (const char* edge : {"0", "-1", "nan", "inf", "1e999", "x", ""}) refused(file(1, "", edge), "an edge > 0");
  // What crashes OctoMap 1.9.7: every child an inner node, for ever.
  refused(file(400'000, std::string(400'000, '\xFF')), concat("cut further at byte ", begin + 2 * 15));
  refused(file(3, std::string(400'000, '\xFF')), "node 4");
  refused(file(2, ""), "ends at byte");
  refused(file(2, "\1"), "ends at byte");
  refused(file(2, only_child(0, 3)), "ends at byte");
  refused(file(1, std::string(2, '\0')), "without children");
  refused(file(2, only_child(3, 1) + "x"), "1 bytes after");
  refused(file(3, only_child(3, 1)), "a tree of 2 nodes");
  refused(file(0, only_child(3, 1)), "2 bytes after");
  std::string wide = "\xFF\xFF";
  for (int i = 0; i < 8; ++i) wide += "\xFF\xFF" + std::string(16, '\x55');
  refused(file(1000, wide), "at most 100");
}

TEST(OctomapBt, AnEarlyEndAnywhereIsRefused) {
  const std::string bytes = encode_bt(random_map(5, {-4, -4, -4}, {12, 9, 10}));
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_THROW(decode_bt(bytes.substr(0, n), "cut"), Error) << n;
}

TEST(OctomapBt, FilesLargerThanAllowedAreNotRead) {
  const test::TemporaryFolder folder;
  const DrawnVoxels map = random_map(7, {0, 0, 0}, {9, 9, 9});
  write_bt(folder.path() / "map.bt", map);
  EXPECT_EQ(read_bt(folder.path() / "map.bt"), OccupancyOctree::of(map));
  EXPECT_THROW(read_bt(folder.path() / "map.bt", {.bytes = 20}), Error);
  EXPECT_THROW(read_bt(folder.path() / "none.bt"), Error);
}

TEST(OctomapBt, ARealFileComesBackByteForByte) {
  if (std::string(VANTAGE_DATA_DIR).empty()) GTEST_SKIP() << "VANTAGE_DATA_DIR is not set";
  const std::string path = std::string(VANTAGE_DATA_DIR) + "/sequences/octomap/geb079.bt";
  const std::string bytes = read_file(path, 1 << 20);
  const OccupancyOctree tree = read_bt(path);
  EXPECT_EQ(tree.voxel_m(), 0.08);
  EXPECT_GT(tree.leaves().size(), 400'000u);
  EXPECT_EQ(encode_bt(tree), bytes);
}

}  // namespace
}  // namespace vantage
