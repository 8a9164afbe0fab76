// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/scene.hpp>

namespace vantage {

/// All textures of a scene with their mipmaps, sampled for 16 pixels at once: bilinear within a level, linear between
/// two levels (Williams, "Pyramidal parametrics", SIGGRAPH 1983). Each level halves the sides of the one before; a
/// texel is the mean of the area it covers, so that the last level, one texel, is the mean colour. Textures repeat.
/// Colours are averaged as they are encoded. Four bytes a texel and a third for the mipmaps. Const members run
/// concurrently.
class TextureAtlas {
 public:
  static constexpr Eigen::Index lanes = 16;
  using Lanes = Eigen::Array<float, lanes, 1>;
  using Indices = std::array<std::uint32_t, static_cast<std::size_t>(lanes)>;
  using Floats = std::array<float, static_cast<std::size_t>(lanes)>;

  TextureAtlas() = default;
  /// Expects valid textures (Scene::validate).
  explicit TextureAtlas(std::span<const Texture> textures);

  [[nodiscard]] std::size_t size() const { return first_.size(); }

  /// Colours in [0, 1] of textures `which` at (u, v), v = 0 at the bottom; `texels`: how many of the full texture's lie
  /// under the pixel (an area). Coordinates are finite.
  void sample(const Indices& which, const Lanes& u, const Lanes& v, const Lanes& texels,
              std::array<Lanes, 3>& rgb) const;

 private:
  // Rows of width + 1 texels and height + 1 rows: the last ones repeat the first, so that neighbours need no modulo.
  struct Level {
    std::uint32_t begin, stride;
    float width, height;
  };
  using Means = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  ///< rows x (3 columns)

  void bilinear(const Lanes& level, const Lanes& u, const Lanes& v, std::array<Lanes, 3>& rgb) const;
  static Means halved(const Means& fine);
  void append(const Means& level);

  std::vector<std::uint32_t> texels_;  ///< 0xBBGGRR
  std::vector<Level> levels_;
  std::vector<std::uint32_t> first_, last_;  ///< level of each texture
};

inline TextureAtlas::TextureAtlas(std::span<const Texture> textures) {
  std::size_t size = 0;
  for (const Texture& t : textures)  // a bound: the levels' borders included
    size += 2 * (static_cast<std::size_t>(t.width) + 2) * (static_cast<std::size_t>(t.height) + 2);
  if (size > 0xFFFFFFFFU) throw Error("TextureAtlas", concat(size / 2, " texels"), "at most 2147483648");
  for (const Texture& t : textures) {
    Means means(t.height, 3 * t.width);
    for (Eigen::Index row = 0; row < means.rows(); ++row)
      for (Eigen::Index column = 0; column < t.width; ++column)
        for (Eigen::Index c = 0; c < 3; ++c)  // v grows upwards: the bottom row first
          means(row, 3 * column + c) =
              t.rgb[static_cast<std::size_t>((t.height - 1 - row) * t.width + column)][static_cast<std::size_t>(c)];
    first_.push_back(static_cast<std::uint32_t>(levels_.size()));
    append(means);
    while (means.rows() > 1 || means.cols() > 3) {
      means = halved(means);
      append(means);
    }
    last_.push_back(static_cast<std::uint32_t>(levels_.size() - 1));
  }
}

/// The next level: sides floor(n / 2), at least 1; each texel the mean over n / floor(n / 2) texels a side.
inline TextureAtlas::Means TextureAtlas::halved(const Means& fine) {
  const Eigen::Index height = std::max<Eigen::Index>(1, fine.rows() / 2), width = fine.cols() / 3;
  const Eigen::Index half_width = std::max<Eigen::Index>(1, width / 2);
  // Weights of the one, two or three old texels from i s to (i + 1) s, s = n / half: f(old, weight).
  const auto cover = [](Eigen::Index i, Eigen::Index n, Eigen::Index half, auto&& f) {
    const double s = static_cast<double>(n) / static_cast<double>(half), low = static_cast<double>(i) * s;
    for (auto k = static_cast<Eigen::Index>(low); k < n && static_cast<double>(k) < low + s; ++k)
      f(k, static_cast<float>((std::min(low + s, static_cast<double>(k) + 1) - std::max(low, static_cast<double>(k))) /
                              s));
  };
  Means rows = Means::Zero(height, fine.cols());
  for (Eigen::Index i = 0; i < height; ++i)
    cover(i, fine.rows(), height, [&](Eigen::Index k, float weight) { rows.row(i) += weight * fine.row(k); });
  Means means = Means::Zero(height, 3 * half_width);
  for (Eigen::Index i = 0; i < half_width; ++i)
    cover(i, width, half_width,
          [&](Eigen::Index k, float weight) { means.middleCols(3 * i, 3) += weight * rows.middleCols(3 * k, 3); });
  return means;
}

inline void TextureAtlas::append(const Means& level) {
  const Eigen::Index height = level.rows(), width = level.cols() / 3;
  levels_.push_back({static_cast<std::uint32_t>(texels_.size()), static_cast<std::uint32_t>(width + 1),
                     static_cast<float>(width), static_cast<float>(height)});
  for (Eigen::Index row = 0; row <= height; ++row)
    for (Eigen::Index column = 0; column <= width; ++column) {
      std::uint32_t texel = 0;
      for (Eigen::Index c = 0; c < 3; ++c)
        texel |= static_cast<std::uint32_t>(std::lround(level(row % height, 3 * (column % width) + c))) << (8 * c);
      texels_.push_back(texel);
    }
}

inline void TextureAtlas::sample(const Indices& which, const Lanes& u, const Lanes& v, const Lanes& texels,
                                 std::array<Lanes, 3>& rgb) const {
  constexpr auto n = static_cast<std::size_t>(lanes);
  // The level on which the footprint's side, the root of its area, is one texel.
  Lanes first, last, log2;
  for (std::size_t k = 0; k < n; ++k) {
    first[static_cast<Eigen::Index>(k)] = static_cast<float>(first_[which[k]]);
    last[static_cast<Eigen::Index>(k)] = static_cast<float>(last_[which[k]]);
  }
  const Lanes area = texels.max(1.F).min(0x1p60F);
  for (Eigen::Index k = 0; k < lanes; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(area[k]);
    const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U) - 1;
    // log2(1 + m) to 0.01, exact at both ends: finer than a blend of two levels shows.
    log2[k] = static_cast<float>(static_cast<std::int32_t>(bits >> 23) - 127) + m * (1.34F - 0.34F * m);
  }
  const Lanes level = (first + 0.5F * log2).min(last), below = level.floor(), blend = level - below;
  bilinear(below, u, v, rgb);
  if (!(blend > 0).any()) return;
  std::array<Lanes, 3> coarse;
  bilinear(level.ceil(), u, v, coarse);
  for (std::size_t c = 0; c < 3; ++c) rgb[c] += blend * (coarse[c] - rgb[c]);
}

inline void TextureAtlas::bilinear(const Lanes& level, const Lanes& u, const Lanes& v,
                                   std::array<Lanes, 3>& rgb) const {
  constexpr auto n = static_cast<std::size_t>(lanes);
  Lanes width, height;
  alignas(64) Indices begin, stride, texel;
  if (const float one = level[0]; (level == one).all()) {  // mostly
    const Level& at = levels_[static_cast<std::size_t>(one)];
    width.setConstant(at.width);
    height.setConstant(at.height);
    begin.fill(at.begin);
    stride.fill(at.stride);
  } else {
    for (std::size_t k = 0; k < n; ++k) {
      const auto lane = static_cast<Eigen::Index>(k);
      const Level& at = levels_[static_cast<std::size_t>(level[lane])];
      width[lane] = at.width;
      height[lane] = at.height;
      begin[k] = at.begin;
      stride[k] = at.stride;
    }
  }
  // The texel whose centre comes before t, and how far t is from there; NaN is somewhere in the picture.
  const auto place = [](const Lanes& t, const Lanes& size, Lanes& before, Lanes& weight) {
    const Lanes s = t - 0.5F / size, x = (s - s.floor()) * size;
    for (Eigen::Index k = 0; k < lanes; ++k)
      before[k] = std::min(size[k] - 1, std::max(0.F, static_cast<float>(static_cast<std::int32_t>(x[k]))));
    weight = x - before;
  };
  Lanes column, row, along, up;
  place(u, width, column, along);
  place(v, height, row, up);
  for (std::size_t k = 0; k < n; ++k)
    texel[k] = begin[k] +
               static_cast<std::uint32_t>(static_cast<std::int32_t>(row[static_cast<Eigen::Index>(k)])) * stride[k] +
               static_cast<std::uint32_t>(static_cast<std::int32_t>(column[static_cast<Eigen::Index>(k)]));
  alignas(64) Indices corner[4];  // lower left, lower right, upper left, upper right
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t* const lower = texels_.data() + texel[k];
    const std::uint32_t* const upper = lower + stride[k];
    corner[0][k] = lower[0];
    corner[1][k] = lower[1];
    corner[2][k] = upper[0];
    corner[3][k] = upper[1];
  }
  for (std::uint32_t c = 0; c < 3; ++c) {
    Lanes value[4];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < n; ++k)
        value[i][static_cast<Eigen::Index>(k)] =
            static_cast<float>(static_cast<std::int32_t>((corner[i][k] >> (8 * c)) & 0xFFU));
    const Lanes lower = value[0] + along * (value[1] - value[0]), upper = value[2] + along * (value[3] - value[2]);
    rgb[c] = (lower + up * (upper - lower)) * (1 / 255.F);
  }
}

}  // namespace vantage
