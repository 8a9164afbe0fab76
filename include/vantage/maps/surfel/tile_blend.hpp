// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <vantage/maps/surfel/raster_images.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>
#include <vantage/maps/surfel/tile_pixels.hpp>

namespace vantage {

/// Sums over a pixel's surfels: sixteen pixels each.
enum BlendSum : std::size_t {
  sum_red,
  sum_green,
  sum_blue,
  sum_depth,
  sum_normal_x,
  sum_normal_y,
  sum_normal_z,
  light_left,
  sum_confidence,
  blend_sums
};
/// What backward needs of a forward: all but the confidence.
inline constexpr std::size_t kept_sums = sum_confidence;
/// Of a tile: one number a pixel, sub-block by sub-block.
template <int tile>
using TilePlane = std::array<Lanes<float>, TilePixels<tile>::blocks>;
template <int tile>
using KeptSums = std::array<TilePlane<tile>, kept_sums>;

/// Draws the splats of a tile into the channels of R (eqs. 6.2, 6.3), sub-block by sub-block: its sums stay in
/// registers while its own list of splats goes by.
template <int tile, class Depth, class R>
class TileBlend {
 public:
  static constexpr std::size_t blocks = TilePixels<tile>::blocks;

  TileBlend(const RasterView& view, const TilePixels<tile>& pixels) : view_(view), pixels_(pixels) {
    for (std::size_t b = 0; b < blocks; ++b) {
      if (!pixels.has_pixels(b)) continue;
      open_ |= std::uint64_t{1} << b;
      light_[b] = Transmittance(pixels, b);
    }
    for (auto& sum : sums_) sum.fill(Lanes<float>(0.0F));
  }

  void draw(const VisibleSplats& from, std::span<const std::uint32_t> index) {
    TileSplats<tile> splats;
    for (std::size_t i = 0; i < index.size() && open_ != 0; i += splats.capacity) {
      splats.load(from, index.subspan(i, std::min(index.size() - i, splats.capacity)), pixels_);
      draw(splats);
    }
  }

  /// The channels' pixels, and what backward needs.
  void write(R& out, KeptSums<tile>& kept) {
    using L = Lanes<float>;
    TilePlane<tile> opacity;
    for (std::size_t b = 0; b < blocks; ++b) {
      kept[light_left][b] = light_[b].left;
      opacity[b] = 1.0F - light_[b].left;
    }
    if constexpr (draws<channel::Colour, R>) {
      channel::Colour& c = out;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t b = 0; b < blocks; ++b) sums_[sum_red + k][b] += light_[b].left * view_.background[k];
      write(sum_red, kept, c.r);
      write(sum_green, kept, c.g);
      write(sum_blue, kept, c.b);
    }
    if constexpr (draws<channel::Depth, R>) {
      kept[sum_depth] = sums_[sum_depth];
      const L least = 1e-6F, nothing = std::numeric_limits<float>::quiet_NaN();
      for (std::size_t b = 0; b < blocks; ++b)
        sums_[sum_depth][b] = select(opacity[b] > least, sums_[sum_depth][b] / max(opacity[b], least), nothing);
      pixels_.write(sums_[sum_depth], out.depth);
    }
    if constexpr (draws<channel::Normal, R>) {
      channel::Normal& n = out;
      write(sum_normal_x, kept, n.x);
      write(sum_normal_y, kept, n.y);
      write(sum_normal_z, kept, n.z);
    }
    if constexpr (draws<channel::Opacity, R>) pixels_.write(opacity, out.opacity);
    if constexpr (draws<channel::Confidence, R>) pixels_.write(sums_[sum_confidence], out.confidence);
  }

 private:
  void draw(const TileSplats<tile>& splats) {
    std::array<std::array<std::uint8_t, TileSplats<tile>::capacity>, blocks> list;
    std::array<std::uint8_t, blocks> length{};
    for (std::size_t i = 0; i < splats.n; ++i)
      for (std::uint64_t to = splats.reach[i] & open_; to != 0; to &= to - 1) {
        const auto b = static_cast<std::size_t>(std::countr_zero(to));
        list[b][length[b]++] = static_cast<std::uint8_t>(i);
      }
    for (std::size_t b = 0; b < blocks; ++b)
      if (length[b] != 0) draw(splats, {list[b].data(), length[b]}, b);
  }

  void draw(const TileSplats<tile>& splats, std::span<const std::uint8_t> list, std::size_t b) {
    const Lanes<float> x = pixels_.x(b), y = pixels_.y(b);
    Transmittance light = light_[b];
    std::array<Lanes<float>, blend_sums> sums;
    for (std::size_t k = 0; k < blend_sums; ++k) sums[k] = sums_[k][b];
    for (const std::uint8_t i : list) {
      const PackedSplat& s = splats.splat[i];
      const Transmittance::Drawn d = light.draw(s, x, y);
      if constexpr (draws<channel::Colour, R>)
        for (std::size_t k = 0; k < 3; ++k) sums[sum_red + k] += d.weight * s.colour[k];
      if constexpr (draws<channel::Depth, R>)
        sums[sum_depth] += d.weight * Depth::at(Lanes<float>(s.z), d.dx * s.zx + d.dy * s.zy).depth;
      if constexpr (draws<channel::Normal, R>)
        for (std::size_t k = 0; k < 3; ++k) sums[sum_normal_x + k] += d.weight * s.normal[k];
      if constexpr (draws<channel::Confidence, R>) sums[sum_confidence] += d.weight * s.confidence;
      if (light.full()) {
        open_ &= ~(std::uint64_t{1} << b);
        break;
      }
    }
    light_[b] = light;
    for (std::size_t k = 0; k < blend_sums; ++k) sums_[k][b] = sums[k];
  }

  void write(BlendSum sum, KeptSums<tile>& kept, Image<float>& image) {
    kept[sum] = sums_[sum];
    pixels_.write(sums_[sum], image);
  }

  const RasterView& view_;
  const TilePixels<tile>& pixels_;
  std::uint64_t open_ = 0;
  std::array<Transmittance, blocks> light_;
  std::array<TilePlane<tile>, blend_sums> sums_;
};

}  // namespace vantage
