// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <vector>

#include <vantage/geometry/box.hpp>
#include <vantage/sampler/pattern.hpp>

namespace field {

using namespace vantage;

/// The protocols of chapter 3: n x n views over an area, leg by leg, to and fro. Where vantage::Lawnmower takes as many
/// views as cover the area, this takes just these, whatever the area's proportions: along the shorter side they overlap
/// more.
class Survey : public Pattern {
 public:
  /// Footprints as wide as `footprint_m` end at the area's edges.
  Survey(const Box2& area, int n, double height_m, double footprint_m)
      : Pattern(legs(area, n, height_m, footprint_m), 1e-6) {}

 private:
  static std::vector<View> legs(const Box2& area, int n, double height_m, double footprint_m) {
    const auto at = [&](int axis, int i) {
      const double inset = 0.5 * std::min(footprint_m, area.sizes()[axis]);
      return area.min()[axis] + inset + (area.sizes()[axis] - 2 * inset) * i / (n - 1);
    };
    std::vector<View> views;
    for (int leg = 0; leg < n; ++leg)
      for (int i = 0; i < n; ++i) views.push_back(nadir(at(0, leg % 2 == 0 ? i : n - 1 - i), at(1, leg), height_m));
    return views;
  }
};

}  // namespace field
