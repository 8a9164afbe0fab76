// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <utility>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/convex_hull.hpp>

#include "message_of.hpp"
#include "random_pose.hpp"

namespace vantage {
namespace {

double volume(const ConvexHull& hull) {
  double six = 0;
  for (const auto& [a, b, c] : hull.triangles) six += hull.vertices[a].dot(hull.vertices[b].cross(hull.vertices[c]));
  return six / 6;
}

TEST(ConvexHull, OfACubesCornersAndWhatLiesInIt) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x <= 2; ++x)
    for (int y = 0; y <= 2; ++y)
      for (int z = 0; z <= 2; ++z) points.emplace_back(x, y, z);
  const ConvexHull hull = convex_hull(points);
  EXPECT_NEAR(volume(hull), 8, 1e-12);  // positive: counter-clockwise as seen from outside
}

TEST(ConvexHull, HoldsAllPointsBehindEachFaceAndIsClosed) {
  Rng rng(1);
  for (const double scale : {1e-3, 1.0, 1e4}) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 200; ++i) points.push_back(scale * (test::random_point(rng, 1) + Eigen::Vector3d(3, 2, 1)));
    const ConvexHull hull = convex_hull(points);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : hull.triangles) {
      const Eigen::Vector3d a = hull.vertices[t[0]];
      const Eigen::Vector3d n = (hull.vertices[t[1]] - a).cross(hull.vertices[t[2]] - a).normalized();
      for (const Eigen::Vector3d& p : points) EXPECT_LE(n.dot(p - a), 1e-9 * scale);
      for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
  }
}

TEST(ConvexHull, RefusesWhatHasNoVolume) {
  std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_REFUSED(convex_hull(points), "4 to 1000000");
  points.emplace_back(1, 1, 0);
  EXPECT_REFUSED(convex_hull(points), "plane");
  points.emplace_back(0, 0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_REFUSED(convex_hull(points), "finite");
  EXPECT_THROW((void)convex_hull(std::vector<Eigen::Vector3d>(10, Eigen::Vector3d(1, 2, 3))), Error);
}

}  // namespace
}  // namespace vantage
