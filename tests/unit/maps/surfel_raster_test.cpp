// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The fast rasteriser of surfels against the slow one, image by image and gradient by gradient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "surfel_scenes.hpp"

#include <vantage/maps/surfel/reference_rasteriser.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>

namespace {

using namespace vantage;
using test::any_raster_view;
using test::any_surfels;

using Everything = Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Opacity, channel::Confidence>;
static_assert(SurfelRasteriser<ReferenceRasteriser<double>> && SurfelRasteriser<ReferenceRasteriser<float>>);
static_assert(SurfelRasteriser<TileRasteriser<>> && SurfelRasteriser<TileRasteriser<32, RayPlaneDepth>>);

template <class Fast, class Slow>
struct Pair {
  using Rasteriser = Fast;
  using Reference = Slow;
};
template <class P>
class SurfelRaster : public testing::Test {};
using Pairs = testing::Types<Pair<TileRasteriser<16>, ReferenceRasteriser<double>>,
                             Pair<TileRasteriser<8>, ReferenceRasteriser<double>>,
                             Pair<TileRasteriser<32>, ReferenceRasteriser<double>>,
                             Pair<TileRasteriser<16, RayPlaneDepth>, ReferenceRasteriser<double, RayPlaneDepth>>>;
TYPED_TEST_SUITE(SurfelRaster, Pairs);

// A surfel whose alpha is within a rounding of 1/255 may be drawn by one and not the other: few pixels.
void expect_same(const Image<float>& ours, const Image<float>& theirs, double tolerance, const char* name) {
  ASSERT_EQ(ours.rows(), theirs.rows());
  ASSERT_EQ(ours.cols(), theirs.cols());
  Eigen::Index off = 0;
  for (Eigen::Index i = 0; i < ours.size(); ++i) {
    const double a = ours.data()[i], b = theirs.data()[i];
    if (std::isnan(a) && std::isnan(b)) continue;
    const double error = std::abs(a - b);
    if (!(error <= tolerance * std::max(1.0, std::abs(b)))) ++off;
    EXPECT_LE(error, 0.01 * std::max(1.0, std::abs(b))) << name << " at " << i;
  }
  EXPECT_LE(off, 1 + ours.size() / 2000) << name;
}
void expect_same(const Everything& ours, const Everything& theirs) {
  const channel::Colour &c = ours, &cc = theirs;
  const channel::Normal &n = ours, &nn = theirs;
  expect_same(c.r, cc.r, 2e-5, "red");
  expect_same(c.g, cc.g, 2e-5, "green");
  expect_same(c.b, cc.b, 2e-5, "blue");
  expect_same(ours.depth, theirs.depth, 2e-4, "depth");
  expect_same(n.x, nn.x, 2e-5, "normal x");
  expect_same(n.y, nn.y, 2e-5, "normal y");
  expect_same(n.z, nn.z, 2e-5, "normal z");
  expect_same(ours.opacity, theirs.opacity, 2e-5, "opacity");
  expect_same(ours.confidence, theirs.confidence, 2e-5, "confidence");
}

ImageGradient any_gradient(const Camera& camera, std::uint64_t seed) {
  Rng rng(seed);
  const auto image = [&] {
    Image<float> g(camera.height, camera.width);
    for (float& v : g.reshaped()) v = static_cast<float>(rng.uniform(-1, 1));
    return g;
  };
  return {{image(), image(), image()}, image(), image(), image(), image(), image()};
}

TYPED_TEST(SurfelRaster, DrawsWhatTheReferenceDraws) {
  for (const auto& [w, h] : {std::pair{64, 48}, {61, 45}, {1, 1}, {17, 3}, {130, 70}}) {
    const Surfels s = any_surfels(600, 7);
    RasterView view = any_raster_view(w, h);
    for (const bool front_only : {false, true}) {
      view.front_only = front_only;
      typename TypeParam::Rasteriser::Pass pass;
      typename TypeParam::Reference::Pass reference_pass;
      Everything ours, theirs;
      typename TypeParam::Rasteriser{}.forward(s, view, pass, ours);
      typename TypeParam::Reference{}.forward(s, view, reference_pass, theirs);
      expect_same(ours, theirs);
    }
  }
}

TYPED_TEST(SurfelRaster, Gradients) {
  for (const auto& [w, h] : {std::pair{64, 48}, {61, 45}}) {
    const Surfels s = any_surfels(300, 8);
    const RasterView view = any_raster_view(w, h);
    const ImageGradient d = any_gradient(view.camera, 3);
    typename TypeParam::Rasteriser::Pass pass;
    typename TypeParam::Reference::Pass reference_pass;
    Everything ours, theirs;
    typename TypeParam::Rasteriser{}.forward(s, view, pass, ours);
    typename TypeParam::Reference{}.forward(s, view, reference_pass, theirs);
    SurfelGradient g, gg;
    PoseGradient pose = PoseGradient::Zero(), reference_pose = PoseGradient::Zero();
    typename TypeParam::Rasteriser{}.backward(s, view, pass, d, g, pose);
    typename TypeParam::Reference{}.backward(s, view, reference_pass, d, gg, reference_pose);
    for (std::size_t p = 0; p < surfel::parameters; ++p) {
      double largest = 0;
      for (const float v : gg.parameter[p]) largest = std::max(largest, std::abs(static_cast<double>(v)));
      std::size_t off = 0;
      for (std::size_t i = 0; i < s.size(); ++i)
        if (!(std::abs(g.parameter[p][i] - gg.parameter[p][i]) <= 1e-4 * largest)) ++off;
      EXPECT_LE(off, 3U) << p;
    }
    for (const std::uint32_t i : g.touched) EXPECT_EQ(gg.is_touched[i], 1);
    EXPECT_LE((pose - reference_pose).norm(), 2e-3 * reference_pose.norm()) << pose << "\n" << reference_pose;
  }
}

TYPED_TEST(SurfelRaster, VisibilityAndFisher) {
  const Surfels s = any_surfels(400, 9);
  RasterView view = any_raster_view(61, 45);
  typename TypeParam::Rasteriser::Pass pass;
  typename TypeParam::Reference::Pass reference_pass;
  for (const bool front_only : {false, true}) {
    view.front_only = front_only;
    Image<float> measured = Image<float>::Ones(45, 61);
    measured.leftCols(20) = -1;
    std::vector<float> w(s.size(), 0), ww(s.size(), 0);
    typename TypeParam::Rasteriser{}.visibility(s, view, pass, measured, w);
    typename TypeParam::Reference{}.visibility(s, view, reference_pass, measured, ww);
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_NEAR(w[i], ww[i], 1e-4) << i;
  }
  view.front_only = false;
  std::vector<double> f(surfel::parameters * s.size(), 0), ff(f);
  typename TypeParam::Rasteriser{}.fisher(s, view, pass, f);
  typename TypeParam::Reference{}.fisher(s, view, reference_pass, ff);
  for (std::size_t p = 0; p < surfel::parameters; ++p) {
    double largest = 0;
    for (std::size_t i = 0; i < s.size(); ++i) largest = std::max(largest, ff[surfel::parameters * i + p]);
    for (std::size_t i = 0; i < s.size(); ++i)
      EXPECT_NEAR(f[surfel::parameters * i + p], ff[surfel::parameters * i + p], 1e-3 * largest) << p << " of " << i;
  }
}

}  // namespace
