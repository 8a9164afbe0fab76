// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// A fixed set of views, those of a recording for instance, less those visited already (the same pose to 1e-9 in every
/// coefficient): the data-set experiments of chapter 4.
class Pool {
 public:
  /// Throws Error if a view is no rigid, finite pose.
  explicit Pool(std::vector<View> views) : views_(std::move(views)) {
    for (std::size_t i = 0; i < views_.size(); ++i) check_view(views_[i], concat("Pool (view ", i, ")"));
  }
  template <Map M>
  Candidates sample(const M&, const Situation& q, const Score&, Rng&) const {
    Candidates c;
    for (const View& v : views_)
      if (std::none_of(q.visited.begin(), q.visited.end(), [&](const View& p) { return same_pose(p, v); }))
        c.views.push_back(v);
    return c;
  }
  [[nodiscard]] const std::vector<View>& views() const { return views_; }

 private:
  static bool same_pose(const View& a, const View& b) {
    return (a.T_W_C.matrix() - b.T_W_C.matrix()).cwiseAbs().maxCoeff() <= 1e-9;
  }
  std::vector<View> views_;
};

}  // namespace vantage
