// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/scene.hpp>

// Textures made in memory. Colours are RGB in [0, 1]; u runs to the right and v upwards, both over [0, 1); all of them
// repeat without a seam unless said otherwise.
namespace vantage::procedural {

using Colour = Eigen::Vector3f;

inline constexpr int texture_size = 256;  ///< [px] a side

/// The texture of colour(u, v) at the texels' centres; colours are clamped. Rows run concurrently.
template <class F>
Texture paint(F&& colour, int width = texture_size, int height = texture_size) {
  Texture t{width, height, {}};
  t.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  parallel_for_blocks(static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int column = 0; column < width; ++column) {
        const Colour c = colour((static_cast<float>(column) + 0.5F) / static_cast<float>(width),
                                1 - (static_cast<float>(row) + 0.5F) / static_cast<float>(height));
        auto& texel = t.rgb[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
        for (Eigen::Index k = 0; k < 3; ++k)
          texel[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(c[k], 0.F, 1.F)));
      }
  });
  return t;
}

/// Periodic value noise in [0, 1]: octaves of random lattices, smoothly interpolated, each twice as fine and half as
/// strong as the one before. A value type; const members run concurrently.
class FractalNoise {
 public:
  /// The coarsest lattice has columns x rows cells over the unit square, 1 to 64 each.
  FractalNoise(int columns, int rows, int octaves, Rng rng) : columns_(columns), rows_(rows) {
    for (int o = 0; o < octaves; ++o) {
      std::vector<float>& lattice = lattices_.emplace_back();
      for (int i = 0; i < (columns << o) * (rows << o); ++i) lattice.push_back(static_cast<float>(rng.uniform()));
    }
  }
  [[nodiscard]] float operator()(float u, float v) const {
    float sum = 0, weight = 1, total = 0;
    for (std::size_t o = 0; o < lattices_.size(); ++o, weight /= 2) {
      const int columns = columns_ << o, rows = rows_ << o;
      const float x = (u - std::floor(u)) * static_cast<float>(columns),
                  y = (v - std::floor(v)) * static_cast<float>(rows);
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const auto at = [&](int column, int row) {
        return lattices_[o][static_cast<std::size_t>(row % rows) * static_cast<std::size_t>(columns) +
                            static_cast<std::size_t>(column % columns)];
      };
      const float s = smooth(x - static_cast<float>(i)), t = smooth(y - static_cast<float>(j));
      sum += weight * std::lerp(std::lerp(at(i, j), at(i + 1, j), s), std::lerp(at(i, j + 1), at(i + 1, j + 1), s), t);
      total += weight;
    }
    return sum / total;
  }
  /// 0 at 0, 1 at 1, level at both.
  static float smooth(float t) { return t * t * (3 - 2 * t); }

 private:
  int columns_, rows_;
  std::vector<std::vector<float>> lattices_;
};

/// Paint on plaster.
inline Texture plaster(const Colour& colour, Rng rng) {
  const FractalNoise coarse(3, 3, 3, rng.fork(0)), fine(64, 64, 2, rng.fork(1));
  return paint([&](float u, float v) -> Colour {
    return colour * (0.94F + 0.06F * coarse(u, v) + 0.05F * (fine(u, v) - 0.5F));
  });
}

/// Grain along u.
inline Texture wood(const Colour& colour, Rng rng) {
  const FractalNoise bend(2, 2, 2, rng.fork(0)), grain(2, 32, 3, rng.fork(1)), pores(8, 64, 2, rng.fork(2));
  return paint([&](float u, float v) -> Colour {
    const float rings = 0.5F + 0.5F * std::sin(2 * std::numbers::pi_v<float> * (9 * v + 1.2F * bend(u, v)));
    return colour * (0.76F + 0.07F * rings + 0.22F * grain(u, v) + 0.1F * (pores(u, v) - 0.5F));
  });
}

/// Boards along u: `boards` rows of them, each with its own tint, cut at its own place.
inline Texture planks(const Colour& colour, int boards, Rng rng) {
  const FractalNoise grain(3, 64, 2, rng.fork(0)), wide(2, 8, 2, rng.fork(1));
  std::vector<std::array<float, 3>> board;  // cut, tint of either half
  board.reserve(static_cast<std::size_t>(boards));
  Rng draw = rng.fork(2);
  for (int i = 0; i < boards; ++i)
    board.push_back({static_cast<float>(draw.uniform()), static_cast<float>(draw.uniform(0.8, 1.05)),
                     static_cast<float>(draw.uniform(0.8, 1.05))});
  return paint([&](float u, float v) -> Colour {
    const float y = v * static_cast<float>(boards);
    const auto i = std::min(static_cast<std::size_t>(y), board.size() - 1);
    const float along = u - board[i][0] - std::floor(u - board[i][0]), across = y - static_cast<float>(i);
    const bool first = along < 0.5F;
    const float joint =
        std::min({across * 0.5F, (1 - across) * 0.5F,
                  std::min({along, std::abs(along - 0.5F), 1 - along}) * static_cast<float>(boards) * 0.5F});
    const float shift = 0.37F * static_cast<float>(i) + (first ? 0.F : 0.21F);  // no two boards of the same grain
    const float tint = board[i][first ? 1 : 2] * (0.75F + 0.25F * grain(u + shift, v) + 0.15F * wide(u + shift, v));
    return colour * tint * (joint < 0.018F ? 0.55F : 1.F);
  });
}

/// n x n square tiles in two colours, with joints; n even.
inline Texture tiles(const Colour& a, const Colour& b, int n, Rng rng) {
  const FractalNoise marble(4, 4, 5, rng.fork(0));
  const Colour joint = Colour::Constant(0.55F);
  return paint([&](float u, float v) -> Colour {
    const float x = u * static_cast<float>(n), y = v * static_cast<float>(n), fx = x - std::floor(x),
                fy = y - std::floor(y);
    if (std::min({fx, 1 - fx, fy, 1 - fy}) < 0.025F) return Colour(joint);
    const Colour& c = (static_cast<int>(x) + static_cast<int>(y)) % 2 == 0 ? a : b;
    return c * (0.88F + 0.2F * marble(u, v));
  });
}

/// Eight courses of four bricks.
inline Texture bricks(const Colour& colour, Rng rng) {
  constexpr int courses = 8, a_course = 4;
  const FractalNoise rough(32, 32, 3, rng.fork(0));
  std::array<float, static_cast<std::size_t>(courses * a_course)> tint;
  Rng draw = rng.fork(1);
  for (float& t : tint) t = static_cast<float>(draw.uniform(0.75, 1.1));
  const Colour mortar(0.72F, 0.70F, 0.66F);
  return paint([&](float u, float v) -> Colour {
    const float y = v * courses, x = u * a_course + (static_cast<int>(y) % 2 == 0 ? 0.F : 0.5F);
    const float fx = x - std::floor(x), fy = y - std::floor(y), noise = rough(u, v);
    const float edge = std::min(std::min(fx, 1 - fx) * 2.5F, std::min(fy, 1 - fy)) + 0.06F * (noise - 0.5F);
    if (edge < 0.08F) return mortar * (0.9F + 0.2F * noise);
    return colour *
           tint[static_cast<std::size_t>(y) * static_cast<std::size_t>(a_course) +
                static_cast<std::size_t>(x) % static_cast<std::size_t>(a_course)] *
           (0.8F + 0.35F * noise);
  });
}

/// A weave.
inline Texture fabric(const Colour& colour, Rng rng) {
  const FractalNoise fold(4, 4, 3, rng.fork(0)), thread(64, 64, 1, rng.fork(1));
  return paint([&](float u, float v) -> Colour {
    constexpr float threads = 40 * 2 * std::numbers::pi_v<float>;
    const float weave = std::sin(threads * u) * std::sin(threads * v);
    return colour * (0.8F + 0.08F * weave + 0.2F * fold(u, v) + 0.12F * (thread(u, v) - 0.5F));
  });
}

/// Two directions of stripes that darken each other.
inline Texture plaid(const Colour& colour, const Colour& stripe, Rng rng) {
  const FractalNoise thread(64, 64, 1, rng);
  return paint([&](float u, float v) -> Colour {
    const auto on = [](float t) { return (static_cast<int>(t * 12) % 3 == 0) ? 0.5F : 0.F; };
    const float share = on(u) + on(v);
    return (colour + share * (stripe - colour)) * (0.9F + 0.2F * thread(u, v));
  });
}

/// A carpet with borders and diamonds; made to lie once on its rectangle.
inline Texture rug(const Colour& ground, const Colour& pattern, Rng rng) {
  const FractalNoise pile(64, 64, 2, rng);
  const Colour light = 0.5F * (Colour::Ones() + pattern);
  return paint([&](float u, float v) -> Colour {
    const float edge = std::min({u, 1 - u, v, 1 - v});
    const float x = 6 * u - std::floor(6 * u) - 0.5F, y = 6 * v - std::floor(6 * v) - 0.5F,
                diamond = std::abs(x) + std::abs(y);
    Colour c = diamond < 0.16F ? light : diamond < 0.34F ? pattern : ground;
    if (edge < 0.12F) c = edge < 0.03F || (edge > 0.06F && edge < 0.09F) ? pattern : edge < 0.06F ? ground : light;
    return c * (0.8F + 0.35F * pile(u, v));
  });
}

/// Spines of books in a row; repeats along u.
inline Texture books(Rng rng) {
  struct Book {
    float end, height, band;
    Colour colour;
  };
  std::vector<Book> row;
  Rng draw = rng.fork(0);
  const auto number = [&](double low, double high) { return static_cast<float>(draw.uniform(low, high)); };
  for (float x = 0; x < 1;) {
    x += number(0.025, 0.07);
    const Colour warm(number(0.25, 0.8), number(0.15, 0.6), number(0.1, 0.5));
    row.push_back({x, number(0.72, 0.97), number(0.15, 0.6), draw.uniform() < 0.5 ? warm : Colour(warm.reverse())});
  }
  return paint([&](float u, float v) -> Colour {
    std::size_t i = 0;
    while (i + 1 < row.size() && row[i].end < u) ++i;
    const float begin = i == 0 ? 0 : row[i - 1].end, end = std::min(1.F, row[i].end),
                across = (u - begin) / (end - begin);
    if (v > row[i].height) return Colour::Constant(0.08F);
    const float round = 0.6F + 0.4F * std::sin(std::numbers::pi_v<float> * std::clamp(across, 0.F, 1.F));
    const bool title = std::abs(v - row[i].band) < 0.06F;
    return (title ? Colour(0.9F, 0.8F, 0.5F) : row[i].colour) * round;
  });
}

/// Sky and hills: what a window shows. Does not repeat.
inline Texture outlook(Rng rng) {
  const FractalNoise clouds(3, 4, 5, rng.fork(0)), ridge(4, 1, 4, rng.fork(1)), trees(32, 32, 3, rng.fork(2));
  return paint([&](float u, float v) -> Colour {
    const float far = 0.34F + 0.22F * ridge(u, 0.3F), near = 0.12F + 0.25F * ridge(u + 0.4F, 0.7F);
    if (v < near) return Colour(0.22F, 0.42F, 0.16F) * (0.6F + 0.8F * trees(u, v));
    if (v < far) return Colour(0.36F, 0.50F, 0.46F) * (0.85F + 0.25F * trees(u, v));
    const float white = std::clamp(3 * (clouds(u, v) - 0.48F), 0.F, 1.F);
    return std::lerp(0.F, 1.F, white) * (Colour::Ones() - Colour(0.35F, 0.58F, 0.9F)) + Colour(0.35F, 0.58F, 0.9F) +
           Colour::Constant(0.25F * (1 - v));
  });
}

/// An abstract painting: soft fields of colour and a few discs. Does not repeat.
inline Texture painting(Rng rng) {
  const FractalNoise stroke(6, 24, 3, rng.fork(0)), field(2, 2, 3, rng.fork(1));
  Rng draw = rng.fork(2);
  const auto number = [&](double low, double high) { return static_cast<float>(draw.uniform(low, high)); };
  const auto colour = [&] { return Colour(number(0.1, 1), number(0.1, 0.9), number(0.05, 0.8)); };
  struct Disc {
    float u, v, radius;
    Colour colour;
  };
  std::array<Colour, 3> fields = {colour(), colour(), colour()};
  std::array<Disc, 6> discs;
  for (Disc& d : discs) d = {number(0.1, 0.9), number(0.1, 0.9), number(0.05, 0.22), colour()};
  return paint([&](float u, float v) -> Colour {
    const float t = 2 * field(u, v);
    Colour c =
        t < 1 ? Colour(fields[0] + t * (fields[1] - fields[0])) : Colour(fields[1] + (t - 1) * (fields[2] - fields[1]));
    for (const Disc& d : discs)
      if (std::hypot(u - d.u, v - d.v) < d.radius) c = 0.25F * c + 0.75F * d.colour;
    return c * (0.75F + 0.4F * stroke(u, v));
  });
}

/// Leaves, or any mottled surface.
inline Texture mottled(const Colour& dark, const Colour& light, int cells, Rng rng) {
  const FractalNoise noise(cells, cells, 3, rng);
  return paint([&](float u, float v) -> Colour {
    const float t = std::clamp(2.4F * (noise(u, v) - 0.3F), 0.F, 1.F);
    return dark + t * (light - dark);
  });
}

}  // namespace vantage::procedural
