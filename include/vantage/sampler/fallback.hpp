// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {

struct FallbackConfig {
  double least = -std::numeric_limits<double>::infinity();  ///< utility; not NaN
};

/// What one sampler proposes and, when that is nothing, or nothing of a utility of `least`, what another one does:
/// `Fallback{Frontier{}, AllAround{}}` explores, and then looks at what is known from other sides. Costs what it asks:
/// with a `least` the first sampler's views are scored, once.
template <class First, class Then>
class Fallback {
 public:
  using MapNeeds = NeedsOf<First, Then>;
  using Config = FallbackConfig;
  Fallback(First first, Then then) : Fallback(std::move(first), std::move(then), Config{}) {}
  /// Throws Error if `least` is NaN.
  Fallback(First first, Then then, const Config& config)
      : first_(std::move(first)), then_(std::move(then)), config_(config) {
    Check check("Fallback::Config");
    check(!std::isnan(config.least), "least", config.least, "a number, or infinite");
    check.done();
  }

  template <Map M>
  requires SamplerFor<First, M> && SamplerFor<Then, M> Candidates sample(const M& map, const Situation& q,
                                                                         const Score& score, Rng& rng) {
    Candidates c = first_.sample(map, q, score, rng);
    if (config_.least > -std::numeric_limits<double>::infinity() && c.utilities.empty()) {
      c.utilities.resize(c.views.size());
      score(c.views, c.utilities);
    }
    const auto too_little = [&](double psi) { return psi < config_.least; };
    const bool nothing = c.views.empty() || (!c.utilities.empty() && std::ranges::all_of(c.utilities, too_little));
    return nothing ? then_.sample(map, q, score, rng) : c;
  }
  void save(Sink& sink) const requires(Persistent<First> || Persistent<Then>) {
    if constexpr (Persistent<First>) first_.save(sink);
    if constexpr (Persistent<Then>) then_.save(sink);
  }
  void load(Source& source) requires(Persistent<First> || Persistent<Then>) {
    if constexpr (Persistent<First>) first_.load(source);
    if constexpr (Persistent<Then>) then_.load(source);
  }

 private:
  First first_;
  Then then_;
  Config config_;
};

}  // namespace vantage
