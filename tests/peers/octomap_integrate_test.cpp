// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#ifdef VANTAGE_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

#include <cmath>
#include <cstddef>

#include <vantage/core/rng.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "voxel_scenes.hpp"

namespace vantage {
namespace {

#ifdef VANTAGE_HAS_OCTOMAP
// The same frames into OctoMap 1.9.7, discretised, and into ours: the same voxels are known, free and occupied, except
// where rounding decides which of two voxels a point or a ray that passes an edge belongs to (OctoMap walks in single
// precision). Measured: none of 58 thousand; a few in ten thousand are allowed for other compilers' rounding.
TEST(OctoMapPeer, KnowsTheVoxelsThatWeKnow) {
  for (const double voxel_m : {0.2, 0.1, 0.05}) {
    VoxelMap<RayCast>::Config config;
    config.bounds = Box3(test::small_room.min().array() - 0.4, test::small_room.max().array() + 0.4);
    config.voxel_m = voxel_m;
    VoxelMap<RayCast> map(config);
    octomap::OcTree tree(voxel_m);
    tree.setProbHit(octomap::probability(config.update.hit));
    tree.setProbMiss(octomap::probability(config.update.miss));
    tree.setClampingThresMin(config.update.least);
    tree.setClampingThresMax(config.update.most);
    for (std::uint64_t k = 0; k < 8; ++k) {
      const Frame f = test::random_frame(Rng(8).fork(k), 60);
      octomap::Pointcloud points;
      for (int v = 0; v < f.camera.height; ++v)
        for (int u = 0; u < f.camera.width; ++u) {
          if (std::isnan(f.depth(v, u))) continue;
          const Eigen::Vector3f p =
              (f.view.T_W_C * Eigen::Vector3d(f.depth(v, u) * f.camera.ray(u + 0.5, v + 0.5))).cast<float>();
          points.push_back(p.x(), p.y(), p.z());
        }
      const Eigen::Vector3f eye = f.view.position().cast<float>();
      tree.insertPointCloud(points, octomap::point3d(eye.x(), eye.y(), eye.z()), -1, true, true);
      map.integrate(f);
    }
    tree.expand();
    std::size_t differ = 0, known = 0, theirs = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) ++theirs;
    for (int z = 0; z < map.grid().size().z(); ++z)
      for (int y = 0; y < map.grid().size().y(); ++y)
        for (int x = 0; x < map.grid().size().x(); ++x) {
          const Eigen::Vector3d p = map.grid().centre({x, y, z});
          const octomap::OcTreeNode* node = tree.search(p.x(), p.y(), p.z());
          const Space expected = !node ? Space::unknown : tree.isNodeOccupied(node) ? Space::occupied : Space::free;
          differ += map.state({x, y, z}) != expected;
          known += node != nullptr;
        }
    EXPECT_EQ(known, theirs) << "the same lattice: no voxel of OctoMap's lies beside the grid";
    EXPECT_GT(known, 500U);
    EXPECT_LE(static_cast<double>(differ), 2e-4 * static_cast<double>(known)) << "of " << known << " at " << voxel_m;
  }
}

#endif

}  // namespace
}  // namespace vantage
