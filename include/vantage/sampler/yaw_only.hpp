// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <utility>
#include <vector>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/level_view.hpp>

namespace vantage {

/// For robots whose camera neither pitches nor rolls (section 6.2.3): what another sampler proposes, from the same
/// places in the same headings, but level. Whatever it scores on the way it scores level too, so that a view whose
/// worth lay above or below is worth what the robot would really see. Saves itself if the other sampler does.
template <class Sampler>
class YawOnly {
 public:
  using MapNeeds = NeedsOf<Sampler>;
  YawOnly() = default;
  explicit YawOnly(Sampler sampler) : sampler_(std::move(sampler)) {}

  template <Map M>
  requires SamplerFor<Sampler, M> Candidates sample(const M& map, const Situation& q, const Score& score, Rng& rng) {
    const auto scorer = [&](Views given, Views views, std::span<double> out) {
      score(levelled(given), levelled(views), out);
    };
    Candidates c = sampler_.sample(map, q, Score(scorer), rng);
    c.views = levelled(c.views);
    return c;
  }

  void save(Sink& sink) const requires Persistent<Sampler> { sampler_.save(sink); }
  void load(Source& source) requires Persistent<Sampler> { sampler_.load(source); }

 private:
  static std::vector<View> levelled(Views views) {
    std::vector<View> result;
    result.reserve(views.size());
    for (const View& v : views) result.push_back(level(v));
    return result;
  }
  Sampler sampler_{};
};

}  // namespace vantage
