// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The fast rasteriser of surfels against the slow one, image by image and gradient by gradient.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

#include "message_of.hpp"
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

TYPED_TEST(SurfelRaster, SameBitsWithAnyNumberOfThreads) {
  const Surfels s = any_surfels(3000, 10);
  const RasterView view = any_raster_view(130, 70);
  const ImageGradient d = any_gradient(view.camera, 4);
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, 8);
  const auto run = [&](int threads) {
    SurfelGradient g;
    PoseGradient pose = PoseGradient::Zero();
    Everything out;
    tbb::task_arena(threads).execute([&] {
      typename TypeParam::Rasteriser::Pass pass;
      typename TypeParam::Rasteriser{}.forward(s, view, pass, out);
      typename TypeParam::Rasteriser{}.backward(s, view, pass, d, g, pose);
    });
    return std::tuple{g, pose, out};
  };
  const auto [g, pose, out] = run(1);
  for (const int threads : {2, 8}) {
    const auto [gg, other_pose, other] = run(threads);
    EXPECT_EQ(g.parameter, gg.parameter);
    EXPECT_EQ(g.touched, gg.touched);
    EXPECT_EQ(pose, other_pose);
    EXPECT_TRUE((out.depth == other.depth || (out.depth.isNaN() && other.depth.isNaN())).all());
    EXPECT_TRUE((out.confidence == other.confidence).all());
  }
}

// A pass that has drawn something larger draws the same as a new one; gradients add up.
TYPED_TEST(SurfelRaster, PassesAreUsedAgain) {
  const typename TypeParam::Rasteriser raster;
  const Surfels many = any_surfels(3000, 11), few = any_surfels(200, 12);
  const RasterView large = any_raster_view(130, 70), small = any_raster_view(40, 30);
  const ImageGradient d = any_gradient(small.camera, 5);
  typename TypeParam::Rasteriser::Pass used, fresh;
  Everything out, again;
  raster.forward(many, large, used, out);
  raster.backward(many, large, used, any_gradient(large.camera, 6), *std::make_unique<SurfelGradient>());
  raster.forward(few, small, used, out);
  raster.forward(few, small, fresh, again);
  EXPECT_TRUE((out.opacity == again.opacity).all());
  SurfelGradient once, twice;
  raster.backward(few, small, fresh, d, once);
  raster.backward(few, small, used, d, twice);
  raster.backward(few, small, used, d, twice);
  EXPECT_EQ(once.touched, twice.touched);
  for (std::size_t p = 0; p < surfel::parameters; ++p)
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(twice.parameter[p][i], 2 * once.parameter[p][i]);
}

// Every value that a parameter can have: nothing crashes, and what is not drawn says so in no pixel.
TYPED_TEST(SurfelRaster, AnyParameterIsSafe) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const RasterView view = any_raster_view(37, 29);
  const ImageGradient d = any_gradient(view.camera, 7);
  for (std::size_t p = 0; p < surfel::parameters; ++p) {
    Surfels s = any_surfels(80, 13);
    const std::array<float, 10> values = {nan, infinity, -infinity, 0, 1e-30F, -1e-30F, 1e30F, -1e30F, 3e38F, 100};
    for (std::size_t i = 0; i < s.size(); ++i) s.parameter[p][i] = values[i % values.size()];
    typename TypeParam::Rasteriser::Pass pass;
    Everything out;
    SurfelGradient g;
    PoseGradient pose = PoseGradient::Zero();
    typename TypeParam::Rasteriser{}.forward(s, view, pass, out);
    typename TypeParam::Rasteriser{}.backward(s, view, pass, d, g, pose);
    EXPECT_TRUE(out.opacity.allFinite() && out.confidence.allFinite()) << p;
    const channel::Colour& colour = out;
    EXPECT_TRUE(colour.r.isFinite().all()) << p;
    for (std::size_t k = 0; k < surfel::parameters; ++k)
      for (std::size_t i = 0; i < s.size(); ++i) EXPECT_TRUE(std::isfinite(g.parameter[k][i])) << p << k << " of " << i;
  }
}

Surfel facing(float z, float log_scale, float logit) {
  Surfel s;
  s.parameter = {0, 0, z, 0, 1, 0, 0, log_scale, log_scale, 0.5F, 0.25F, 0.75F, logit};
  s.confidence = 0.5F;
  return s;
}
RasterView straight(int width, int height) {
  RasterView v;
  v.camera = Camera::from_fov(width, height, 1.0);
  return v;
}

TYPED_TEST(SurfelRaster, ThousandsInOneTile) {
  Surfels s;
  Rng rng(14);
  for (int i = 0; i < 5000; ++i)
    s.push_back(facing(static_cast<float>(rng.uniform(0.5, 1.5)), static_cast<float>(rng.uniform(-1, 1)), -5));
  const RasterView view = straight(16, 16);
  typename TypeParam::Rasteriser::Pass pass;
  typename TypeParam::Reference::Pass reference_pass;
  Everything ours, theirs;
  typename TypeParam::Rasteriser{}.forward(s, view, pass, ours);
  typename TypeParam::Reference{}.forward(s, view, reference_pass, theirs);
  EXPECT_EQ(pass.visible(), 5000U);
  expect_same(ours, theirs);
  const ImageGradient d = any_gradient(view.camera, 9);
  SurfelGradient g, gg;
  typename TypeParam::Rasteriser{}.backward(s, view, pass, d, g);
  typename TypeParam::Reference{}.backward(s, view, reference_pass, d, gg);
  for (std::size_t p = 0; p < surfel::parameters; ++p) {
    double largest = 0;
    for (const float v : gg.parameter[p]) largest = std::max(largest, std::abs(static_cast<double>(v)));
    std::size_t off = 0;  // those whose alpha is within a rounding of 1/255
    for (std::size_t i = 0; i < s.size(); ++i)
      if (!(std::abs(g.parameter[p][i] - gg.parameter[p][i]) <= 1e-3 * largest)) ++off;
    EXPECT_LE(off, 3U) << p;
  }
}

// That backward, after forward, gives finite numbers: one a surfel and parameter, and six of the pose.
template <class Raster>
void expect_finite_gradients(const Raster& raster, const Surfels& s, const RasterView& view,
                             typename Raster::Pass& pass) {
  SurfelGradient g;
  PoseGradient pose = PoseGradient::Zero();
  raster.backward(s, view, pass, any_gradient(view.camera, 10), g, pose);
  EXPECT_TRUE(pose.allFinite()) << pose;
  EXPECT_EQ(g.is_touched.size(), s.size());
  EXPECT_EQ(g.touched.size(), pass.visible());
  for (const auto& values : g.parameter) {
    EXPECT_EQ(values.size(), s.size());
    for (const float v : values) EXPECT_TRUE(std::isfinite(v));
  }
}

TYPED_TEST(SurfelRaster, Edges) {
  const typename TypeParam::Rasteriser raster;
  typename TypeParam::Rasteriser::Pass pass;
  Everything out;
  // Nothing: the background and no depth.
  RasterView view = straight(20, 10);
  view.background = {0.25F, 0.5F, 0.75F};
  raster.forward(Surfels{}, view, pass, out);
  const channel::Colour& colour = out;
  EXPECT_TRUE((colour.g == 0.5F).all() && (out.opacity == 0).all() && out.depth.isNaN().all());
  SurfelGradient none;
  raster.backward(Surfels{}, view, pass, any_gradient(view.camera, 8), none);
  EXPECT_TRUE(none.touched.empty());
  const auto draw = [&](const Surfel& one, const RasterView& v) {
    Surfels s;
    s.scale.max_m = std::numeric_limits<float>::infinity();
    s.push_back(one);
    raster.forward(s, v, pass, out);
    expect_finite_gradients(raster, s, v, pass);
    return out.opacity.maxCoeff();
  };
  EXPECT_EQ(draw(facing(-1, 0, 3), view), 0);              // behind
  EXPECT_EQ(draw(facing(0, 0, 3), view), 0);               // in the camera
  EXPECT_EQ(draw(facing(1, 0, -6), view), 0);              // never reaches 1/255
  EXPECT_NEAR(draw(facing(1, 12, 20), view), 0.99, 1e-6);  // huge and opaque
  EXPECT_NEAR(out.opacity.minCoeff(), 0.99, 1e-6);
  EXPECT_GT(draw(facing(1, -60, 3), view), 0);  // a point, blurred to a pixel
  Surfel grazing = facing(1, 2, 3);
  grazing.parameter[surfel::qw] = grazing.parameter[surfel::qx] = 1;
  EXPECT_EQ(draw(grazing, view), 0);
  grazing.parameter[surfel::qw] = 0.7F, grazing.parameter[surfel::qx] = 0.7141F;  // 1.1 degrees from its plane
  EXPECT_GT(draw(grazing, view), 0);
  EXPECT_GT(draw(facing(1, 1, 3), straight(1, 1)), 0.5F);
  view.front_only = true;
  EXPECT_GT(draw(facing(1, 0, 3), view), 0.3F);
  Surfel back = facing(1, 0, 3);
  back.parameter[surfel::qw] = 1, back.parameter[surfel::qx] = 0;
  EXPECT_EQ(draw(back, view), 0);
}

TYPED_TEST(SurfelRaster, RefusesWhatItCannotDraw) {
  const typename TypeParam::Rasteriser raster;
  typename TypeParam::Rasteriser::Pass pass;
  Everything out;
  Surfels s = any_surfels(10, 15);
  RasterView view = any_raster_view(20, 10);
  const auto refused = [&](const char* part) { EXPECT_REFUSED((raster.forward(s, view, pass, out), 0), part); };
  view.camera.width = 0;
  refused("width");
  view = any_raster_view(20, 10);
  view.view.T_W_C(0, 3) = std::nan("");
  refused("pose");
  view = any_raster_view(20, 10);
  s.parameter[surfel::qx].pop_back();
  refused("one each");
  s = any_surfels(10, 15);
  raster.forward(s, view, pass, out);
  ImageGradient d;
  d.depth.setZero(3, 3);
  SurfelGradient g;
  EXPECT_REFUSED((raster.backward(s, view, pass, d, g), 0), "gradient by depth");
  d.depth.setZero(10, 20);
  Rendering<channel::Colour> colour;
  raster.forward(s, view, pass, colour);
  EXPECT_REFUSED((raster.backward(s, view, pass, d, g), 0), "did not draw");
  std::vector<float> weight(s.size()), few(3);
  EXPECT_REFUSED((raster.visibility(s, view, pass, d.depth, few), 0), "weight has 3");
  raster.visibility(s, view, pass, d.depth, weight);
  EXPECT_REFUSED((raster.backward(s, view, pass, {}, g), 0), "no forward");
}

}  // namespace
