// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <vantage/core/lanes.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/projection.hpp>

namespace vantage {

/// What drawing a pixel needs of a splat: one cache line. The Gaussian is 2^(log2_opacity - (xx dx^2 + xy dx dy + yy
/// dy^2)), opacity included.
struct alignas(64) PackedSplat {
  float u, v, log2_opacity, xx, xy, yy;
  float z, zx, zy;
  std::array<float, 3> colour, normal;
  float confidence;
};
static_assert(sizeof(PackedSplat) == 64);

/// The least alpha that is drawn, as the published kernels have it.
inline constexpr float log2_least_alpha = -7.994353436858858F;  // log2(1/255)

/// First and last pixel of the box about the ellipse where alpha is at least 1/255, within the image.
struct PixelBox {
  std::uint16_t x0, x1, y0, y1;
};

/// Sixteen surfels' parameters, by index; a lane beyond n repeats the first.
inline surfel::Parameters<Lanes<float>> gather_surfels(const Surfels& s, const std::uint32_t* index, std::size_t n) {
  std::array<std::uint32_t, 16> at;
  for (std::size_t l = 0; l < 16; ++l) at[l] = index[l < n ? l : 0];
  surfel::Parameters<Lanes<float>> in;
  for (std::size_t p = 0; p < surfel::parameters; ++p)
    in[p] = Lanes<float>::generate([&, values = s.parameter[p].data()](std::size_t l) { return values[at[l]]; });
  return in;
}

/// The splats of all surfels that a view shows, in the order of the surfels, in fixed chunks with room at their ends.
/// Made anew it allocates nothing unless there are more than ever before.
class VisibleSplats {
 public:
  static constexpr std::size_t chunk = 1024;

  /// O(surfels) for where they are, and O(surfels in sight) for the rest.
  template <class Depth>
  void project(const Surfels& s, const RasterView& view) {
    const Projector<float> camera(view, s.scale);
    find_in_sight(s, camera);
    const std::size_t chunks = (in_sight_.size() + chunk - 1) / chunk;
    count_.assign(chunks, 0);
    resize(chunks * chunk);
    parallel_for(chunks, [&](std::size_t c) {
      const std::size_t end = std::min(in_sight_.size(), (c + 1) * chunk);
      for (std::size_t i = c * chunk; i < end; i += 16) add<Depth>(s, camera, c, i, std::min<std::size_t>(16, end - i));
    });
  }

  [[nodiscard]] std::size_t chunks() const { return count_.size(); }
  /// Splats c * chunk to c * chunk + count(c) are there.
  [[nodiscard]] std::size_t count(std::size_t c) const { return count_[c]; }
  [[nodiscard]] std::size_t size() const {
    std::size_t n = 0;
    for (const std::size_t c : count_) n += c;
    return n;
  }
  /// One past the last splat.
  [[nodiscard]] std::size_t end() const { return splat.size(); }

  std::vector<PackedSplat> splat;
  std::vector<PixelBox> box;
  std::vector<std::uint32_t> surfel;

 private:
  static constexpr std::size_t block = 4096;

  void resize(std::size_t n) {
    splat.resize(n);
    box.resize(n);
    surfel.resize(n);
  }

  void find_in_sight(const Surfels& s, const Projector<float>& camera) {
    const std::size_t n = s.size(), blocks = (n + block - 1) / block;
    found_.resize(n);
    found_count_.assign(blocks + 1, 0);
    parallel_for_blocks(n, block, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* out = found_.data() + begin;
      for (std::size_t i = begin; i < end; i += 16) {
        std::array<Lanes<float>, 3> x;
        for (std::size_t k = 0; k < 3; ++k) {
          const float* values = s.parameter[surfel::x + k].data() + i;
          x[k] = i + 16 <= end ? Lanes<float>::load(values) : Lanes<float>::generate([&](std::size_t l) {
            return i + l < end ? values[l] : std::numeric_limits<float>::quiet_NaN();
          });
        }
        const auto p = camera.to_camera(x);
        for (std::uint32_t lanes = bits(camera.in_sight(p, camera.pixel(p))); lanes != 0; lanes &= lanes - 1)
          *out++ = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(lanes));
      }
      found_count_[begin / block + 1] = static_cast<std::size_t>(out - (found_.data() + begin));
    });
    for (std::size_t b = 0; b < blocks; ++b) found_count_[b + 1] += found_count_[b];
    in_sight_.resize(found_count_[blocks]);
    parallel_for(blocks, [&](std::size_t b) {
      std::copy_n(found_.data() + b * block, found_count_[b + 1] - found_count_[b], in_sight_.data() + found_count_[b]);
    });
  }

  // Splats of n <= 16 surfels in sight, those that reach a pixel, at the end of a chunk.
  template <class Depth>
  void add(const Surfels& s, const Projector<float>& camera, std::size_t c, std::size_t first, std::size_t n) {
    using L = Lanes<float>;
    const std::uint32_t* index = in_sight_.data() + first;
    const surfel::Parameters<L> in = gather_surfels(s, index, n);
    const L confidence = L::generate([&](std::size_t l) { return s.confidence[index[l < n ? l : 0]]; });
    const Splat<L> at = vantage::project<Depth>(camera, in);
    const L log2_opacity = log2(at.opacity), reach = log2_opacity - L(log2_least_alpha);
    // Half the ellipse's box: the Gaussian's exponent (base 2) falls by reach. A hair more, for rounding.
    constexpr float to_natural = 2 * 0.693147180559945F;
    const L width = sqrt(max(reach, L(0)) * to_natural * at.covariance[0]) + 1e-3F,
            height = sqrt(max(reach, L(0)) * to_natural * at.covariance[2]) + 1e-3F;
    const auto first_pixel = [](const L& low) { return max(low, L(0)).values(); };
    const auto last_pixel = [](const L& high, float size) { return min(high, L(size - 1)).values(); };
    const auto x0 = first_pixel(at.centre[0] - width), x1 = last_pixel(at.centre[0] + width, camera.size[0]),
               y0 = first_pixel(at.centre[1] - height), y1 = last_pixel(at.centre[1] + height, camera.size[1]);
    constexpr float log2_e = 1.44269504088896F;
    const std::array<std::array<float, 16>, 16> packed = {at.centre[0].values(),
                                                          at.centre[1].values(),
                                                          log2_opacity.values(),
                                                          (at.conic[0] * (0.5F * log2_e)).values(),
                                                          (at.conic[1] * log2_e).values(),
                                                          (at.conic[2] * (0.5F * log2_e)).values(),
                                                          at.p[2].values(),
                                                          at.slope[0].values(),
                                                          at.slope[1].values(),
                                                          in[surfel::red].values(),
                                                          in[surfel::green].values(),
                                                          in[surfel::blue].values(),
                                                          at.axis[2][0].values(),
                                                          at.axis[2][1].values(),
                                                          at.axis[2][2].values(),
                                                          confidence.values()};
    const std::uint32_t drawn = bits(all_hold(is_drawn(camera, in, confidence, at), reach >= L(0)));
    for (std::size_t l = 0; l < n; ++l) {
      if ((drawn >> l & 1U) == 0) continue;
      const float left = std::ceil(x0[l]), right = std::floor(x1[l]), top = std::ceil(y0[l]),
                  bottom = std::floor(y1[l]);
      if (!(left <= right && top <= bottom)) continue;
      const std::size_t k = c * chunk + count_[c]++;
      alignas(64) std::array<float, 16> line;
      for (std::size_t p = 0; p < 16; ++p) line[p] = packed[p][l];
      splat[k] = std::bit_cast<PackedSplat>(line);
      box[k] = {static_cast<std::uint16_t>(left), static_cast<std::uint16_t>(right), static_cast<std::uint16_t>(top),
                static_cast<std::uint16_t>(bottom)};
      surfel[k] = index[l];
    }
  }

  std::vector<std::uint32_t> found_, in_sight_;
  std::vector<std::size_t> found_count_, count_;
};

}  // namespace vantage
