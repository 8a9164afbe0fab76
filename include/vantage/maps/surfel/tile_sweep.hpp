// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <vantage/maps/surfel/tile_blend.hpp>

namespace vantage {

/// Sixteen numbers of one splat in one tile.
using SplatSums = Lanes<float>;

/// Draws the splats of a tile once more, splat by splat, so that what `Pixels` sums of one stays in registers until it
/// has been drawn. `Pixels` offers Sums (made anew for every splat), add(sums, sub-block, splat, drawn) and
/// write(sums, place), place = 0 for the tile's first splat.
template <int tile, class Pixels>
void sweep_tile(const VisibleSplats& from, std::span<const std::uint32_t> index, const TilePixels<tile>& at,
                Pixels& pixels) {
  constexpr std::size_t blocks = TilePixels<tile>::blocks;
  std::array<Lanes<float>, blocks> x, y;
  std::array<Transmittance, blocks> light;
  std::uint64_t open = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    if (!at.has_pixels(b)) continue;
    open |= std::uint64_t{1} << b;
    x[b] = at.x(b);
    y[b] = at.y(b);
    light[b] = Transmittance(at, b);
  }
  TileSplats<tile> splats;
  std::size_t i = 0;
  for (; i < index.size() && open != 0; i += splats.capacity) {
    splats.load(from, index.subspan(i, std::min(index.size() - i, splats.capacity)), at);
    for (std::size_t k = 0; k < splats.n; ++k) {
      const PackedSplat& s = splats.splat[k];
      typename Pixels::Sums sums;
      for (std::uint64_t to = splats.reach[k] & open; to != 0; to &= to - 1) {
        const auto b = static_cast<std::size_t>(std::countr_zero(to));
        pixels.add(sums, b, s, light[b].draw(s, x[b], y[b]));
        if (light[b].full()) open &= ~(std::uint64_t{1} << b);
      }
      pixels.write(sums, i + k);
    }
  }
  for (; i < index.size(); ++i) pixels.write({}, i);  // hidden
}

/// Derivatives of a loss by a splat: colour, then depth by z, by its slope, and that by dx, dy; normal; then with h the
/// derivative by log alpha, the sums of h, h dx, h dy, h dx^2, h dx dy, h dy^2.
enum GradientSum : std::size_t { by_colour = 0, by_depth = 3, by_normal = 7, by_log_alpha = 10 };

/// From near to far: what lies behind a surfel is the whole image less what has been drawn, so that nothing is divided
/// by the light that is left.
template <int tile, class Depth>
class GradientPixels {
 public:
  static constexpr std::size_t blocks = TilePixels<tile>::blocks;
  struct Sums {
    std::array<Lanes<float>, 16> value;
    Sums() { value.fill(Lanes<float>(0.0F)); }
  };

  GradientPixels(const TilePixels<tile>& at, const ImageGradient& d, const KeptSums<tile>& kept, SplatSums* out)
      : out_(out) {
    using L = Lanes<float>;
    const std::array<const Image<float>*, 8> by = {&d.colour.r, &d.colour.g, &d.colour.b, &d.depth,
                                                   &d.normal_x, &d.normal_y, &d.normal_z, &d.opacity};
    for (auto& sum : behind_) sum = L(0);
    for (std::size_t k = 0; k < by.size(); ++k) {
      TilePlane<tile> g;
      at.read(*by[k], g);
      for (std::size_t b = 0; b < blocks; ++b) {
        if (k == sum_depth) {  // sum w z / sum w
          const L opacity = 1.0F - kept[light_left][b], least = 1e-6F;
          g[b] = select(opacity > least, g[b] / max(opacity, least), L(0));
        }
        by_[b][k] = g[b];
        if (k < light_left && by[k]->size() != 0) behind_[b] += g[b] * kept[k][b];
      }
    }
    for (std::size_t b = 0; b < blocks; ++b) {
      const L opacity = 1.0F - kept[light_left][b];
      if (d.depth.size() != 0) by_[b][light_left] -= by_[b][sum_depth] * kept[sum_depth][b] / max(opacity, L(1e-6F));
      behind_[b] += by_[b][light_left] * opacity;
    }
  }

  [[gnu::always_inline]] void add(Sums& sums, std::size_t b, const PackedSplat& s, const Transmittance::Drawn& d) {
    using L = Lanes<float>;
    const auto& g = by_[b];
    const DepthAt<L> depth = Depth::at(L(s.z), d.dx * s.zx + d.dy * s.zy);
    const L drawn = g[0] * s.colour[0] + g[1] * s.colour[1] + g[2] * s.colour[2] + g[3] * depth.depth +
                    g[4] * s.normal[0] + g[5] * s.normal[1] + g[6] * s.normal[2] + g[7];
    behind_[b] -= d.weight * drawn;
    const L h = select(d.raw > L(0.99F), L(0), d.alpha * (d.before * drawn - behind_[b] / (1.0F - d.alpha)));
    auto& v = sums.value;
    for (std::size_t k = 0; k < 3; ++k) {
      v[by_colour + k] += d.weight * g[k];
      v[by_normal + k] += d.weight * g[4 + k];
    }
    const L by_z = d.weight * g[3], by_slope = by_z * depth.by_slope;
    v[by_depth] += by_z * depth.by_z;
    v[by_depth + 1] += by_slope;
    v[by_depth + 2] += by_slope * d.dx;
    v[by_depth + 3] += by_slope * d.dy;
    const L hx = h * d.dx, hy = h * d.dy;
    v[by_log_alpha] += h;
    v[by_log_alpha + 1] += hx;
    v[by_log_alpha + 2] += hy;
    v[by_log_alpha + 3] += hx * d.dx;
    v[by_log_alpha + 4] += hx * d.dy;
    v[by_log_alpha + 5] += hy * d.dy;
  }
  void write(const Sums& sums, std::size_t place) { out_[place] = LaneSums::of(sums.value); }

 private:
  std::array<std::array<Lanes<float>, 8>, blocks> by_;
  std::array<Lanes<float>, blocks> behind_;
  SplatSums* out_;
};

/// The largest weight of each splat at a pixel with a measurement.
template <int tile>
class VisibilityPixels {
 public:
  static constexpr std::size_t blocks = TilePixels<tile>::blocks;
  struct Sums {
    Lanes<float> largest = 0.0F;
  };
  VisibilityPixels(const TilePixels<tile>& at, const Image<float>& measured, float* out) : out_(out) {
    TilePlane<tile> depth;
    at.read(measured, depth);
    for (std::size_t b = 0; b < blocks; ++b) counts_[b] = depth[b] > Lanes<float>(0.0F);
  }
  [[gnu::always_inline]] void add(Sums& sums, std::size_t b, const PackedSplat&, const Transmittance::Drawn& d) {
    sums.largest = max(sums.largest, select(counts_[b], d.weight, Lanes<float>(0.0F)));
  }
  void write(const Sums& sums, std::size_t place) {
    const auto v = sums.largest.values();
    out_[place] = *std::max_element(v.begin(), v.end());
  }

 private:
  std::array<LaneMask, blocks> counts_;
  float* out_;
};

/// For the Fisher information of the sum of a pixel's colours: with h its derivative by log alpha, the sums of h^2
/// times 1, x, y, xx, xy, yy, xxx, ..., yyyy (dx, dy for x, y), and last that of w^2.
template <int tile>
class FisherPixels {
 public:
  static constexpr std::size_t blocks = TilePixels<tile>::blocks;
  struct Sums {
    std::array<Lanes<float>, 16> value;
    Sums() { value.fill(Lanes<float>(0.0F)); }
  };
  FisherPixels(const KeptSums<tile>& kept, SplatSums* out) : out_(out) {
    for (std::size_t b = 0; b < blocks; ++b) behind_[b] = kept[sum_red][b] + kept[sum_green][b] + kept[sum_blue][b];
  }
  [[gnu::always_inline]] void add(Sums& sums, std::size_t b, const PackedSplat& s, const Transmittance::Drawn& d) {
    using L = Lanes<float>;
    const float drawn = s.colour[0] + s.colour[1] + s.colour[2];
    behind_[b] -= d.weight * drawn;
    const L h = select(d.raw > L(0.99F), L(0), d.alpha * (d.before * drawn - behind_[b] / (1.0F - d.alpha)));
    std::array<L, 5> row = {h * h};  // of one degree: x^n, x^(n - 1) y, ..., y^n
    std::size_t j = 0;
    for (std::size_t degree = 0; degree <= 4; ++degree) {
      for (std::size_t k = 0; k <= degree; ++k) sums.value[j++] += row[k];
      if (degree == 4) break;
      row[degree + 1] = row[degree] * d.dy;
      for (std::size_t k = 0; k <= degree; ++k) row[k] = row[k] * d.dx;
    }
    sums.value[15] += d.weight * d.weight;
  }
  void write(const Sums& sums, std::size_t place) { out_[place] = LaneSums::of(sums.value); }

 private:
  std::array<Lanes<float>, blocks> behind_;
  SplatSums* out_;
};

}  // namespace vantage
