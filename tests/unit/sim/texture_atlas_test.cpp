// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/texture_atlas.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

using Lanes = TextureAtlas::Lanes;
using Indices = std::array<std::size_t, 16>;

Texture random_texture(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  Texture t{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    t.rgb.push_back({static_cast<std::uint8_t>(rng.index(256)), static_cast<std::uint8_t>(rng.index(256)),
                     static_cast<std::uint8_t>(rng.index(256))});
  return t;
}

Eigen::Vector3d texel(const Texture& t, int column, int row) {  // repeats; row 0 at the top
  const auto wrap = [](int i, int n) { return ((i % n) + n) % n; };
  const auto& c = t.rgb[static_cast<std::size_t>(wrap(row, t.height) * t.width + wrap(column, t.width))];
  return Eigen::Vector3d(c[0], c[1], c[2]) / 255;
}

// Slow and plain: texel (column, row) has its centre at u = (column + 0.5) / width, v = 1 - (row + 0.5) / height.
Eigen::Vector3d bilinear(const Texture& t, double u, double v) {
  const double x = u * t.width - 0.5, y = (1 - v) * t.height - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double wx = x - column, wy = y - row;
  return (1 - wy) * ((1 - wx) * texel(t, column, row) + wx * texel(t, column + 1, row)) +
         wy * ((1 - wx) * texel(t, column, row + 1) + wx * texel(t, column + 1, row + 1));
}

Eigen::Vector3d mean(const Texture& t) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int row = 0; row < t.height; ++row)
    for (int column = 0; column < t.width; ++column) sum += texel(t, column, row);
  return sum / (t.width * t.height);
}

std::vector<Eigen::Vector3d> sample(const TextureAtlas& atlas, const Indices& which, const Lanes& u, const Lanes& v,
                                    const Lanes& texels) {
  TextureAtlas::Footprints footprints{{}, {}, u, v, texels};
  for (std::size_t k = 0; k < which.size(); ++k) {
    footprints.first.data()[k] = atlas.levels(which[k]).first;
    footprints.last.data()[k] = atlas.levels(which[k]).last;
  }
  TextureAtlas::Samples samples;
  atlas.find(footprints, samples);
  std::array<Lanes, 3> rgb;
  atlas.colours(samples, rgb);
  std::vector<Eigen::Vector3d> colours;
  for (Eigen::Index k = 0; k < 16; ++k) colours.push_back(Eigen::Vector3d(rgb[0][k], rgb[1][k], rgb[2][k]));
  return colours;
}

TEST(TextureAtlas, IsBilinearAndRepeatsWherePixelsAreSmall) {
  const std::vector<Texture> textures = {random_texture(8, 4, 1), random_texture(5, 7, 2), random_texture(1, 1, 3),
                                         random_texture(3, 1, 4)};
  const TextureAtlas atlas(textures);
  EXPECT_EQ(atlas.size(), 4U);
  Rng rng(9);
  for (int repeat = 0; repeat < 500; ++repeat) {
    Lanes u, v, texels;
    Indices which;
    const bool one = repeat % 2 == 0;
    for (Eigen::Index k = 0; k < 16; ++k) {
      u[k] = static_cast<float>(rng.uniform(-3, 4));
      v[k] = static_cast<float>(rng.uniform(-3, 4));
      texels[k] = static_cast<float>(rng.uniform());
      which[static_cast<std::size_t>(k)] = one ? static_cast<std::size_t>(repeat / 2 % 4) : rng.index(4);
    }
    const auto colours = sample(atlas, which, u, v, texels);
    for (Eigen::Index k = 0; k < 16; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_LT((colours[i] - bilinear(textures[which[i]], u[k], v[k])).cwiseAbs().maxCoeff(), 2e-5);
    }
  }
}

TEST(TextureAtlas, PlainIsExactlyWhite) {
  const std::vector<Texture> textures = {random_texture(8, 4, 1)};
  for (const TextureAtlas& atlas : {TextureAtlas(), TextureAtlas(textures)}) {
    TextureAtlas::Footprints footprints{Lanes::Constant(TextureAtlas::plain.first),
                                        Lanes::Constant(TextureAtlas::plain.last), Lanes::LinSpaced(-1, 2),
                                        Lanes::LinSpaced(3, 1), Lanes::LinSpaced(0, 100)};
    TextureAtlas::Samples samples;
    atlas.find(footprints, samples);
    std::array<Lanes, 3> rgb;
    atlas.colours(samples, rgb);
    for (const Lanes& c : rgb) EXPECT_TRUE((c == 1).all()) << c.transpose();
  }
}

TEST(TextureAtlas, TexelCentresAreExact) {
  const std::vector<Texture> textures = {random_texture(16, 8, 1)};
  const TextureAtlas atlas(textures);
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 16; ++column) {
      const auto colours = sample(atlas, {}, Lanes::Constant((static_cast<float>(column) + 0.5F) / 16),
                                  Lanes::Constant(1 - (static_cast<float>(row) + 0.5F) / 8), Lanes::Zero());
      EXPECT_LT((colours[3] - texel(textures[0], column, row)).cwiseAbs().maxCoeff(), 1e-6);
    }
}

TEST(TextureAtlas, LargeFootprintsSeeTheMean) {
  std::uint64_t seed = 0;
  for (const auto [width, height] : {std::array{64, 64}, std::array{37, 91}, std::array{1, 40}, std::array{100, 3}}) {
    const std::vector<Texture> textures = {random_texture(width, height, ++seed)};
    const TextureAtlas atlas(textures);
    const auto area = static_cast<float>(width * height);
    Lanes u = Lanes::LinSpaced(-1, 2), v = Lanes::LinSpaced(3, 1);
    for (const float texels : {100 * 100 * area, 1e30F, std::numeric_limits<float>::infinity()})
      for (const Eigen::Vector3d& colour : sample(atlas, {}, u, v, Lanes::Constant(texels)))
        EXPECT_LT((colour - mean(textures[0])).cwiseAbs().maxCoeff(), 0.5 / 255 + 1e-6);  // a level is stored in 8 bits
  }
}

TEST(TextureAtlas, LevelsHalveTheResolution) {
  const std::vector<Texture> textures = {random_texture(8, 8, 5)};
  const TextureAtlas atlas(textures);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const Eigen::Vector3d expected =
          (texel(textures[0], 2 * column, 2 * row) + texel(textures[0], 2 * column + 1, 2 * row) +
           texel(textures[0], 2 * column, 2 * row + 1) + texel(textures[0], 2 * column + 1, 2 * row + 1)) /
          4;
      const float u = (static_cast<float>(column) + 0.5F) / 4, v = 1 - (static_cast<float>(row) + 0.5F) / 4;
      // Four texels under the pixel: the second level. Half way to it in the logarithm: the mean of both.
      const auto second = sample(atlas, {}, Lanes::Constant(u), Lanes::Constant(v), Lanes::Constant(4));
      EXPECT_LT((second[0] - expected).cwiseAbs().maxCoeff(), 0.5 / 255 + 1e-6);
      const auto between = sample(atlas, {}, Lanes::Constant(u), Lanes::Constant(v), Lanes::Constant(2));
      EXPECT_LT((between[0] - 0.5 * (second[0] + bilinear(textures[0], u, v))).cwiseAbs().maxCoeff(), 1e-5);
    }
}

TEST(TextureAtlas, AnyFootprintAndPlaceGivesAColour) {
  const std::vector<Texture> textures = {random_texture(8, 4, 1), random_texture(5, 7, 2)};
  const TextureAtlas atlas(textures);
  Rng rng(4);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    Lanes u, v, texels;
    Indices which;
    for (Eigen::Index k = 0; k < 16; ++k) {
      u[k] = static_cast<float>(rng.uniform(-1, 1) * std::pow(10, rng.uniform(-6, 8)));
      v[k] = static_cast<float>(rng.uniform(-1, 1) * std::pow(10, rng.uniform(-6, 8)));
      texels[k] = static_cast<float>(std::pow(10, rng.uniform(-30, 30)));
      which[static_cast<std::size_t>(k)] = rng.index(2);
    }
    for (const Eigen::Vector3d& colour : sample(atlas, which, u, v, texels))
      EXPECT_TRUE((colour.array() >= -1e-6).all() && (colour.array() <= 1 + 1e-6).all()) << colour.transpose();
  }
}

}  // namespace
}  // namespace vantage
