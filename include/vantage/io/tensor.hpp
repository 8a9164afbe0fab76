// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>

namespace vantage {

/// What the numbers of a tensor are.
enum class ElementType : std::uint8_t { Bool, I8, I16, I32, I64, U8, U16, U32, U64, F16, BF16, F32, F64 };

/// Name in safetensors, code in numpy's npy (empty: numpy has no such type), bytes.
struct ElementTypeInfo {
  std::string_view name, npy;
  std::size_t bytes;
};
constexpr std::array<ElementTypeInfo, 13> element_types = {{{"BOOL", "b1", 1},
                                                            {"I8", "i1", 1},
                                                            {"I16", "i2", 2},
                                                            {"I32", "i4", 4},
                                                            {"I64", "i8", 8},
                                                            {"U8", "u1", 1},
                                                            {"U16", "u2", 2},
                                                            {"U32", "u4", 4},
                                                            {"U64", "u8", 8},
                                                            {"F16", "f2", 2},
                                                            {"BF16", "", 2},
                                                            {"F32", "f4", 4},
                                                            {"F64", "f8", 8}}};
constexpr const ElementTypeInfo& info(ElementType type) { return element_types[static_cast<std::size_t>(type)]; }

/// What a file of tensors may cost; whatever is larger is refused before it is allocated.
struct TensorLimits {
  std::size_t bytes = std::size_t{2} << 30;  ///< of the file, and again of all that is unpacked from it
  std::size_t axes = 32;
  std::size_t tensors = std::size_t{1} << 16;
};

/// Numbers on a grid of any number of axes, as files exchange them: C order (the last axis runs fastest),
/// little-endian.
struct Tensor {
  ElementType type = ElementType::F64;
  std::vector<std::size_t> shape;  ///< empty: one number
  std::vector<std::byte> bytes;    ///< product of the shape, times the bytes of an element

  /// How many numbers.
  [[nodiscard]] std::size_t size() const { return bytes.size() / info(type).bytes; }

  /// Throws Error unless there are as many values as the shape has room for.
  template <class T>
  static Tensor of(const std::vector<T>& values, std::vector<std::size_t> shape) {
    std::size_t n = 1;
    for (const std::size_t s : shape) n *= s;
    if (n != values.size())
      throw Error("Tensor::of", concat(values.size(), " values for a shape of ", n), "the product of the shape");
    return pack(values.data(), n, std::move(shape));
  }
  template <class T>
  static Tensor of(const Image<T>& image) {
    return pack(image.data(), static_cast<std::size_t>(image.size()),
                {static_cast<std::size_t>(image.rows()), static_cast<std::size_t>(image.cols())});
  }

  /// The numbers as T, in C order. Throws Error, naming `where`, if an integer type cannot hold one of them; floating
  /// types round.
  template <class T>
  [[nodiscard]] std::vector<T> values(std::string_view where) const {
    std::vector<T> out(size());
    visit([&](auto sample) {
      using S = decltype(sample);
      for (std::size_t i = 0; i < out.size(); ++i) {
        S value;
        std::memcpy(&value, bytes.data() + i * sizeof(S), sizeof(S));
        out[i] = convert<T>(value, where, i);
      }
    });
    return out;
  }
  /// The numbers of two axes. Throws Error if there are more or fewer.
  template <class T>
  [[nodiscard]] Image<T> image(std::string_view where) const {
    if (shape.size() != 2) throw Error(where, concat(shape.size(), " axes"), "two");
    const std::vector<T> v = values<T>(where);
    return Eigen::Map<const Image<T>>(v.data(), static_cast<Eigen::Index>(shape[0]),
                                      static_cast<Eigen::Index>(shape[1]));
  }

 private:
  template <class T>
  static Tensor pack(const T* values, std::size_t n, std::vector<std::size_t> shape) {
    Tensor t{type_of<T>(), std::move(shape), std::vector<std::byte>(n * sizeof(T))};
    if (n != 0) std::memcpy(t.bytes.data(), values, n * sizeof(T));
    return t;
  }
  template <class T>
  static constexpr ElementType type_of() {
    if constexpr (std::is_same_v<T, bool>) return ElementType::Bool;
    if constexpr (std::is_same_v<T, float>) return ElementType::F32;
    if constexpr (std::is_same_v<T, double>) return ElementType::F64;
    static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8, "a tensor holds numbers");
    constexpr int log2 = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return static_cast<ElementType>(static_cast<int>(std::is_signed_v<T> ? ElementType::I8 : ElementType::U8) + log2);
  }
  template <class F>
  void visit(F&& f) const {
    switch (type) {
      case ElementType::Bool:
      case ElementType::U8:
        return f(std::uint8_t{});
      case ElementType::I8:
        return f(std::int8_t{});
      case ElementType::I16:
        return f(std::int16_t{});
      case ElementType::I32:
        return f(std::int32_t{});
      case ElementType::I64:
        return f(std::int64_t{});
      case ElementType::U16:
        return f(std::uint16_t{});
      case ElementType::U32:
        return f(std::uint32_t{});
      case ElementType::U64:
        return f(std::uint64_t{});
      case ElementType::F16:
        return f(Eigen::half{});
      case ElementType::BF16:
        return f(Eigen::bfloat16{});
      case ElementType::F32:
        return f(float{});
      case ElementType::F64:
        return f(double{});
    }
  }
  template <class T, class S>
  static T convert(S value, std::string_view where, std::size_t index) {
    if constexpr (std::is_floating_point_v<T>) {
      return static_cast<T>(value);
    } else if constexpr (std::is_integral_v<S>) {
      if (!std::in_range<T>(value)) refuse(concat(+value), where, index);
      return static_cast<T>(value);
    } else {  // 2^digits is a double, unlike the largest value
      const double x = static_cast<double>(value), above = std::ldexp(1.0, std::numeric_limits<T>::digits);
      if (!(x >= (std::is_signed_v<T> ? -above : 0.0) && x < above && x == std::floor(x)))
        refuse(concat(x), where, index);
      return static_cast<T>(x);
    }
  }
  [[noreturn]] static void refuse(const std::string& value, std::string_view where, std::size_t index) {
    throw Error(where, concat("value ", index, " is ", value), "one that the integer type holds");
  }
};

/// Tensors by name.
using Tensors = std::map<std::string, Tensor>;

namespace detail {

/// Product of the shape and the bytes of an element. Throws Error if it is above `most`.
inline std::size_t tensor_bytes(const std::vector<std::size_t>& shape, ElementType type, std::size_t most,
                                std::string_view where) {
  std::size_t bytes = info(type).bytes;
  bool empty = false;
  for (const std::size_t n : shape) empty = empty || n == 0;
  if (empty) return 0;
  for (const std::size_t n : shape) {
    if (n > most / bytes)
      throw Error(where, "a shape of more values than there are bytes", concat("at most ", most, " bytes"));
    bytes *= n;
  }
  if (bytes > most) throw Error(where, concat(bytes, " bytes of values"), concat("at most ", most));
  return bytes;
}

}  // namespace detail

}  // namespace vantage
