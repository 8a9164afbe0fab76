// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include <vantage/core/lanes.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/maps/surfel/depth_model.hpp>
#include <vantage/maps/surfel/tile_bins.hpp>

namespace vantage {

/// A square of `tile` x `tile` pixels, cut into sub-blocks of 4 x 4: one pixel a lane, row by row.
template <int tile>
struct TilePixels {
  static_assert(tile == 8 || tile == 16 || tile == 32, "a tile has 8, 16 or 32 pixels a side");
  static constexpr std::size_t across = tile / 4, blocks = across * across;

  int left, top;  ///< [px]
  Camera camera;

  TilePixels(const TileBins& bins, std::size_t t, const Camera& c)
      : left(static_cast<int>(t % bins.tiles_x()) * tile),
        top(static_cast<int>(t / bins.tiles_x()) * tile),
        camera(c) {}

  [[nodiscard]] int block_left(std::size_t b) const { return left + 4 * static_cast<int>(b % across); }
  [[nodiscard]] int block_top(std::size_t b) const { return top + 4 * static_cast<int>(b / across); }
  [[nodiscard]] bool has_pixels(std::size_t b) const {
    return block_left(b) < camera.width && block_top(b) < camera.height;
  }
  [[nodiscard]] Lanes<float> x(std::size_t b) const {
    const int column = block_left(b);
    return Lanes<float>::generate([=](std::size_t l) { return static_cast<float>(column + static_cast<int>(l % 4)); });
  }
  [[nodiscard]] Lanes<float> y(std::size_t b) const {
    const int row = block_top(b);
    return Lanes<float>::generate([=](std::size_t l) { return static_cast<float>(row + static_cast<int>(l / 4)); });
  }
  /// In each lane whether the image has that pixel.
  [[nodiscard]] LaneMask in_image(std::size_t b) const {
    const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
    return all_hold(x(b) < Lanes<float>(width), y(b) < Lanes<float>(height));
  }
  /// Row by row of the tile, so that a cache line of the image is used at once. Pixels outside of the image, and those
  /// of an empty image, are 0.
  void read(const Image<float>& image, std::array<Lanes<float>, blocks>& values) const {
    for (auto& v : values) v = Lanes<float>(0);
    if (image.size() == 0) return;
    each_four(values, [&](float* four, int n, int row, int column) {
      if (n == 4)
        std::memcpy(four, &image(row, column), 4 * sizeof(float));
      else
        std::copy_n(&image(row, column), n, four);
    });
  }
  void write(std::array<Lanes<float>, blocks>& values, Image<float>& image) const {
    each_four(values, [&](const float* four, int n, int row, int column) {
      if (n == 4)
        std::memcpy(&image(row, column), four, 4 * sizeof(float));
      else
        std::copy_n(four, n, &image(row, column));
    });
  }

 private:
  // f(values, how many the image has, row, column) for the rows of sub-blocks, along the rows of the tile.
  template <class F>
  void each_four(std::array<Lanes<float>, blocks>& values, F&& f) const {
    const auto four = [&](int r, int c, int n) {
      const auto b = static_cast<std::size_t>(r / 4) * across + static_cast<std::size_t>(c / 4);
      f(values[b].data() + 4 * (r % 4), n, top + r, left + c);
    };
    const int rows = std::min(tile, camera.height - top), columns = std::min(tile, camera.width - left);
    if (columns == tile) {  // what the compiler unrolls
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < tile; c += 4) four(r, c, 4);
      return;
    }
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; c += 4) four(r, c, std::min(4, columns - c));
  }
};

/// Some consecutive splats of a tile, side by side, and which sub-blocks each reaches.
template <int tile>
struct TileSplats {
  static constexpr std::size_t capacity = 128;
  static constexpr std::size_t blocks = TilePixels<tile>::blocks;

  std::array<PackedSplat, capacity> splat;
  std::array<std::uint64_t, capacity> reach;  ///< bit b: sub-block b
  std::size_t n = 0;

  void load(const VisibleSplats& from, std::span<const std::uint32_t> index, const TilePixels<tile>& pixels) {
    n = index.size();
    constexpr std::size_t across = TilePixels<tile>::across;
    constexpr std::size_t ahead = 8;  // splats come from all over memory
    for (std::size_t i = 0; i < std::min(ahead, n); ++i) __builtin_prefetch(&from.splat[index[i]]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i + ahead < n) __builtin_prefetch(&from.splat[index[i + ahead]]);
      const PackedSplat& s = splat[i] = from.splat[index[i]];
      reach[i] = 0;
      for (std::size_t first = 0; first < blocks; first += 16) {
        using L = Lanes<float>;
        const L x0 = L::generate([&](std::size_t l) { return static_cast<float>(4 * ((first + l) % across)); }) +
                     (static_cast<float>(pixels.left) - s.u);
        const L y0 = L::generate([&](std::size_t l) {
                       const std::size_t row = (first + l) / across;
                       return static_cast<float>(4 * row);
                     }) +
                     (static_cast<float>(pixels.top) - s.v);
        const L least = least_over_box(s.xx, s.xy, s.yy, x0, x0 + 3.0F, y0, y0 + 3.0F);
        reach[i] |= std::uint64_t{bits(least <= L(drawn_reach(s)))} << first;
      }
      if constexpr (blocks < 16) reach[i] &= (1U << blocks) - 1;
    }
  }
};

/// What has been drawn of sixteen pixels: the light still let through, and from which exponent (base 2) on a splat is
/// drawn: never, once a pixel is full.
struct Transmittance {
  Lanes<float> left = 1.0F, least = log2_least_alpha;

  Transmittance() = default;
  template <int tile>
  Transmittance(const TilePixels<tile>& pixels, std::size_t b) {
    least = select(pixels.in_image(b), least, Lanes<float>(never));
  }
  [[nodiscard]] bool full() const { return !any(least < Lanes<float>(never)); }

  /// What sixteen pixels draw of a splat.
  struct Drawn {
    Lanes<float> dx, dy, raw, alpha, weight, before;  ///< alpha and weight are 0 where nothing is drawn
  };
  /// Draws a splat over what was drawn before (eq. 6.3): alpha at most 0.99 and at least 1/255, and no surfel that
  /// would leave less than 1e-4.
  [[gnu::always_inline]] Drawn draw(const PackedSplat& s, const Lanes<float>& x, const Lanes<float>& y) {
    using L = Lanes<float>;
    Drawn d;
    d.dx = x - s.u;
    d.dy = y - s.v;
    const L exponent = s.log2_opacity - d.dx * (s.xx * d.dx + s.xy * d.dy) - d.dy * (s.yy * d.dy);
    d.raw = exp2_within(exponent);
    const L alpha = select(exponent >= least, min(d.raw, L(0.99F)), L(0));
    const L after = left - alpha * left;
    const LaneMask fills = after < L(1e-4F);
    d.before = left;
    d.alpha = select(fills, L(0), alpha);
    d.weight = d.alpha * left;
    left = select(fills, left, after);
    least = select(fills, L(never), least);
    return d;
  }

 private:
  static constexpr float never = std::numeric_limits<float>::infinity();
};

}  // namespace vantage
