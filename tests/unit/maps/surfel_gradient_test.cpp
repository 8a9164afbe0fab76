// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The reference's derivatives against central differences, in double: all parameters of every surfel, and the pose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "surfel_scenes.hpp"

#include <vantage/maps/surfel/reference_rasteriser.hpp>

namespace {

using namespace vantage;

template <class Depth>
struct Loss {
  ReferenceRasteriser<double, Depth> raster;
  RasterView view = test::any_raster_view(28, 22);
  std::array<Image<float>, 8> by;  // red, green, blue, depth, normal x, y, z, opacity

  Loss() {
    Rng rng(21);
    for (auto& image : by) {
      image.resize(view.camera.height, view.camera.width);
      for (float& v : image.reshaped()) v = static_cast<float>(rng.uniform(-1, 1));
    }
  }
  double operator()(const Surfels& s, const RasterView& v) const {
    typename ReferenceRasteriser<double, Depth>::Pass pass;
    Rendering<> nothing;
    raster.forward(s, v, pass, nothing);
    double sum = 0;
    for (std::size_t k = 0; k < by.size(); ++k)
      sum += (pass.image[k].isNaN().select(0, pass.image[k]) * by[k].template cast<double>()).sum();
    return sum;
  }
  [[nodiscard]] ImageGradient gradient() const { return {{by[0], by[1], by[2]}, by[3], by[7], by[4], by[5], by[6]}; }
};

template <class Depth>
class SurfelGradients : public testing::Test {};
using Depths = testing::Types<LinearDepth, RayPlaneDepth>;
TYPED_TEST_SUITE(SurfelGradients, Depths);

TYPED_TEST(SurfelGradients, OfParametersAndPose) {
  const Loss<TypeParam> loss;
  Surfels s = test::any_surfels(60, 22);
  s.scale.max_m = 0.1F;  // reached by some
  typename ReferenceRasteriser<double, TypeParam>::Pass pass;
  Rendering<> nothing;
  SurfelGradient g;
  PoseGradient pose = PoseGradient::Zero();
  loss.raster.forward(s, loss.view, pass, nothing);
  loss.raster.backward(s, loss.view, pass, loss.gradient(), g, pose);
  ASSERT_GT(g.touched.size(), 20U);

  // A step that takes a pixel over 1/255 of alpha differs; few do.
  std::size_t off = 0, all = 0;
  for (std::size_t p = 0; p < surfel::parameters; ++p) {
    double largest = 0;
    for (const float v : g.parameter[p]) largest = std::max(largest, std::abs(static_cast<double>(v)));
    for (const std::uint32_t i : g.touched) {
      float& value = s.parameter[p][i];
      const float at = value, up = at + 1e-5F, down = at - 1e-5F;
      value = up;
      const double above = loss(s, loss.view);
      value = down;
      const double below = loss(s, loss.view);
      value = at;
      const double slope = (above - below) / (static_cast<double>(up) - static_cast<double>(down));
      ++all;
      if (std::abs(slope - static_cast<double>(g.parameter[p][i])) > 1e-4 * largest) ++off;
    }
  }
  EXPECT_LE(off, all / 50) << "of " << all;

  for (Eigen::Index k = 0; k < 6; ++k) {
    const double h = 1e-7;
    const auto moved = [&](double by) {
      RasterView v = loss.view;
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      if (k < 3)
        motion.translation()[k] = by;
      else
        motion.linear() = Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(k - 3)).toRotationMatrix();
      v.view.T_W_C = v.view.T_W_C * motion;
      return loss(s, v);
    };
    EXPECT_NEAR((moved(h) - moved(-h)) / (2 * h), pose[k], 1e-4 * pose.norm()) << k;
  }
}

}  // namespace
