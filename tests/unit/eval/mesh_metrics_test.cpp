// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/mesh_metrics.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "eval_reference.hpp"
#include "mesh_topology.hpp"

namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

MeshMetrics compare(const TriangleMesh& estimate, const TriangleMesh& truth, const MeshComparison& how = {},
                    std::size_t true_points = 20'000) {
  return mesh_metrics(estimate, truth, sample_surface(truth, true_points, Rng(1)), how, Rng(2));
}

TEST(NearestPoints, AgreesWithScipy) {
  const auto cloud = [](std::size_t n, std::uint32_t seed) {
    const std::vector<double> x = test::hashed(3 * n, seed);
    std::vector<Eigen::Vector3f> points(n);
    for (std::size_t i = 0; i < n; ++i) points[i] = Eigen::Vector3d(x[3 * i], x[3 * i + 1], x[3 * i + 2]).cast<float>();
    return points;
  };
  for (const auto& c : test::reference("points")) {
    const auto a = cloud(c.at("n"), c.at("seed").get<std::uint32_t>()),
               b = cloud(c.at("m"), c.at("seed").get<std::uint32_t>() + 1);
    const double threshold = c.at("threshold");
    const auto measure = [&](const auto& from, const auto& to) {
      double mean = 0, within = 0;
      std::size_t indices = 0;
      for (const NearestPoints::Found& f : NearestPoints(to)(from)) {
        mean += static_cast<double>(f.distance_m) / static_cast<double>(from.size());
        within += static_cast<double>(f.distance_m) < threshold;
        indices += f.index;
      }
      return std::tuple(mean, within / static_cast<double>(from.size()), indices);
    };
    const auto [to_b, within_of_b, indices] = measure(a, b);
    const auto [to_a, within_of_a, unused] = measure(b, a);
    EXPECT_NEAR(to_b, c.at("mean_to_b").get<double>(), 1e-7);
    EXPECT_NEAR(to_a, c.at("mean_to_a").get<double>(), 1e-7);
    EXPECT_DOUBLE_EQ(within_of_b, c.at("within_of_b").get<double>());
    EXPECT_DOUBLE_EQ(within_of_a, c.at("within_of_a").get<double>());
    EXPECT_EQ(indices, c.at("index_sum").get<std::size_t>());
  }
}

TEST(NearestPoints, Refuses) {
  const std::vector<Eigen::Vector3f> none, bad{{0, 0, 0}, {nan, 0, 0}}, one{{1, 2, 3}};
  EXPECT_THROW(NearestPoints{none}, Error);
  EXPECT_THROW(NearestPoints{bad}, Error);
  const NearestPoints tree(one);
  EXPECT_THROW(static_cast<void>(tree(bad)), Error);
  EXPECT_EQ(tree(Eigen::Vector3f(1, 2, 5)).distance_m, 2);
}

TEST(MeshMetrics, NearestPointOfATriangle) {
  // Against the least of many points of the triangle.
  Rng rng(5);
  const auto random = [&] { return Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)); };
  for (int i = 0; i < 200; ++i) {
    const std::array<Eigen::Vector3d, 3> t{random(), random(), random()};
    const Eigen::Vector3d p = 2 * random();
    const double found = (p - mesh_metrics_detail::nearest_on_triangle(t, p)).norm();
    double least = 1e9;
    for (int a = 0; a <= 100; ++a)
      for (int b = 0; a + b <= 100; ++b)
        least = std::min(least, (p - (a * t[0] + b * t[1] + (100 - a - b) * t[2]) / 100).norm());
    ASSERT_LE(found, least + 1e-9);
    ASSERT_GE(found, least - 0.03);
  }
  const std::array<Eigen::Vector3d, 3> line{Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {3, 0, 0}};
  EXPECT_TRUE(mesh_metrics_detail::nearest_on_triangle(line, {2, 1, 0}).isApprox(Eigen::Vector3d(2, 0, 0)));
}

TEST(MeshMetrics, ParallelPlanesAreTheirDistanceApart) {
  const MeshMetrics m =
      compare(test::rectangle(0, 0, 1, 1, 0.015), test::rectangle(0, 0, 1, 1, 0), {.samples = 20'000});
  EXPECT_NEAR(m.accuracy_m, 0.015, 1e-6);
  EXPECT_NEAR(m.completeness_m, 0.015, 1e-6);
  EXPECT_EQ(m.precision, 1);
  EXPECT_EQ(m.completeness, 1);
  EXPECT_EQ(m.f1, 1);
  const MeshMetrics strict = compare(test::rectangle(0, 0, 1, 1, 0.015), test::rectangle(0, 0, 1, 1, 0),
                                     {.threshold_m = 0.01, .samples = 20'000});
  EXPECT_EQ(strict.precision, 0);
  EXPECT_EQ(strict.f1, 0);
}

TEST(MeshMetrics, HalfOfASquare) {
  // The estimate has the left half and the same area again, far away: a strip of 2 cm counts beside the half.
  TriangleMesh estimate = test::rectangle(0, 0, 0.5, 1, 0);
  const TriangleMesh away = test::rectangle(5, 0, 5.5, 1, 0);
  estimate.vertices.insert(estimate.vertices.end(), away.vertices.begin(), away.vertices.end());
  for (const auto& t : away.triangles) estimate.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  const MeshMetrics m = compare(estimate, test::rectangle(0, 0, 1, 1, 0), {.samples = 20'000});
  EXPECT_NEAR(m.precision, 0.5, 1e-3);
  EXPECT_NEAR(m.completeness, 0.52, 2e-3);
  EXPECT_NEAR(m.completeness_m, 0.125, 2e-3) << "the mean of 0 on one half and of 0 to 0.5 on the other";
  EXPECT_NEAR(m.accuracy_m, 0.5 * 4.25, 0.01);
  EXPECT_DOUBLE_EQ(m.f1, 2 * m.precision * m.completeness / (m.precision + m.completeness));
}

TEST(MeshMetrics, ConcentricSpheres) {
  const TriangleMesh small = test::sphere_mesh({1, 2, 3}, 0.50, 60), large = test::sphere_mesh({1, 2, 3}, 0.53, 60);
  const MeshMetrics m = compare(small, large, {.threshold_m = 0.035, .samples = 50'000}, 50'000);
  EXPECT_NEAR(m.accuracy_m, 0.03, 3e-4);
  EXPECT_NEAR(m.completeness_m, 0.03, 3e-4);
  EXPECT_EQ(m.f1, 1);
}

TEST(MeshMetrics, DistancesToPointsHaveAFloor) {
  // Of a square against itself: 0.5 / sqrt(density) for independent points.
  const TriangleMesh square = test::rectangle(0, 0, 1, 1, 0);
  const MeshMetrics points = compare(square, square, {.samples = 10'000, .to = MeshComparison::To::points}, 10'000);
  EXPECT_NEAR(points.completeness_m, 0.005, 0.0005);
  EXPECT_NEAR(points.accuracy_m, 0.005, 0.0005);
  const MeshMetrics surface = compare(square, square, {.samples = 10'000}, 10'000);
  EXPECT_LT(surface.completeness_m, 2e-6);
  EXPECT_LT(surface.accuracy_m, 2e-6);
}

TEST(MeshMetrics, NeitherFewSamplesNorSmallTrianglesMakeAFloor) {
  // A fine mesh with one sample for 20 triangles, against itself in two triangles.
  TriangleMesh fine;
  const std::uint32_t n = 100;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x)
      fine.vertices.emplace_back(static_cast<float>(x) / n, static_cast<float>(y) / n, 0.0F);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t i = y * (n + 1) + x;
      fine.triangles.push_back({i, i + 1, i + n + 2});
      fine.triangles.push_back({i, i + n + 2, i + n + 1});
    }
  const MeshMetrics m = compare(fine, test::rectangle(0, 0, 1, 1, 0), {.samples = 1000}, 20'000);
  EXPECT_LT(m.completeness_m, 2e-5) << "the samples are 16 mm apart";
  EXPECT_LT(m.accuracy_m, 2e-5);
}

TEST(MeshMetrics, OnlyTheTrueSamplesGivenCount) {
  // A box with a lid that nobody sees: the estimate lacks it, and is complete all the same.
  TriangleMesh truth = test::rectangle(0, 0, 1, 1, 0);
  const TriangleMesh lid = test::rectangle(0, 0, 1, 1, 1);
  truth.vertices.insert(truth.vertices.end(), lid.vertices.begin(), lid.vertices.end());
  for (const auto& t : lid.triangles) truth.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  const SurfaceSamples all = sample_surface(truth, 10'000, Rng(1));
  std::vector<std::uint8_t> low;
  for (const Eigen::Vector3f& p : all.points) low.push_back(p.z() < 0.5F);
  const TriangleMesh floor = test::rectangle(0, 0, 1, 1, 0);
  const MeshComparison how{.samples = 10'000};
  EXPECT_NEAR(mesh_metrics(floor, truth, all, how, Rng(2)).completeness, 0.5, 1e-3);
  EXPECT_EQ(mesh_metrics(floor, truth, all.where(low), how, Rng(2)).completeness, 1);
}

TEST(MeshMetrics, AnEmptyEstimateIsNoneOfTheTruth) {
  TriangleMesh degenerate = test::rectangle(0, 0, 1, 1, 0);
  degenerate.triangles = {{0, 1, 1}};
  for (const TriangleMesh& estimate : {TriangleMesh{}, degenerate}) {
    const MeshMetrics m = compare(estimate, test::rectangle(0, 0, 1, 1, 0));
    EXPECT_EQ(m.completeness, 0);
    EXPECT_EQ(m.precision, 0);
    EXPECT_EQ(m.f1, 0);
    EXPECT_TRUE(std::isnan(m.accuracy_m) && std::isnan(m.completeness_m));
  }
}

TEST(MeshMetrics, DoNotDependOnTheThreads) {
  const TriangleMesh small = test::sphere_mesh({1, 2, 3}, 0.50, 20), large = test::sphere_mesh({1, 2, 3}, 0.52, 30);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      const MeshMetrics m = compare(small, large, {.samples = 20'000});
      return std::array{m.accuracy_m, m.completeness_m, m.precision, m.completeness, m.f1};
    });
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1), run(8));
}

TEST(MeshMetrics, Refuse) {
  const TriangleMesh good = test::rectangle(0, 0, 1, 1, 0);
  TriangleMesh bad = good;
  bad.vertices[1].z() = nan;
  const SurfaceSamples samples = sample_surface(good, 100, Rng(1));
  EXPECT_THROW(static_cast<void>(mesh_metrics(bad, good, samples, {}, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, bad, samples, {}, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, good, {}, {}, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, good, samples, {.threshold_m = 0}, Rng(1))), Error);
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, good, samples, {.samples = 0}, Rng(1))), Error);
  SurfaceSamples strange = samples;
  strange.triangles[5] = 2;
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, good, strange, {}, Rng(1))), Error);
  strange = samples;
  strange.points[5].x() = nan;
  EXPECT_THROW(static_cast<void>(mesh_metrics(good, good, strange, {}, Rng(1))), Error);
}

}  // namespace
}  // namespace vantage
