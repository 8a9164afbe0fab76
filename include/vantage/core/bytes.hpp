// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>

// How maps and stateful policies save and load themselves: plain values, little-endian, in the order of the calls.
namespace vantage {

static_assert(std::endian::native == std::endian::little, "vantage saves little-endian bytes without swapping them");

template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Collects bytes. Not shared between threads.
class Sink {
 public:
  template <PlainValue T>
  void put(const T& value) {
    append(&value, sizeof value);
  }
  template <PlainValue T>
  void put(std::span<const T> values) {
    put(static_cast<std::uint64_t>(values.size()));
    append(values.data(), values.size_bytes());
  }
  template <PlainValue T>
  void put(const std::vector<T>& values) {
    put(std::span<const T>(values));
  }
  void put(std::string_view text) { put(std::span<const char>(text.data(), text.size())); }
  /// Rows, columns, then the coefficients in column-major order.
  template <class Derived>
  void put(const Eigen::PlainObjectBase<Derived>& m) {
    put(static_cast<std::uint64_t>(m.rows()));
    put(static_cast<std::uint64_t>(m.cols()));
    append(m.data(), static_cast<std::size_t>(m.size()) * sizeof(typename Derived::Scalar));
  }
  /// What a part saves, as a vector of bytes.
  template <class T>
  void put_saved(const T& part) {
    const std::size_t before = bytes_.size();
    put(std::uint64_t{0});
    part.save(*this);
    const std::uint64_t size = bytes_.size() - before - sizeof size;
    std::memcpy(bytes_.data() + before, &size, sizeof size);
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::vector<std::byte> take() && { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t old = bytes_.size();
    bytes_.resize(old + size);
    std::memcpy(bytes_.data() + old, data, size);
  }
  std::vector<std::byte> bytes_;
};

/// Reads what a Sink wrote. Every size is checked against the bytes that are left before anything is allocated;
/// throws Error naming `where` and the byte. Does not own the bytes.
class Source {
 public:
  explicit Source(std::span<const std::byte> bytes, std::string where = "Source")
      : bytes_(bytes), where_(std::move(where)) {}

  template <PlainValue T>
  [[nodiscard]] T get() {
    T value;
    read(&value, sizeof value);
    return value;
  }
  template <PlainValue T>
  void get(T& value) {
    value = get<T>();
  }
  template <PlainValue T>
  void get(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    read(values.data(), values.size() * sizeof(T));
  }
  void get(std::string& text) {
    text.resize(count(1));
    read(text.data(), text.size());
  }
  template <class Derived>
  void get(Eigen::PlainObjectBase<Derived>& m) {
    const auto rows = get<std::uint64_t>(), cols = get<std::uint64_t>();
    const std::uint64_t most = left() / sizeof(typename Derived::Scalar);
    if ((rows != 0 && cols > most / rows) || rows > most || cols > most)
      throw Error(where_, concat("a ", rows, " x ", cols, " matrix at byte ", at_),
                  concat("at most ", most, " values"));
    m.derived().resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
    read(m.derived().data(), static_cast<std::size_t>(m.size()) * sizeof(typename Derived::Scalar));
  }
  /// A vector of bytes in place, good as long as the source's are.
  [[nodiscard]] std::span<const std::byte> get_bytes() {
    const std::size_t size = count(1);
    at_ += size;
    return bytes_.subspan(at_ - size, size);
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] const std::string& where() const { return where_; }
  /// Throws unless everything was read.
  void done() const {
    if (left() != 0) throw Error(where_, concat(left(), " bytes left over at byte ", at_), "none");
  }

 private:
  std::size_t count(std::size_t item_size) {
    const auto n = get<std::uint64_t>();
    if (n > left() / item_size)
      throw Error(where_, concat(n, " items at byte ", at_), concat("at most ", left() / item_size));
    return static_cast<std::size_t>(n);
  }
  void read(void* to, std::size_t size) {
    if (size > left())
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat(size, " more bytes at byte ", at_));
    if (size != 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::span<const std::byte> bytes_;
  std::string where_;
  std::size_t at_ = 0;
};

/// Saves and loads itself. `load` checks everything before it changes anything, and throws Error.
template <class T>
concept Persistent = requires(T t, const T c, Sink& sink, Source& source) {
  c.save(sink);
  t.load(source);
};

/// FNV-1a, 64 bit: tells a damaged file from a whole one; no defence against a forger.
constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001B3ull;
  return hash;
}

}  // namespace vantage
