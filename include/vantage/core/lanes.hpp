// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>
#endif

namespace vantage {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline constexpr std::size_t native_vector_bytes = 64;
#elif defined(__AVX2__)
inline constexpr std::size_t native_vector_bytes = 32;
#else
inline constexpr std::size_t native_vector_bytes = 16;
#endif

/// Sixteen numbers that are computed with as one: the compilers' vector types, as wide as the machine's, behind the
/// notation of a scalar. A formula templated on its number type runs with double, float and Lanes<float>.
template <class T>
struct Lanes {
  static_assert(sizeof(T) == 4);
  static constexpr std::size_t size = 16, parts = size * sizeof(T) / native_vector_bytes;
  using Native [[gnu::vector_size(native_vector_bytes)]] = T;

  Native part[parts];  // std::array would drop the attribute

  Lanes() = default;
  Lanes(T x) {                                // NOLINT(google-explicit-constructor): a number is sixteen of it
    for (Native& p : part) p = x - Native{};  // 0 + x would be an addition: -0
  }
  static Lanes load(const T* from) {
    Lanes l;
    std::memcpy(&l.part, from, sizeof(l.part));
    return l;
  }
  /// f(lane) in every lane.
  template <class F>
  static Lanes generate(F&& f) {
    alignas(64) std::array<T, size> values;
    for (std::size_t i = 0; i < size; ++i) values[i] = f(i);
    return load(values.data());
  }
  /// The sixteen numbers in memory.
  [[nodiscard]] T* data() { return reinterpret_cast<T*>(part); }
  void store(T* to) const { std::memcpy(to, &part, sizeof(part)); }
  [[nodiscard]] std::array<T, size> values() const { return std::bit_cast<std::array<T, size>>(*this); }

  template <class F>
  static Lanes each(F&& f) {
    Lanes l;
    for (std::size_t p = 0; p < parts; ++p) l.part[p] = f(p);
    return l;
  }
  friend Lanes operator-(const Lanes& a) {
    return each([&](std::size_t p) { return -a.part[p]; });
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return each([&](std::size_t p) { return a.part[p] + b.part[p]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return each([&](std::size_t p) { return a.part[p] - b.part[p]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return each([&](std::size_t p) { return a.part[p] * b.part[p]; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return each([&](std::size_t p) { return a.part[p] / b.part[p]; });
  }
  friend Lanes operator&(const Lanes& a, const Lanes& b) requires std::integral<T> {
    return each([&](std::size_t p) { return a.part[p] & b.part[p]; });
  }
  friend Lanes operator<<(const Lanes& a, int bits) requires std::integral<T> {
    return each([&](std::size_t p) { return a.part[p] << bits; });
  }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
};

/// All bits of a lane set where something holds, none where not.
using LaneMask = Lanes<std::int32_t>;

template <class T>
LaneMask operator<(const Lanes<T>& a, const Lanes<T>& b) {
  return LaneMask::each([&](std::size_t p) { return a.part[p] < b.part[p]; });
}
template <class T>
LaneMask operator==(const Lanes<T>& a, const Lanes<T>& b) {
  return LaneMask::each([&](std::size_t p) { return a.part[p] == b.part[p]; });
}
template <class T>
LaneMask operator>=(const Lanes<T>& a, const Lanes<T>& b) {
  return LaneMask::each([&](std::size_t p) { return a.part[p] >= b.part[p]; });
}
template <class T>
LaneMask operator>(const Lanes<T>& a, const Lanes<T>& b) {
  return b < a;
}
template <class T>
LaneMask operator<=(const Lanes<T>& a, const Lanes<T>& b) {
  return b >= a;
}

/// a where the mask is set, else b.
template <class T>
Lanes<T> select(const LaneMask& mask, const Lanes<T>& a, const Lanes<T>& b) {
  return Lanes<T>::each([&](std::size_t p) { return mask.part[p] ? a.part[p] : b.part[p]; });
}
template <std::floating_point T>
T select(bool mask, T a, T b) {
  return mask ? a : b;
}

/// Bit i: lane i is set.
inline std::uint32_t bits(const LaneMask& mask) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return _mm512_movepi32_mask(std::bit_cast<__m512i>(mask));
#else
  const auto lanes = mask.values();
  std::uint32_t all = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) all |= (lanes[i] < 0 ? 1U : 0U) << i;
  return all;
#endif
}
/// Whether any lane is set.
inline bool any(const LaneMask& mask) { return bits(mask) != 0; }

/// Where all hold: for masks of lanes, and for single numbers.
template <class M, class... Ms>
M all_hold(const M& first, const Ms&... rest) {
  if constexpr (std::same_as<M, bool>)
    return (first && ... && rest);
  else
    return (first & ... & rest);
}

/// b where a is not a number.
template <class T>
Lanes<T> min(const Lanes<T>& a, const Lanes<T>& b) {
  return select(a < b, a, b);
}
template <class T>
Lanes<T> max(const Lanes<T>& a, const Lanes<T>& b) {
  return select(a > b, a, b);
}
inline Lanes<float> log2(const Lanes<float>& a) {
  return Lanes<float>::generate([v = a.values()](std::size_t i) { return std::log2(v[i]); });
}
inline Lanes<float> abs(const Lanes<float>& a) { return max(a, -a); }
inline Lanes<float> sqrt(const Lanes<float>& a) {
  return Lanes<float>::generate([v = a.values()](std::size_t i) { return std::sqrt(v[i]); });
}

/// The same bits, taken as another type.
template <class To, class From>
Lanes<To> cast_bits(const Lanes<From>& a) {
  return std::bit_cast<Lanes<To>>(a);
}

/// Lane j of the result: the sum of the lanes of in[j], by a tree of additions.
class LaneSums {
 public:
  static Lanes<float> of(const std::array<Lanes<float>, 16>& in) {
    std::array<Native, 16> v;
    for (std::size_t j = 0; j < 16; ++j) {
      v[j].values = in[j].part[0];
      for (std::size_t p = 1; p < Lanes<float>::parts; ++p) v[j].values += in[j].part[p];
    }
    fold<1>(v.data());
    Lanes<float> out;
    for (std::size_t p = 0; p < Lanes<float>::parts; ++p) out.part[p] = v[p].values;
    return out;
  }

 private:
  static constexpr std::size_t width = Lanes<float>::size / Lanes<float>::parts;
  struct Native {
    Lanes<float>::Native values;
  };

  // From pairs of vectors, whose lanes hold sums of `step` lanes for `step` inputs, half as many with twice of both.
  template <std::size_t step>
  static void fold(Native* v) {
    if constexpr (step < width) {
      for (std::size_t j = 0; j < 16 / step / 2; ++j)
        v[j] = pair<step>(v[2 * j], v[2 * j + 1], std::make_index_sequence<width>());
      fold<2 * step>(v);
    }
  }
  template <std::size_t step, std::size_t... i>
  static Native pair(const Native& a, const Native& b, std::index_sequence<i...>) {
    return {__builtin_shufflevector(a.values, b.values, from<step>(i)...) +
            __builtin_shufflevector(a.values, b.values, (from<step>(i) + static_cast<int>(step))...)};
  }
  template <std::size_t step>
  static constexpr int from(std::size_t i) {
    return static_cast<int>(i / (2 * step) * (2 * step) + i % step + (i / step % 2) * width);
  }
};

/// 2^x to 2e-7 of it for x in [-126, 127]; outside, anything.
[[gnu::always_inline]] inline Lanes<float> exp2_within(const Lanes<float>& x) {
  const Lanes<float> shift = 0x1.8p23F, shifted = x + shift;  // rounds: the integer stands in the lowest bits
  const Lanes<float> f = x - (shifted - shift);               // in [-1/2, 1/2]
  Lanes<float> p = 1.327647197947878e-3F;                     // the best polynomial of degree 5, 8e-8 off
  p = p * f + 9.675541334216050e-3F;
  p = p * f + 5.550713273542586e-2F;
  p = p * f + 2.402211972384848e-1F;
  p = p * f + 6.931469670647331e-1F;
  p = p * f + 1.000000071654682F;
  return cast_bits<float>(cast_bits<std::int32_t>(p) + (cast_bits<std::int32_t>(shifted) << 23));
}
/// 2^x to 2e-7 of it, x held within [-126, 127]; NaN counts as the least.
inline Lanes<float> exp2(const Lanes<float>& x) {
  return exp2_within(min(max(x, Lanes<float>(-126.0F)), Lanes<float>(127.0F)));
}
inline Lanes<float> exp(const Lanes<float>& x) { return exp2(x * 1.44269504088896341F); }

/// The type of one number in a T.
template <class T>
struct ScalarOfLanes {
  using type = T;
};
template <class T>
struct ScalarOfLanes<Lanes<T>> {
  using type = T;
};
template <class T>
using ScalarOf = typename ScalarOfLanes<T>::type;

}  // namespace vantage
