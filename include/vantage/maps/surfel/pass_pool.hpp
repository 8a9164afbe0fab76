// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace vantage {

/// Passes of a rasteriser that are lent one at a time, so that const members may run concurrently and still find the
/// memory of an earlier call. A thread that waits inside of a loan may run another task, so there is none a thread. A
/// copy starts empty: what is kept is memory, not meaning.
template <class Pass>
class PassPool {
 public:
  PassPool() = default;
  PassPool(const PassPool&) {}
  PassPool& operator=(const PassPool&) { return *this; }
  PassPool(PassPool&& other) noexcept : lent_most_(other.lent_most_), free_(std::move(other.free_)) {}
  PassPool& operator=(PassPool&& other) noexcept {
    lent_most_ = other.lent_most_;
    free_ = std::move(other.free_);
    return *this;
  }

  /// f(pass); returns what it does.
  template <class F>
  decltype(auto) lend(F&& f) {
    Loan loan{*this, take()};
    return f(*loan.pass);
  }

 private:
  struct Loan {
    PassPool& pool;
    std::unique_ptr<Pass> pass;
    Loan(PassPool& from, std::unique_ptr<Pass> p) : pool(from), pass(std::move(p)) {}
    Loan(const Loan&) = delete;
    ~Loan() {
      const std::lock_guard lock(pool.mutex_);
      pool.free_.push_back(std::move(pass));  // there is room: take() made it
    }
  };
  std::unique_ptr<Pass> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<Pass> pass = std::move(free_.back());
        free_.pop_back();
        return pass;
      }
      free_.reserve(++lent_most_);
    }
    return std::make_unique<Pass>();
  }
  std::mutex mutex_;
  std::size_t lent_most_ = 0;  // at once
  std::vector<std::unique_ptr<Pass>> free_;
};

}  // namespace vantage
