// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/visible_splats.hpp>

namespace vantage {

/// The least of xx dx^2 + xy dx dy + yy dy^2 over the rectangle x0 <= dx <= x1, y0 <= dy <= y1: 0 if it holds the
/// centre, else on one of the two sides that face it.
template <class T>
T least_over_box(float xx, float xy, float yy, const T& x0, const T& x1, const T& y0, const T& y1) {
  using std::max;
  using std::min;
  const T zero = T(0), dx = min(max(zero, x0), x1), dy = min(max(zero, y0), y1);
  const float y_of_x = -0.5F * xy / yy, x_of_y = -0.5F * xy / xx;  // where the form is least on a line
  const T along_y = min(max(y_of_x * dx, y0), y1), along_x = min(max(x_of_y * dy, x0), x1);
  const T at_x = dx * (xx * dx + xy * along_y) + yy * along_y * along_y;
  const T at_y = along_x * (xx * along_x + xy * dy) + yy * dy * dy;
  return min(at_x, at_y);
}
/// How far below a splat's opacity (base 2) it is still drawn; a hair more, for rounding.
inline float drawn_reach(const PackedSplat& s) { return s.log2_opacity - log2_least_alpha + 1e-4F; }

/// Which splats each tile of the image draws, near to far (of equal depths the lower surfel first). Splats are sorted
/// once by depth and then dealt to their tiles in that order, so that no tile sorts.
class TileBins {
 public:
  /// O(splats + entries).
  template <int tile>
  void fill(const VisibleSplats& splats, const Camera& camera) {
    tiles_x_ = static_cast<std::size_t>((camera.width + tile - 1) / tile);
    tiles_y_ = static_cast<std::size_t>((camera.height + tile - 1) / tile);
    sort_by_depth(splats);
    deal<tile>(splats);
  }

  [[nodiscard]] std::size_t tiles() const { return tiles_x_ * tiles_y_; }
  [[nodiscard]] std::size_t tiles_x() const { return tiles_x_; }
  [[nodiscard]] std::size_t entries() const { return begin_.empty() ? 0 : begin_.back(); }
  /// Where a tile's entries begin among all.
  [[nodiscard]] std::size_t begin(std::size_t tile) const { return begin_[tile]; }
  /// The splats of a tile.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t tile) const {
    return {entry_.data() + begin_[tile], begin_[tile + 1] - begin_[tile]};
  }
  /// Where a splat stands among all entries, tile by tile.
  [[nodiscard]] std::span<const std::uint32_t> places(std::uint32_t splat) const {
    const auto [first, n] = dealt_[splat];
    return {place_.data() + first, n};
  }

 private:
  static constexpr std::size_t block = 2048;
  struct Dealt {
    std::uint32_t first, count;
  };

  // By the bits of their depths, which order as positive floats do: three stable passes of 11 bits.
  void sort_by_depth(const VisibleSplats& splats) {
    order_.clear();
    std::array<std::array<std::uint32_t, 2048>, 3> count{};
    for (std::size_t c = 0; c < splats.chunks(); ++c)
      for (std::size_t k = c * VisibleSplats::chunk; k < c * VisibleSplats::chunk + splats.count(c); ++k) {
        const auto z = std::bit_cast<std::uint32_t>(splats.splat[k].z);
        order_.push_back({z, static_cast<std::uint32_t>(k)});
        for (std::size_t pass = 0; pass < 3; ++pass) ++count[pass][z >> (11 * pass) & 2047U];
      }
    other_.resize(order_.size());
    for (std::size_t pass = 0; pass < 3; ++pass) {
      std::uint32_t sum = 0;
      for (std::uint32_t& c : count[pass]) sum += std::exchange(c, sum);
      for (const Key& key : order_) other_[count[pass][key.z >> (11 * pass) & 2047U]++] = key;
      order_.swap(other_);
    }
  }

  template <int tile>
  void deal(const VisibleSplats& splats) {
    const std::size_t blocks = (order_.size() + block - 1) / block, n_tiles = tiles();
    dealt_.resize(splats.end());
    if (emitted_.size() < blocks) emitted_.resize(blocks);
    histogram_.assign(blocks * n_tiles, 0);
    parallel_for_blocks(order_.size(), block, [&](std::size_t begin, std::size_t end) {
      auto& out = emitted_[begin / block];
      std::uint32_t* histogram = histogram_.data() + begin / block * n_tiles;
      out.clear();
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t k = order_[i].splat;
        if (i + 16 < end) {  // splats stand in memory in another order
          const std::uint32_t soon = order_[i + 16].splat;
          __builtin_prefetch(&splats.splat[soon]);
          __builtin_prefetch(&splats.box[soon]);
        }
        const std::size_t before = out.size();
        for_tiles<tile>(splats.splat[k], splats.box[k], [&](std::size_t t) {
          out.push_back({static_cast<std::uint32_t>(t), k});
          ++histogram[t];
        });
        dealt_[k] = {static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(out.size() - before)};
      }
    });
    begin_.resize(n_tiles + 1);
    std::uint32_t sum = 0;
    for (std::size_t t = 0; t < n_tiles; ++t) {
      begin_[t] = sum;
      for (std::size_t b = 0; b < blocks; ++b) sum += std::exchange(histogram_[b * n_tiles + t], sum);
    }
    begin_[n_tiles] = sum;
    entry_.resize(sum);
    place_.resize(sum);
    first_.assign(blocks + 1, 0);
    for (std::size_t b = 0; b < blocks; ++b) first_[b + 1] = first_[b] + static_cast<std::uint32_t>(emitted_[b].size());
    parallel_for_blocks(order_.size(), block, [&](std::size_t begin, std::size_t end) {
      const std::size_t b = begin / block;
      std::uint32_t* next = histogram_.data() + b * n_tiles;
      std::uint32_t place = first_[b];
      for (const Emitted& e : emitted_[b]) {
        const std::uint32_t at = next[e.tile]++;
        entry_[at] = e.splat;
        place_[place++] = at;
      }
      for (std::size_t i = begin; i < end; ++i) dealt_[order_[i].splat].first += first_[b];
    });
  }

  // f(tile) for those that the ellipse itself reaches, not just its box.
  template <int tile, class F>
  void for_tiles(const PackedSplat& s, const PixelBox& box, F&& f) const {
    const int x0 = box.x0 / tile, x1 = box.x1 / tile, y0 = box.y0 / tile, y1 = box.y1 / tile;
    const bool corners = x0 < x1 && y0 < y1;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        if (corners) {
          const float left = static_cast<float>(x * tile) - s.u, top = static_cast<float>(y * tile) - s.v;
          if (least_over_box(s.xx, s.xy, s.yy, left, left + (tile - 1), top, top + (tile - 1)) > drawn_reach(s))
            continue;
        }
        f(static_cast<std::size_t>(y) * tiles_x_ + static_cast<std::size_t>(x));
      }
  }

  struct Key {
    std::uint32_t z, splat;
  };
  struct Emitted {
    std::uint32_t tile, splat;
  };
  std::size_t tiles_x_ = 0, tiles_y_ = 0;
  std::vector<Key> order_, other_;
  std::vector<std::vector<Emitted>> emitted_;
  std::vector<std::uint32_t> histogram_, begin_, entry_, place_, first_;
  std::vector<Dealt> dealt_;
};

}  // namespace vantage
