// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <vantage/geometry/view.hpp>

namespace vantage {

/// What the views show that sequences begin with: each is given again with every longer sequence, but asked for once.
/// Const members run concurrently.
template <class Shown>
class OncePerView {
 public:
  using Pointer = std::shared_ptr<const Shown>;

  /// Of each of `views`, show(view) if it was not asked for before.
  template <class F>
  [[nodiscard]] std::vector<Pointer> operator()(Views views, F&& show) const {
    std::vector<Pointer> all;
    for (const View& view : views) {
      Pointer shown = find(view);
      if (!shown) {
        shown = std::make_shared<const Shown>(show(view));
        const std::lock_guard lock(mutex_);
        shown_.emplace_back(view, shown);
      }
      all.push_back(std::move(shown));
    }
    return all;
  }

 private:
  [[nodiscard]] Pointer find(const View& view) const {
    const std::lock_guard lock(mutex_);
    for (const auto& [v, shown] : shown_)
      if (v.T_W_C.matrix() == view.T_W_C.matrix()) return shown;
    return nullptr;
  }
  mutable std::mutex mutex_;
  mutable std::deque<std::pair<View, Pointer>> shown_;
};

}  // namespace vantage
