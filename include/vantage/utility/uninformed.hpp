// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>

#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>

namespace vantage {

/// A random utility, uniform in [0, 1): the baselines "Random" and "Uniform" of chapters 4 and 5. Needs no map. Within
/// a step the same view always gets the same number, in whatever batch or order it is asked for.
struct Uninformed {
  template <Map M>
  auto prepare(const M&, const Situation&, Rng rng) const {
    return [rng](Views, Views views, std::span<double> out) {
      for (std::size_t i = 0; i < views.size(); ++i) out[i] = rng.fork(name(views[i])).uniform();
    };
  }

 private:
  // The pose's own bytes name its stream.
  static std::uint64_t name(const View& view) {
    return fnv1a(std::as_bytes(std::span<const double>(view.T_W_C.data(), 16)));
  }
};

}  // namespace vantage
