// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace vantage {

/// A column-major matrix in memory of its own that asks for huge pages (touching fresh memory page by page costs more
/// than the arithmetic of a rank update) and gives the tail back when it shrinks. Zero at first. Moves in O(1).
template <class T>
class LargeMatrix {
 public:
  using Index = Eigen::Index;
  using Dense = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

  LargeMatrix() = default;
  LargeMatrix(Index rows, Index cols) : rows_(rows), cols_(cols) { allocate(); }
  LargeMatrix(const LargeMatrix& other) : LargeMatrix(other.rows_, other.cols_) {
    if (bytes() != 0) std::memcpy(data_, other.data_, bytes());
  }
  LargeMatrix(LargeMatrix&& other) noexcept { swap(other); }
  LargeMatrix& operator=(LargeMatrix other) noexcept {
    swap(other);
    return *this;
  }
  ~LargeMatrix() { release(); }

  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index cols() const { return cols_; }
  [[nodiscard]] T* col(Index j) { return data_ + j * rows_; }
  [[nodiscard]] const T* col(Index j) const { return data_ + j * rows_; }
  [[nodiscard]] T& operator()(Index i, Index j) { return data_[j * rows_ + i]; }
  [[nodiscard]] const T& operator()(Index i, Index j) const { return data_[j * rows_ + i]; }
  [[nodiscard]] Eigen::Map<Dense> map() { return {data_, rows_, cols_}; }
  [[nodiscard]] Eigen::Map<const Dense> map() const { return {data_, rows_, cols_}; }
  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_) * sizeof(T);
  }

  /// From now on the first rows x cols values, as they stand in memory; the rest goes back to the system.
  void shrink(Index rows, Index cols) {
    rows_ = rows;
    cols_ = cols;
#ifdef __linux__
    const std::size_t keep = round_up(bytes(), small_page);
    if (keep < mapped_) {
      munmap(reinterpret_cast<std::byte*>(data_) + keep, mapped_ - keep);
      mapped_ = keep;
    }
    if (keep == 0) data_ = nullptr;
#endif
  }

 private:
  static constexpr std::size_t small_page = std::size_t{1} << 12, huge_page = std::size_t{1} << 21;
  static constexpr std::size_t round_up(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

  void swap(LargeMatrix& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(rows_, other.rows_);
    std::swap(cols_, other.cols_);
    std::swap(mapped_, other.mapped_);
  }
#ifdef __linux__
  void allocate() {
    if (bytes() == 0) return;
    mapped_ = round_up(bytes(), small_page);
    const bool huge = mapped_ >= huge_page;
    const std::size_t asked = mapped_ + (huge ? huge_page : 0);
    void* got = mmap(nullptr, asked, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (got == MAP_FAILED) throw std::bad_alloc();
    auto* begin = static_cast<std::byte*>(got);
    if (huge) {  // trimmed to begin on a huge page
      const auto address = reinterpret_cast<std::size_t>(begin);
      const std::size_t skip = round_up(address, huge_page) - address;
      if (skip != 0) munmap(begin, skip);
      if (skip != huge_page) munmap(begin + skip + mapped_, huge_page - skip);
      begin += skip;
      madvise(begin, mapped_, MADV_HUGEPAGE);
    }
    data_ = reinterpret_cast<T*>(begin);
  }
  void release() {
    if (data_ != nullptr) munmap(data_, mapped_);
  }
#else
  void allocate() {
    if (bytes() == 0) return;
    data_ = static_cast<T*>(std::calloc(bytes(), 1));
    if (data_ == nullptr) throw std::bad_alloc();
  }
  void release() { std::free(data_); }
#endif

  T* data_ = nullptr;
  Index rows_ = 0, cols_ = 0;
  std::size_t mapped_ = 0;
};

}  // namespace vantage
