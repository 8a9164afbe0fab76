// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Gradients of the surfel loss against central differences in double, and what it does at edges.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include <tbb/task_arena.h>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/surfel_loss.hpp>

#include "surfel_images.hpp"

namespace vantage::test {
namespace {

const Camera camera = {21, 37, 25, 24, 10.2, 18.9};  // more than two blocks of rows

// Slanted, rippled depth; a hole in the measured one, and pixels of little and of no opacity.
template <class T>
SurfelImages<T> drawn(Rng rng) {
  SurfelImages<T> s;
  for (Image<T>* i : {&s.r, &s.g, &s.b, &s.depth, &s.opacity, &s.x, &s.y, &s.z}) i->resize(camera.height, camera.width);
  for (Eigen::Index v = 0; v < s.r.rows(); ++v)
    for (Eigen::Index u = 0; u < s.r.cols(); ++u) {
      const double opacity = v < 5 && u < 4 ? 0.005 : v > 30 && u > 15 ? 0 : rng.uniform(0.3, 1);
      s.r(v, u) = static_cast<T>(rng.uniform()), s.g(v, u) = static_cast<T>(rng.uniform());
      s.b(v, u) = static_cast<T>(rng.uniform());
      s.depth(v, u) = static_cast<T>(1 + 0.002 * static_cast<double>(u) - 0.003 * static_cast<double>(v) +
                                     (u > 12 ? 0.3 : 0) + 0.001 * rng.uniform());
      s.opacity(v, u) = static_cast<T>(opacity);
      s.x(v, u) = static_cast<T>(0.3 * rng.uniform()), s.y(v, u) = static_cast<T>(0.3 * rng.uniform());
      s.z(v, u) = static_cast<T>(-rng.uniform(0.5, 1));
    }
  return s;
}
template <class T>
ColourDepth<T> target(Rng rng) {
  ColourDepth<T> t;
  for (Image<T>* i : {&t.planes[0], &t.planes[1], &t.planes[2], &t.metres}) {
    i->resize(camera.height, camera.width);
    for (Eigen::Index k = 0; k < i->size(); ++k) i->data()[k] = static_cast<T>(rng.uniform(0.01, 1.3));
  }
  t.metres.block(8, 3, 5, 6).setZero();
  return t;
}

template <class Variation>
void by_central_differences() {
  const SurfelLoss<Variation, double> loss(LossWeights{1.3, 0.8, 0.7, 0.9});
  const ColourDepth<double> t = target<double>(Rng(2));
  SurfelImages<double> s = drawn<double>(Rng(1));
  SurfelGradientImages<double> gradient, unused;
  loss(camera, s, t, gradient);
  const auto check = [&](Image<double>& image, const Image<double>& ours, std::string_view name) {
    Rng rng(3);
    for (int k = 0; k < 150; ++k) {
      const auto i = static_cast<Eigen::Index>(rng.index(static_cast<std::uint64_t>(image.size())));
      double& x = image.data()[i];
      const double old = x, h = 1e-6;
      x = old + h;
      const double above = loss(camera, s, t, unused).total(loss.weights());
      x = old - h;
      const double below = loss(camera, s, t, unused).total(loss.weights());
      x = old;
      EXPECT_NEAR(ours.data()[i], (above - below) / (2 * h), 2e-8) << name << " " << i;
    }
  };
  check(s.r, gradient.colour.r, "red");
  check(s.b, gradient.colour.b, "blue");
  check(s.depth, gradient.depth, "depth");
  check(s.x, gradient.normal_x, "normal x");
  check(s.y, gradient.normal_y, "normal y");
  check(s.z, gradient.normal_z, "normal z");
  check(s.opacity, Image<double>::Zero(camera.height, camera.width), "opacity");
}

TEST(SurfelLoss, GradientsOfTheEdgeAwareLossAreThoseOfCentralDifferences) {
  by_central_differences<EdgeAwareVariation>();
}
TEST(SurfelLoss, GradientsOfThePlainLossAreThoseOfCentralDifferences) { by_central_differences<PlainVariation>(); }

TEST(SurfelLoss, FloatIsNearDouble) {
  const SurfelLoss<EdgeAwareVariation, float> single;
  const SurfelLoss<EdgeAwareVariation, double> exact;
  SurfelGradientImages<float> g;
  SurfelGradientImages<double> h;
  const double ours = single(camera, drawn<float>(Rng(1)), target<float>(Rng(2)), g).total(single.weights());
  const double expected = exact(camera, drawn<double>(Rng(1)), target<double>(Rng(2)), h).total(exact.weights());
  EXPECT_NEAR(ours, expected, 1e-5 * expected);
  EXPECT_LT((g.depth.cast<double>() - h.depth).abs().maxCoeff(), 2e-3 * h.depth.abs().maxCoeff());
  EXPECT_LT((g.normal_x.cast<double>() - h.normal_x).abs().maxCoeff(), 2e-3 * h.normal_x.abs().maxCoeff());
}

TEST(SurfelLoss, NothingRenderedGivesFiniteNumbers) {
  SurfelImages<float> s = drawn<float>(Rng(1));
  s.opacity.setZero();
  s.x.setZero(), s.y.setZero(), s.z.setZero();
  s.depth.setConstant(std::numeric_limits<float>::quiet_NaN());
  SurfelGradientImages<float> g;
  const LossTerms terms = SurfelLoss<>{}(camera, s, target<float>(Rng(2)), g);
  EXPECT_EQ(terms.colour, 0);
  EXPECT_EQ(terms.consistency, 0);
  EXPECT_GT(terms.depth, 0);
  EXPECT_TRUE(std::isfinite(terms.depth) && std::isfinite(terms.smoothness));
  EXPECT_TRUE(g.depth.isFinite().all() && g.normal_x.isFinite().all() && g.colour.r.isFinite().all());
}

TEST(SurfelLoss, ImagesOfOnePixelOrOneRow) {
  for (const Camera& tiny : {Camera{1, 1, 5, 5, 0.5, 0.5}, Camera{7, 1, 5, 5, 3, 0.5}, Camera{1, 9, 5, 5, 0.5, 4}}) {
    SurfelImages<float> s;
    ColourDepth<float> t;
    for (Image<float>* i : {&s.r, &s.g, &s.b, &s.depth, &s.opacity, &s.x, &s.y, &s.z})
      i->setOnes(tiny.height, tiny.width);
    for (Image<float>* i : {&t.planes[0], &t.planes[1], &t.planes[2], &t.metres})
      i->setConstant(tiny.height, tiny.width, 0.5F);
    SurfelGradientImages<float> g;
    const LossTerms terms = SurfelLoss<>{}(tiny, s, t, g);
    EXPECT_FLOAT_EQ(static_cast<float>(terms.colour), 0.5F);
    EXPECT_FLOAT_EQ(static_cast<float>(terms.depth), 0.5F);
    EXPECT_TRUE(g.depth.isFinite().all() && g.normal_z.isFinite().all());
  }
}

TEST(SurfelLoss, TheSameBitsWithAnyNumberOfThreads) {
  const auto run = [](int threads) {
    SurfelGradientImages<float> g;
    LossTerms terms;
    tbb::task_arena(threads).execute(
        [&] { terms = SurfelLoss<>{}(camera, drawn<float>(Rng(1)), target<float>(Rng(2)), g); });
    return std::pair(terms.total({}), g);
  };
  const auto [one, g] = run(1);
  const auto [two, h] = run(2);
  EXPECT_EQ(one, two);
  EXPECT_TRUE((g.depth == h.depth).all() && (g.normal_y == h.normal_y).all() && (g.colour.g == h.colour.g).all());
}

}  // namespace
}  // namespace vantage::test
