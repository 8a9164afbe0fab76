// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/eval/image_metrics.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "eval_reference.hpp"

namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ImageMetrics, AgreeWithScikitImage) {
  for (const auto& c : test::reference("images")) {
    const Image<float> a = test::picture(c.at("rows"), c.at("columns"), c.at("seed"));
    const Image<float> b = test::noisy(a, c.at("amount"), c.at("seed"));
    EXPECT_NEAR(psnr(a, b), c.at("psnr").get<double>(), 1e-9);
    EXPECT_NEAR(ssim(a, b), c.at("ssim").get<double>(), 1e-6);
  }
}

TEST(ImageMetrics, ColoursCountAlike) {
  const Image<float> a = test::picture(40, 30, 1), b = test::noisy(a, 0.3, 1), c = test::noisy(a, 0.1, 2);
  const ColourImage x{a, a, a}, y{b, c, a};
  const double mse = (std::pow(10, -psnr(a, b) / 10) + std::pow(10, -psnr(a, c) / 10)) / 3;
  EXPECT_NEAR(psnr(x, y), -10 * std::log10(mse), 1e-9);
  EXPECT_NEAR(ssim(x, y), (ssim(a, b) + ssim(a, c) + 1) / 3, 1e-9);
}

TEST(Psnr, ClosedForms) {
  const Image<float> black = Image<float>::Zero(7, 9), grey = Image<float>::Constant(7, 9, 0.125F);
  EXPECT_NEAR(psnr(black, grey), -20 * std::log10(0.125), 1e-12);
  EXPECT_EQ(psnr(grey, grey), infinity);
  EXPECT_EQ(psnr(black, Image<float>::Ones(7, 9)), 0);
  Image<float> half = black;
  half.topRows(3).setConstant(0.5F);
  Mask mask = Mask::Constant(7, 9, false);
  mask.topRows(6).setConstant(true);
  EXPECT_NEAR(psnr(black, half, mask), -10 * std::log10(0.125), 1e-12);
}

TEST(Ssim, ClosedForms) {
  const Image<float> a = test::picture(30, 40, 5);
  EXPECT_NEAR(ssim(a, a), 1, 1e-6);
  EXPECT_NEAR(ssim(a, 1 - a), ssim(1 - a, a), 1e-6);
  // Without variance only the luminance term is left.
  const Image<float> x = Image<float>::Constant(20, 20, 0.25F), y = Image<float>::Constant(20, 20, 0.75F);
  EXPECT_NEAR(ssim(x, y), (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-6);
}

TEST(Ssim, DoesNotDependOnTheThreads) {
  const Image<float> a = test::picture(200, 150, 5), b = test::noisy(a, 0.2, 6);
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return std::pair(ssim(a, b), psnr(a, b)); });
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1), run(8));
}

TEST(ImageMetrics, Refuse) {
  const Image<float> a = test::picture(20, 30, 1), b = test::picture(30, 20, 1), small = test::picture(10, 30, 1);
  Image<float> bad = a;
  bad(3, 4) = nan;
  EXPECT_THROW(static_cast<void>(psnr(a, b)), Error);
  EXPECT_THROW(static_cast<void>(ssim(a, b)), Error);
  EXPECT_THROW(static_cast<void>(ssim(small, small)), Error);
  EXPECT_THROW(static_cast<void>(psnr(a, bad)), Error);
  EXPECT_THROW(static_cast<void>(ssim(a, bad)), Error);
  EXPECT_THROW(static_cast<void>(psnr(Image<float>(), Image<float>())), Error);
  EXPECT_THROW(static_cast<void>(psnr(a, a, Mask::Constant(20, 30, false))), Error);
  EXPECT_THROW(static_cast<void>(psnr(a, a, Mask::Constant(20, 20, true))), Error);
  EXPECT_THROW(static_cast<void>(psnr(ColourImage{a, a, a}, ColourImage{a, a, b})), Error);
}

TEST(DepthMetrics, AgreeWithNumpy) {
  for (const auto& c : test::reference("depth")) {
    const std::size_t n = c.at("n");
    const std::uint32_t seed = c.at("seed");
    const auto t = test::hashed(n, seed), e = test::hashed(n, seed + 1), no_truth = test::hashed(n, seed + 2),
               no_estimate = test::hashed(n, seed + 3), masked = test::hashed(n, seed + 4);
    Image<float> truth(60, static_cast<Eigen::Index>(n) / 60), estimate = truth;
    Mask mask(truth.rows(), truth.cols());
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      truth.data()[k] = no_truth[i] < 0.1 ? nan : static_cast<float>(1 + 4 * t[i]);
      estimate.data()[k] = no_estimate[i] < 0.2 ? nan : static_cast<float>(1 + 4 * e[i]);
      mask.data()[k] = masked[i] < 0.5;
    }
    const DepthMetrics m = depth_metrics(estimate, truth, mask);
    EXPECT_EQ(m.pixels, c.at("pixels").get<std::size_t>());
    EXPECT_NEAR(m.known, c.at("known").get<double>(), 1e-12);
    EXPECT_NEAR(m.rmse_m, c.at("rmse").get<double>(), 1e-7);
    EXPECT_NEAR(m.mae_m, c.at("mae").get<double>(), 1e-7);
  }
}

TEST(DepthMetrics, NothingKnown) {
  const Image<float> truth = Image<float>::Constant(4, 4, 2), none = Image<float>::Constant(4, 4, nan);
  const DepthMetrics m = depth_metrics(none, truth);
  EXPECT_TRUE(std::isnan(m.rmse_m) && std::isnan(m.mae_m));
  EXPECT_EQ(m.known, 0);
  EXPECT_THROW(static_cast<void>(depth_metrics(truth, none)), Error);
  EXPECT_THROW(static_cast<void>(depth_metrics(truth / 0.0F, truth)), Error);
}

}  // namespace
}  // namespace vantage
