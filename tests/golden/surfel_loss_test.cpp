// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The loss of a rendered frame (eq. 6.5) against an independent float64 reference: case B, 20 surfels on 32 x 32 px.
// That reference has the rays of its normals half a pixel further right and down than pixels' centres: cx, cy + 0.5.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <vantage/io/npy.hpp>
#include <vantage/maps/surfel/surfel_loss.hpp>

#include "golden.hpp"
#include "surfel_images.hpp"

namespace vantage::test {
namespace {

constexpr int size_px = 32;

std::vector<Image<double>> images(const std::string& name) {
  const auto values = read_npy(golden("surfel/case_B/" + name + ".npy")).values<double>(name);
  std::vector<Image<double>> all(values.size() / (size_px * size_px), Image<double>(size_px, size_px));
  for (std::size_t i = 0; i < values.size(); ++i)
    all[i / (size_px * size_px)].data()[i % (size_px * size_px)] = values[i];
  return all;
}

struct GoldenSurfelLoss : Golden {
  GoldenSurfelLoss() : Golden("surfel/case_B") {}
  static Camera camera() {
    constexpr double f = 27.71281292110204;
    return {size_px, size_px, f, f, size_px / 2 + 0.5, size_px / 2 + 0.5};
  }
  static double published(const std::string& term) {
    return named_numbers(text_of(golden("surfel/case_B/loss.csv"))).at(term).at(0);
  }
  template <class T>
  static SurfelImages<T> drawn() {
    const auto c = images("C"), d = images("D"), n = images("N"), o = images("O");
    return {c[0].cast<T>(), c[1].cast<T>(), c[2].cast<T>(), d[0].cast<T>(),
            o[0].cast<T>(), n[0].cast<T>(), n[1].cast<T>(), n[2].cast<T>()};
  }
  template <class T>
  static ColourDepth<T> target() {
    const auto c = images("target_C"), d = images("target_D");
    return {{c[0].cast<T>(), c[1].cast<T>(), c[2].cast<T>()}, d[0].cast<T>().max(T(0))};
  }
};

TEST_F(GoldenSurfelLoss, TermsAndTheirSum) {
  SurfelGradientImages<double> gradient;
  const SurfelLoss<EdgeAwareVariation, double> loss;
  const LossTerms terms = loss(camera(), drawn<double>(), target<double>(), gradient);
  EXPECT_NEAR(terms.colour, published("activegs_lc"), 1e-12);
  EXPECT_NEAR(terms.depth, published("activegs_ld"), 1e-12);
  EXPECT_NEAR(terms.consistency, published("activegs_cons"), 1e-12);
  EXPECT_NEAR(terms.smoothness, published("activegs_tv"), 1e-12);
  EXPECT_NEAR(terms.total(loss.weights()), published("activegs"), 1e-12);
}

template <class T>
void compare(const SurfelGradientImages<T>& gradient, double tolerance) {
  const auto near = [&](const Image<T>& ours, const Image<double>& theirs, const char* name) {
    EXPECT_LT((ours.template cast<double>() - theirs).abs().maxCoeff(), tolerance * theirs.abs().maxCoeff()) << name;
  };
  const auto c = images("dL_dC_activegs"), d = images("dL_dD_activegs"), n = images("dL_dN_activegs");
  near(gradient.colour.r, c[0], "red");
  near(gradient.colour.g, c[1], "green");
  near(gradient.colour.b, c[2], "blue");
  near(gradient.depth, d[0], "depth");
  near(gradient.normal_x, n[0], "normal x");
  near(gradient.normal_y, n[1], "normal y");
  near(gradient.normal_z, n[2], "normal z");
}

TEST_F(GoldenSurfelLoss, GradientsByTheImages) {
  SurfelGradientImages<double> gradient;
  SurfelLoss<EdgeAwareVariation, double>{}(camera(), drawn<double>(), target<double>(), gradient);
  compare(gradient, 1e-10);
}

TEST_F(GoldenSurfelLoss, InFloatAsWell) {
  SurfelGradientImages<float> gradient;
  const SurfelLoss<> loss;
  const LossTerms terms = loss(camera(), drawn<float>(), target<float>(), gradient);
  EXPECT_NEAR(terms.total(loss.weights()), published("activegs"), 2e-6);
  compare(gradient, 1e-3);
}

TEST_F(GoldenSurfelLoss, NormalsOfTheRenderedDepth) {
  const auto depth = images("D"), opacity = images("O"), expected = images("N_from_depth");
  PaddedRows<double> rows;
  rows.resize(2, size_px + 2, size_px);
  for (Eigen::Index v = 0; v < size_px; ++v) {
    rows(0, v + 1) = depth[0].row(v);
    rows(1, v + 1) = (opacity[0].row(v) > 0.01).cast<double>();
  }
  DepthNormalRows<double> surface;
  const PixelRays<double> rays(camera());
  for (Eigen::Index v = 0; v < size_px; ++v) {
    surface(rows, 0, 1, v + 1, rays, v);
    const auto valid = rows(1, v + 1);
    EXPECT_LT((valid * surface.n.x - expected[0].row(v)).abs().maxCoeff(), 1e-12);
    EXPECT_LT((valid * surface.n.y - expected[1].row(v)).abs().maxCoeff(), 1e-12);
    EXPECT_LT((valid * surface.n.z - expected[2].row(v)).abs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace vantage::test
