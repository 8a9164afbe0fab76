// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Adam on surfels against textbook Adam in double; frames that are trained on, and which of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/choose_batch.hpp>
#include <vantage/maps/surfel/surfel_adam.hpp>
#include <vantage/maps/surfel/training_frame.hpp>

namespace vantage {
namespace {

Surfels random_surfels(std::size_t n, Rng rng) {
  Surfels s;
  for (std::size_t i = 0; i < n; ++i) {
    Surfel one;
    for (float& p : one.parameter) p = static_cast<float>(rng.uniform(-1, 1));
    s.push_back(one);
  }
  return s;
}
// Touches a few: not the same in each step, some blocks never.
void random_gradient(SurfelGradient& g, std::size_t n, Rng rng) {
  g.reset(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i / SurfelAdam::block % 3 == 1 || rng.uniform() < 0.6) continue;
    g.touched.push_back(static_cast<std::uint32_t>(i));
    g.is_touched[i] = 1;
    for (auto& p : g.parameter) p[i] = static_cast<float>(rng.normal() * std::pow(10, rng.uniform(-6, 1)));
  }
}

TEST(SurfelAdam, IsTextbookAdamOnAll) {
  constexpr std::size_t n = 1500;
  const LearningRates rates;
  Surfels surfels = random_surfels(n, Rng(1));
  const Surfels start = surfels;
  SurfelAdam adam(rates);
  SurfelGradient gradient;
  for (int mapping_step = 0; mapping_step < 2; ++mapping_step) {
    std::array<std::vector<double>, surfel::parameters> x, m, v;
    for (std::size_t p = 0; p < surfel::parameters; ++p) {
      x[p].assign(surfels.parameter[p].begin(), surfels.parameter[p].end());
      m[p].assign(n, 0);
      v[p].assign(n, 0);
    }
    adam.restart(n);
    for (int t = 1; t <= 10; ++t) {
      random_gradient(gradient, n, Rng(7).fork(static_cast<std::uint64_t>(t + 100 * mapping_step)));
      adam.step(surfels, gradient);
      for (std::size_t p = 0; p < surfel::parameters; ++p)
        for (std::size_t i = 0; i < n; ++i) {
          const double g = static_cast<double>(gradient.parameter[p][i]);
          m[p][i] = 0.9 * m[p][i] + 0.1 * g;
          v[p][i] = 0.999 * v[p][i] + 0.001 * g * g;
          x[p][i] -= rates.of(p) * (m[p][i] / (1 - std::pow(0.9, t))) /
                     (std::sqrt(v[p][i] / (1 - std::pow(0.999, t))) + 1e-15);
        }
    }
    for (std::size_t p = 0; p < surfel::parameters; ++p)
      for (std::size_t i = 0; i < n; ++i)
        ASSERT_NEAR(static_cast<double>(surfels.parameter[p][i]), x[p][i], 2e-6) << p << " of " << i;
  }
  for (std::size_t i = SurfelAdam::block; i < 2 * SurfelAdam::block; ++i)
    EXPECT_EQ(surfels.parameter[0][i], start.parameter[0][i]);  // never touched
  EXPECT_NE(surfels.parameter[0], start.parameter[0]);
}

TEST(SurfelAdam, RatesAreThoseOfTheParameters) {
  const LearningRates r;
  using namespace surfel;
  EXPECT_EQ(r.of(x), 5e-4);
  EXPECT_EQ(r.of(z), 5e-4);
  EXPECT_EQ(r.of(qw), 5e-4);
  EXPECT_EQ(r.of(qz), 5e-4);
  EXPECT_EQ(r.of(log_scale_x), 0.01);
  EXPECT_EQ(r.of(log_scale_y), 0.01);
  EXPECT_EQ(r.of(red), 1e-4);
  EXPECT_EQ(r.of(blue), 1e-4);
  EXPECT_EQ(r.of(logit), 0.01);
}

Frame frame() {
  Frame f;
  f.camera = Camera::from_fov(6, 4, deg(60));
  f.view = look_at({1, 2, 3}, {0, 0, 0});
  f.depth.setConstant(4, 6, 1.5F);
  f.depth(1, 2) = std::numeric_limits<float>::quiet_NaN();
  f.colour.resize(4, 6);
  Rng rng(3);
  for (Image<float>* p : {&f.colour.r, &f.colour.g, &f.colour.b})
    for (Eigen::Index k = 0; k < p->size(); ++k) p->data()[k] = static_cast<float>(rng.uniform());
  f.colour.r(0, 0) = 0, f.colour.r(0, 1) = 1;
  return f;
}

TEST(TrainingFrame, KeepsColoursTo8BitsAndDepthExactly) {
  const Frame f = frame();
  const TrainingFrame kept(f);
  std::array<float, 6> row{};
  for (Eigen::Index v = 0; v < 4; ++v) {
    for (int channel = 0; channel < 3; ++channel) {
      const Image<float>& plane = channel == 0 ? f.colour.r : channel == 1 ? f.colour.g : f.colour.b;
      kept.colour(channel, v, row.data());
      for (Eigen::Index u = 0; u < 6; ++u) EXPECT_NEAR(row[static_cast<std::size_t>(u)], plane(v, u), 1.0 / 510 + 1e-6);
    }
    kept.depth(v, row.data());
    for (Eigen::Index u = 0; u < 6; ++u)
      EXPECT_EQ(row[static_cast<std::size_t>(u)], std::isnan(f.depth(v, u)) ? 0 : f.depth(v, u));
  }
  EXPECT_LE(kept.bytes(), sizeof(TrainingFrame) + 7 * 24);
}

TEST(TrainingFrame, SavesAndLoads) {
  TrainingFrame kept(frame()), loaded;
  kept.error = 0.25;
  Sink sink, again;
  kept.save(sink);
  Source source(sink.bytes());
  loaded.load(source);
  source.done();
  loaded.save(again);
  EXPECT_TRUE(std::ranges::equal(sink.bytes(), again.bytes()));
  for (std::size_t cut = 0; cut + 1 < sink.bytes().size(); cut += 7) {
    Source cut_short(sink.bytes().first(cut));
    EXPECT_THROW(loaded.load(cut_short), Error);
  }
}

TEST(ChooseBatch, NewestAndThoseOfLargeError) {
  std::vector<double> errors(20, 0.01);
  errors[4] = 10;
  errors[7] = 10;
  Rng rng(1);
  std::array<int, 20> drawn{};
  for (int k = 0; k < 500; ++k) {
    const auto batch = choose_batch(errors, {}, rng);
    ASSERT_EQ(batch.size(), 8U);
    EXPECT_EQ(batch[0], 19U);
    EXPECT_EQ(batch[1], 18U);
    EXPECT_EQ(batch[2], 17U);
    EXPECT_EQ(std::set<std::size_t>(batch.begin(), batch.end()).size(), 8U);
    for (const std::size_t i : batch) ++drawn[i];
  }
  EXPECT_GT(drawn[4], 495);
  EXPECT_GT(drawn[7], 495);
  EXPECT_NEAR(drawn[0], 100, 40);  // three of fifteen
}

TEST(ChooseBatch, UniformAndFew) {
  Rng rng(1);
  std::array<int, 13> drawn{};
  std::vector<double> errors(13, 0.0);
  errors[0] = 1e9;
  for (int k = 0; k < 1000; ++k)
    for (const std::size_t i : choose_batch(errors, {.by_error = false}, rng)) ++drawn[i];
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(drawn[i], 500, 80);
  EXPECT_EQ(choose_batch({1, 2}, {}, rng), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(choose_batch({0, 0, 0, 0, 0}, {}, rng).size(), 5U);
  EXPECT_TRUE(choose_batch({}, {}, rng).empty());
}

}  // namespace
}  // namespace vantage
