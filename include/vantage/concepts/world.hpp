// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// Simulator, replay or robot. `observe` gives a measurement, or none: not reached, or the recording has ended.
template <class W, class M>
concept WorldFor = Map<M> && requires(W w, const View& v) {
  { w.observe(v) } -> std::convertible_to<std::optional<typename M::Measurement>>;
};

/// A measurement that knows where it was really taken is believed.
template <class Z>
concept Posed = requires(const Z z) {
  { z.view } -> std::convertible_to<View>;
};

/// Mission time. `begin` opens a stretch of computing that `mapped` or `planned` closes; travel is told. A measured
/// clock reads the machine's; a modelled one adds stated costs, so that a run repeats bit for bit.
template <class C>
concept ClockLike = requires(C c, const C k, double s) {
  { k.elapsed_s() } -> std::convertible_to<double>;
  c.begin();
  c.mapped();
  c.planned();
  c.travelled(s);
};

/// When to stop: asked before planning, and again after it with the best utility known.
template <class S, class M>
concept StopRuleFor = Map<M> && requires(const S s, const M& m, const Situation& q) {
  { s(m, q) } -> std::convertible_to<bool>;
};

}  // namespace vantage
