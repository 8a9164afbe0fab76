// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {

struct UtilityWeightedConfig {
  int candidates = 10;  ///< how many are kept, 1 to 1048576
};

/// Some of another sampler's views, the better ones more likely (section 2.2.2): draws one after the other, without
/// putting any back, each time view i with probability
///
///     p_i = psi_i / sum_j psi_j     over the views not drawn yet
///
/// and keeps them in the base's order, with their utilities. Probabilities are not negative: if any utility is, all are
/// first raised by the same amount until the least is 0. Views of weight 0 are drawn last, all alike. Throws Error for
/// a utility that is not finite, and for sequences of views, of which a part makes no sense. Costs the base's views,
/// their scores where the base has not paid them, and a sort.
template <class Base>
class UtilityWeighted {
 public:
  using MapNeeds = NeedsOf<Base>;
  using Config = UtilityWeightedConfig;
  UtilityWeighted() : UtilityWeighted(Base{}) {}
  explicit UtilityWeighted(Base base) : UtilityWeighted(std::move(base), Config{}) {}
  explicit UtilityWeighted(const Config& config) : UtilityWeighted(Base{}, config) {}
  /// Throws Error naming every bad member.
  UtilityWeighted(Base base, const Config& config) : base_(std::move(base)), config_(config) {
    Check check("UtilityWeighted::Config");
    check(config.candidates >= 1 && config.candidates <= 1 << 20, "candidates", config.candidates, "1 to 1048576");
    check.done();
  }

  template <Map M>
  requires SamplerFor<Base, M> Candidates sample(const M& map, const Situation& q, const Score& score, Rng& rng) {
    Candidates all = base_.sample(map, q, score, rng);
    if (!all.parent.empty()) throw Error("UtilityWeighted::sample", "the base proposes sequences", "single views");
    if (all.utilities.empty()) {
      all.utilities.resize(all.views.size());
      score(all.views, all.utilities);
    }
    Candidates kept;
    for (const std::size_t i : draw(all.utilities, Rng(rng()))) {
      kept.views.push_back(all.views[i]);
      kept.utilities.push_back(all.utilities[i]);
    }
    return kept;
  }
  void save(Sink& sink) const requires Persistent<Base> { base_.save(sink); }
  void load(Source& source) requires Persistent<Base> { base_.load(source); }

 private:
  /// Of exponentially distributed waits with these rates, the least comes first with probability p_i, the next one with
  /// the p_i of those left, and so on (Efraimidis and Spirakis, "Weighted random sampling with a reservoir", 2006).
  [[nodiscard]] std::vector<std::size_t> draw(const std::vector<double>& utilities, const Rng& streams) const {
    double least = 0;
    for (std::size_t i = 0; i < utilities.size(); ++i) {
      if (!std::isfinite(utilities[i]))
        throw Error("UtilityWeighted::sample", concat("the utility of candidate ", i, " is ", utilities[i]),
                    "a finite number");
      least = std::min(least, utilities[i]);
    }
    std::vector<std::tuple<bool, double, std::size_t>> waits;  // never, how long, who
    for (std::size_t i = 0; i < utilities.size(); ++i) {
      const double weight = utilities[i] - least, wait = -std::log(1 - streams.fork(i).uniform());
      waits.emplace_back(!(weight > 0), weight > 0 ? wait / weight : wait, i);
    }
    const std::size_t n = std::min(waits.size(), static_cast<std::size_t>(config_.candidates));
    std::partial_sort(waits.begin(), waits.begin() + static_cast<std::ptrdiff_t>(n), waits.end());
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < n; ++k) chosen.push_back(std::get<std::size_t>(waits[k]));
    std::sort(chosen.begin(), chosen.end());
    return chosen;
  }
  Base base_;
  Config config_;
};
template <class Base>
UtilityWeighted(Base) -> UtilityWeighted<Base>;
template <class Base>
UtilityWeighted(Base, UtilityWeightedConfig) -> UtilityWeighted<Base>;

}  // namespace vantage
