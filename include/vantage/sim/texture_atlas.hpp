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
/// Colours are averaged as they are encoded. Eight bytes a texel and a third for the mipmaps. Const members run
/// concurrently.
class TextureAtlas {
 public:
  static constexpr Eigen::Index lanes = 16;
  using Lanes = Eigen::Array<float, lanes, 1>;

  /// A texture's finest and coarsest level: whole numbers, kept as floats beside the rest of what is sampled.
  struct Levels {
    float first, last;
  };

  /// One white texel, which every atlas has.
  static constexpr Levels plain = {0, 0};

  TextureAtlas() : TextureAtlas(std::span<const Texture>()) {}
  /// Expects valid textures (Scene::validate).
  explicit TextureAtlas(std::span<const Texture> textures);

  [[nodiscard]] std::size_t size() const { return textures_.size(); }
  [[nodiscard]] const Levels& levels(std::size_t texture) const { return textures_[texture]; }

  /// Where 16 pixels look.
  struct Footprints {
    Lanes first, last;  ///< levels of the textures
    Lanes u, v;         ///< finite; v = 0 at the bottom
    Lanes texels;       ///< how many of the full texture's lie under the pixel: an area
  };
  class Samples;
  /// Finds the texels and asks the memory for them: what is done before `colours` hides the wait.
  void find(const Footprints& footprints, Samples& samples) const;
  /// RGB in [0, 1] of what was found.
  void colours(const Samples& samples, std::array<Lanes, 3>& rgb) const;

 private:
  static constexpr auto n = static_cast<std::size_t>(lanes);
  using Words = std::array<std::uint32_t, n>;
  /// Each lane's four numbers, which lie side by side in memory: one load a lane.
  using Fours = std::array<std::array<std::uint32_t, 4>, n>;
  using Means = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  ///< rows x (3 columns)

  // Rows of width + 1 pairs: the last one repeats the first, so that neighbours need no modulo.
  struct Level {
    std::uint32_t begin, stride, width, height;
  };
  /// 0xBBGGRR of a texel and of the one above it: two pairs are the four corners of a bilinear cell, read at once.
  struct Pair {
    std::uint32_t lower, upper;
  };

  /// Of a level: the texel at the lower left, and how far right of and above its centre.
  struct Corners {
    alignas(64) Words texel;
    Lanes along, up;
  };
  void corners(const Words& level, const Lanes& u, const Lanes& v, Corners& found) const;
  void bilinear(const Corners& corners, std::array<Lanes, 3>& rgb) const;
  static Means halved(const Means& fine);
  void append(const Means& level);

  std::vector<Pair> texels_;
  std::vector<Level> levels_;  ///< and one more, so that each has a next one
  std::vector<Levels> textures_;
};

/// What `find` finds, for `colours`.
class TextureAtlas::Samples {
  friend TextureAtlas;
  Corners fine, coarse;
  Lanes blend;  ///< from fine to coarse
  bool blends;
};

inline TextureAtlas::TextureAtlas(std::span<const Texture> textures) {
  std::size_t size = 0;
  for (const Texture& t : textures)  // a bound: the levels' borders included
    size += 2 * (static_cast<std::size_t>(t.width) + 2) * (static_cast<std::size_t>(t.height) + 2);
  if (size > 0xFFFFFFFFU) throw Error("TextureAtlas", concat(size / 2, " texels"), "at most 2147483648");
  append(Means::Constant(1, 3, 255));
  for (const Texture& t : textures) {
    Means means(t.height, 3 * t.width);
    for (Eigen::Index row = 0; row < means.rows(); ++row)
      for (Eigen::Index column = 0; column < t.width; ++column)
        for (Eigen::Index c = 0; c < 3; ++c)  // v grows upwards: the bottom row first
          means(row, 3 * column + c) =
              t.rgb[static_cast<std::size_t>((t.height - 1 - row) * t.width + column)][static_cast<std::size_t>(c)];
    const auto first = static_cast<float>(levels_.size());
    append(means);
    while (means.rows() > 1 || means.cols() > 3) {
      means = halved(means);
      append(means);
    }
    textures_.push_back({first, static_cast<float>(levels_.size() - 1)});
  }
  if (levels_.size() > 1U << 24U) throw Error("TextureAtlas", concat(levels_.size(), " levels"), "at most 16777216");
  levels_.push_back(levels_.back());
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
                     static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)});
  const auto texel = [&](Eigen::Index row, Eigen::Index column) {
    std::uint32_t colour = 0;
    for (Eigen::Index c = 0; c < 3; ++c)
      colour |= static_cast<std::uint32_t>(std::lround(level(row % height, 3 * (column % width) + c))) << (8 * c);
    return colour;
  };
  for (Eigen::Index row = 0; row < height; ++row)
    for (Eigen::Index column = 0; column <= width; ++column)
      texels_.push_back({texel(row, column), texel(row + 1, column)});
}

// Eigen's arrays where there is arithmetic; loops over lanes, which compilers vectorise, for the rest.
inline void TextureAtlas::find(const Footprints& f, Samples& samples) const {
  // The level on which the footprint's side, the root of its area, is one texel.
  const Lanes area = f.texels.max(1.F).min(0x1p60F);
  Lanes log2;
  for (Eigen::Index k = 0; k < lanes; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(area[k]);
    const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U) - 1;
    // log2(1 + m) to 0.01, exact at both ends: finer than a blend of two levels shows.
    log2[k] = static_cast<float>(static_cast<std::int32_t>(bits >> 23) - 127) + m * (1.34F - 0.34F * m);
  }
  const Lanes level = (f.first + 0.5F * log2).min(f.last), fine = level.floor();
  alignas(64) Words at;
  for (std::size_t k = 0; k < n; ++k) at[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(fine.data()[k]));
  const Lanes u = f.u - f.u.floor(), v = f.v - f.v.floor();
  corners(at, u, v, samples.fine);
  samples.blend = level - fine;
  samples.blends = (samples.blend > 0).any();
  if (!samples.blends) return;
  for (std::uint32_t& next : at) ++next;  // some other texture's where there is no coarser one, and no part of it
  corners(at, u, v, samples.coarse);
}

inline void TextureAtlas::colours(const Samples& samples, std::array<Lanes, 3>& rgb) const {
  bilinear(samples.fine, rgb);
  if (!samples.blends) return;
  std::array<Lanes, 3> coarse;
  bilinear(samples.coarse, coarse);
  for (std::size_t c = 0; c < 3; ++c) rgb[c] += samples.blend * (coarse[c] - rgb[c]);
}

/// At (u, v) in [0, 1].
[[gnu::noinline]] inline void TextureAtlas::corners(const Words& level, const Lanes& u, const Lanes& v,
                                                    Corners& found) const {
  alignas(64) Fours four;
  for (std::size_t k = 0; k < n; ++k) std::memcpy(four[k].data(), &levels_[level[k]], sizeof four[k]);
  alignas(64) Words begin, stride, width, height, column, row;
  for (std::size_t k = 0; k < n; ++k) {
    begin[k] = four[k][0];
    stride[k] = four[k][1];
    width[k] = four[k][2];
    height[k] = four[k][3];
  }
  // The texel whose centre comes before t, and how far t is from there; NaN is somewhere in the picture.
  const auto place = [](const Lanes& t, const Words& size, Words& before, Lanes& weight) {
    Lanes s;
    for (std::size_t k = 0; k < n; ++k) s.data()[k] = static_cast<float>(static_cast<std::int32_t>(size[k]));
    weight = t * s - 0.5F;
    weight -= s * weight.floor().min(0.F);
    for (std::size_t k = 0; k < n; ++k)
      before[k] = std::min(static_cast<std::uint32_t>(static_cast<std::int32_t>(weight.data()[k])), size[k] - 1);
    for (std::size_t k = 0; k < n; ++k) weight.data()[k] -= static_cast<float>(static_cast<std::int32_t>(before[k]));
  };
  place(u, width, column, found.along);
  place(v, height, row, found.up);
  for (std::size_t k = 0; k < n; ++k) found.texel[k] = begin[k] + row[k] * stride[k] + column[k];
  for (const std::uint32_t texel : found.texel) __builtin_prefetch(&texels_[texel]);
}

[[gnu::noinline]] inline void TextureAtlas::bilinear(const Corners& corners, std::array<Lanes, 3>& rgb) const {
  alignas(64) Fours four;
  for (std::size_t k = 0; k < n; ++k) std::memcpy(four[k].data(), &texels_[corners.texel[k]], sizeof four[k]);
  alignas(64) Words corner[4];  // lower left, upper left, lower right, upper right
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < 4; ++i) corner[i][k] = four[k][i];
  for (std::uint32_t c = 0; c < 3; ++c) {
    Lanes value[4];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < n; ++k)
        value[i][static_cast<Eigen::Index>(k)] =
            static_cast<float>(static_cast<std::int32_t>((corner[i][k] >> (8 * c)) & 0xFFU));
    const Lanes left = value[0] + corners.up * (value[1] - value[0]),
                right = value[2] + corners.up * (value[3] - value[2]);
    rgb[c] = (left + corners.along * (right - left)) * (1 / 255.F);
  }
}

}  // namespace vantage
