// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/delaunay.hpp>

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

std::vector<Eigen::Vector2d> cloud(std::size_t n, std::uint64_t seed, double scale = 1,
                                   Eigen::Vector2d shift = {0, 0}) {
  Rng rng(seed);
  std::vector<Eigen::Vector2d> points(n);
  for (Eigen::Vector2d& p : points) p = shift + scale * Eigen::Vector2d(rng.uniform(), rng.uniform());
  return points;
}
double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }
double area_of(const std::vector<Eigen::Vector2d>& p, const Triangle& t) {
  return std::abs(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
}

double hull_area(std::vector<Eigen::Vector2d> p) {  // monotone chain
  std::sort(p.begin(), p.end(),
            [](const auto& a, const auto& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
  std::vector<Eigen::Vector2d> h;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = h.size();
    for (const auto& q : p) {
      while (h.size() >= start + 2 && cross(h.back() - h[h.size() - 2], q - h.back()) <= 0) h.pop_back();
      h.push_back(q);
    }
    h.pop_back();
    std::reverse(p.begin(), p.end());
  }
  double sum = 0;
  for (std::size_t i = 0; i < h.size(); ++i) sum += cross(h[i], h[(i + 1) % h.size()]) / 2;
  return sum;
}

TEST(Delaunay, TilesTheHullWithEmptyCircles) {
  for (const std::size_t n : {3u, 4u, 10u, 150u}) {
    const auto points = cloud(n, n);
    const auto triangles = delaunay(points);
    double sum = 0;
    for (const Triangle& t : triangles) {
      sum += area_of(points, t);
      const Eigen::Vector2d a = points[t[0]], b = points[t[1]] - a, c = points[t[2]] - a;
      const double d = 2 * cross(b, c);
      const Eigen::Vector2d o = Eigen::Vector2d(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(),
                                                b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) /
                                d;
      for (const auto& p : points) EXPECT_GE((p - a - o).norm(), o.norm() * (1 - 1e-9));
    }
    EXPECT_NEAR(sum, hull_area(points), 1e-12);
  }
}

TEST(Delaunay, TilesLatticesWhoseCirclesAreShared) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 9; ++j) points.emplace_back(180000.0 + 10 * i, 330000.0 + 10 * j);
  double sum = 0;
  std::set<std::size_t> used;
  for (const Triangle& t : delaunay(points)) {
    sum += area_of(points, t);
    used.insert(t.begin(), t.end());
  }
  EXPECT_NEAR(sum, 110.0 * 80.0, 1e-6);
  EXPECT_EQ(used.size(), points.size());
}

TEST(Delaunay, RefusesWhatHasNoTriangle) {
  EXPECT_THROW(delaunay({}), Error);
  EXPECT_THROW(delaunay(cloud(2, 1)), Error);
  EXPECT_THROW(delaunay(std::vector<Eigen::Vector2d>(10, Eigen::Vector2d(1, 1))), Error);
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i < 10; ++i) line.emplace_back(i, 2.0 * i + 1);
  testing::internal::CaptureStderr();
  EXPECT_THROW(delaunay(line), Error);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "headers never print";
  auto bad = cloud(10, 1);
  bad[3].x() = std::nan("");
  EXPECT_THROW(delaunay(bad), Error);
}

std::vector<FieldSample> samples_of(const std::vector<Eigen::Vector2d>& points, double a, double b, double c) {
  std::vector<FieldSample> samples;
  for (const auto& p : points) samples.push_back({p, a + b * p.x() + c * p.y()});
  return samples;
}

TEST(InterpolateScattered, ReproducesAPlaneInsideTheHullAndMasksTheRest) {
  const Box2 area_m{Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 10)};
  for (const std::size_t n : {3u, 20u, 1000u}) {
    const auto points = cloud(n, 100 + n, 8, {3, 1});
    const Image<double> image = interpolate_scattered(samples_of(points, 5, -2, 3), area_m, 100, 200);
    Eigen::Index inside = 0;
    for (Eigen::Index row = 0; row < 100; ++row)
      for (Eigen::Index column = 0; column < 200; ++column) {
        const Eigen::Vector2d p(0.1 * (static_cast<double>(column) + 0.5), 0.1 * (static_cast<double>(row) + 0.5));
        if (std::isnan(image(row, column))) continue;
        ++inside;
        EXPECT_NEAR(image(row, column), 5 - 2 * p.x() + 3 * p.y(), 1e-9);
      }
    EXPECT_NEAR(static_cast<double>(inside) * 0.01, hull_area(points),
                0.01 * 3 * std::sqrt(static_cast<double>(inside)) + 0.3)
        << n;
  }
}

// Every pixel by the obvious search for the triangle that holds it.
TEST(InterpolateScattered, AgreesWithTheObviousSearch) {
  const Box2 area_m{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};
  Rng rng(6);
  auto points = cloud(60, 11, 1.4, {-0.2, -0.2});  // reaches beyond the raster
  std::vector<FieldSample> samples;
  for (const auto& p : points) samples.push_back({p, rng.normal()});
  const Image<double> image = interpolate_scattered(samples, area_m, 50, 50);
  const auto triangles = delaunay(points);
  for (Eigen::Index row = 0; row < 50; ++row)
    for (Eigen::Index column = 0; column < 50; ++column) {
      const Eigen::Vector2d p((static_cast<double>(column) + 0.5) / 50, (static_cast<double>(row) + 0.5) / 50);
      double expected = std::nan("");
      for (const Triangle& t : triangles) {
        const double d = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
        const double u = cross(p - points[t[0]], points[t[2]] - points[t[0]]) / d,
                     v = cross(points[t[1]] - points[t[0]], p - points[t[0]]) / d;
        if (u >= 0 && v >= 0 && u + v <= 1)
          expected = (1 - u - v) * samples[t[0]].value + u * samples[t[1]].value + v * samples[t[2]].value;
      }
      if (std::isnan(expected))
        EXPECT_TRUE(std::isnan(image(row, column)));
      else
        EXPECT_NEAR(image(row, column), expected, 1e-10);
    }
}

TEST(InterpolateScattered, LeavesNoGapBetweenTriangles) {
  std::vector<Eigen::Vector2d> points;  // corners on pixel centres: every edge runs through centres
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) points.emplace_back(0.5 + 4 * i, 0.5 + 4 * j);
  const Image<double> image =
      interpolate_scattered(samples_of(points, 1, 1, 1), {Eigen::Vector2d(0, 0), Eigen::Vector2d(21, 21)}, 21, 21);
  EXPECT_TRUE(image.isFinite().all());
}

}  // namespace
}  // namespace vantage
