// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// Knows which sides of things were seen: what a measurement from `view` would show that none has shown, no farther
/// than `far_m` (camera z [m]), as names in ascending order, each once. The same side has the same name in every view.
template <class M>
concept SideMap = Map<M> && requires(const M m, const View& view, const Camera& camera, double far_m) {
  { m.unseen_sides(view, camera, far_m) } -> std::same_as<std::vector<std::uint64_t>>;
};

namespace need {
struct Sides;
}
template <class M>
inline constexpr bool offers<M, need::Sides> = SideMap<M>;

}  // namespace vantage
