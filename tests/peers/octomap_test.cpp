// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// What we write, as OctoMap itself reads it, and the other way round. Without OctoMap (liboctomap-dev) nothing is
// compared, and the tests say so.
#include <cstddef>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/io/octomap_bt.hpp>

#include "drawn_voxels.hpp"

#ifdef VANTAGE_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

namespace vantage {
namespace {

#ifdef VANTAGE_HAS_OCTOMAP

const Eigen::Vector3i low(-13, 4, -40);

test::DrawnVoxels random_map(std::uint64_t seed) {
  Rng rng(seed);
  const Eigen::Vector3i size(37, 21, 45);
  test::DrawnVoxels map(VoxelGrid::on_lattice({0.2 * low.cast<double>(), 0.2 * (low + size).cast<double>()}, 0.2), 0.2);
  map.draw_all([&](const Eigen::Vector3i& v) {
    const Eigen::Vector3i coarse = (v + low + Eigen::Vector3i::Constant(64)) / 8;
    return rng.index(60) == 0 ? Space::occupied : static_cast<Space>((coarse.x() + coarse.y() * coarse.z()) % 3);
  });
  return map;
}
octomap::OcTree read_by_octomap(const std::string& bytes) {
  octomap::OcTree tree(1);
  std::istringstream stream(bytes);
  EXPECT_TRUE(tree.readBinary(stream));
  return tree;
}
std::string written_by_octomap(octomap::OcTree& tree) {
  std::ostringstream stream;
  EXPECT_TRUE(tree.writeBinary(stream));
  return stream.str();
}
Space state(octomap::OcTree& tree, const Eigen::Vector3d& p) {
  const octomap::OcTreeNode* node = tree.search(p.x(), p.y(), p.z());
  return node == nullptr ? Space::unknown : tree.isNodeOccupied(node) ? Space::occupied : Space::free;
}

TEST(OctoMapPeer, ReadsWhatWeWrite) {
  const test::DrawnVoxels map = random_map(1);
  const std::string bytes = encode_bt(map);
  octomap::OcTree theirs = read_by_octomap(bytes);
  EXPECT_EQ(theirs.getResolution(), 0.2);
  EXPECT_EQ(theirs.getNumLeafNodes(), OccupancyOctree::of(map).leaves().size());
  const Eigen::Vector3i size = map.grid().size();
  for (int z = -1; z <= size.z(); ++z)
    for (int y = -1; y <= size.y(); ++y)
      for (int x = -1; x <= size.x(); ++x) {
        const Eigen::Vector3d p = map.grid().centre({x, y, z});
        ASSERT_EQ(state(theirs, p), map.at(p)) << p.transpose();
      }
  EXPECT_EQ(written_by_octomap(theirs), bytes);  // byte for byte: nothing was left to prune
}

TEST(OctoMapPeer, IsReadByUs) {
  octomap::OcTree theirs(0.05);
  Rng rng(2);
  for (int ray = 0; ray < 300; ++ray)
    theirs.insertRay(octomap::point3d(0.1f, -0.2f, 1),
                     octomap::point3d(static_cast<float>(rng.uniform(-2, 2)), static_cast<float>(rng.uniform(-2, 2)),
                                      static_cast<float>(rng.uniform(0, 2))));
  const std::string bytes = written_by_octomap(theirs);
  const OccupancyOctree ours = decode_bt(bytes, "theirs");
  EXPECT_EQ(encode_bt(ours), bytes);
  EXPECT_EQ(ours.leaves().size(), theirs.getNumLeafNodes());
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d p(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-1, 3));
    ASSERT_EQ(ours.at(p), state(theirs, p)) << p.transpose();
  }
}

TEST(OctoMapPeer, AnEmptyTree) {
  octomap::OcTree theirs(0.1);
  const std::string bytes = written_by_octomap(theirs);
  EXPECT_EQ(encode_bt(decode_bt(bytes, "empty")), bytes);
  EXPECT_EQ(read_by_octomap(encode_bt(OccupancyOctree(0.1, {}))).size(), 0u);
}

#else

TEST(OctoMapPeer, IsNotHere) { GTEST_SKIP() << "built without OctoMap"; }

#endif

}  // namespace
}  // namespace vantage
