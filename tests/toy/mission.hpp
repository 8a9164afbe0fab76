// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>

// The smallest mission in which everything has a memory: map, world, sampler and clock. For tests of the mission room.
namespace toy {

using namespace vantage;

/// A grid of independent cells, each the running mean of what was seen of it.
struct ToyMap {
  using Measurement = FieldImage;
  explicit ToyMap(int n) : cells_per_side(n), sum(static_cast<std::size_t>(n * n)), count(sum) {}

  [[nodiscard]] Box3 bounds() const {
    return {Eigen::Vector3d::Zero(), Eigen::Vector3d(cells_per_side, cells_per_side, 0)};
  }
  void integrate(const FieldImage& z, Rng& rng) {
    if (!z.values.isFinite().all()) throw Error("ToyMap::integrate", "a value is not finite", "finite values");
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (z.footprint.contains(centre(i))) {
        sum[i] += z.values.mean() + 1e-3 * rng.normal();
        count[i] += 1;
      }
  }
  [[nodiscard]] std::size_t size() const { return sum.size(); }
  [[nodiscard]] Eigen::Vector2d centre(std::size_t i) const {
    const auto n = static_cast<std::size_t>(cells_per_side);
    return {static_cast<double>(i % n) + 0.5, static_cast<double>(i / n) + 0.5};
  }
  [[nodiscard]] double mean(std::size_t i) const { return count[i] > 0 ? sum[i] / count[i] : 0.5; }
  [[nodiscard]] double variance(std::size_t i) const { return 1 / (1 + count[i]); }
  [[nodiscard]] double total_variance() const {
    double total = 0;
    for (std::size_t i = 0; i < size(); ++i) total += variance(i);
    return total;
  }
  void save(Sink& sink) const {
    sink.put(cells_per_side);
    sink.put(sum);
    sink.put(count);
  }
  void load(Source& source) {
    ToyMap other = *this;
    source.get(other.cells_per_side);
    source.get(other.sum);
    source.get(other.count);
    if (other.cells_per_side != cells_per_side || other.sum.size() != sum.size() || other.count.size() != sum.size())
      throw Error(source.where(), "a map of another size", concat(cells_per_side, " cells a side"));
    *this = std::move(other);
  }
  int cells_per_side;
  std::vector<double> sum, count;
};

/// Noise of its own, so that a resumed world must remember its stream; `ends_after` observations it gives no more.
struct ToyWorld {
  Rng rng{3};
  std::uint64_t ends_after = 1'000'000, observed = 0;
  std::optional<FieldImage> observe(const View& view) {
    if (observed++ >= ends_after) return std::nullopt;
    const double value = std::sin(view.position().x()) * std::cos(view.position().y()) + 0.1 * rng.normal();
    return FieldImage{view, NadirSensor{}.footprint(view), Image<double>::Constant(2, 2, value)};
  }
  void save(Sink& sink) const {
    for (const std::uint64_t word : rng.state()) sink.put(word);
    sink.put(observed);
  }
  void load(Source& source) {
    const auto key = source.get<std::uint64_t>(), counter = source.get<std::uint64_t>();
    source.get(observed);
    rng = Rng::restored({key, counter});
  }
};

/// Prefers cells that are uncertain.
struct ToyUtility {
  double operator()(const ToyMap& map, const View& v) const {
    const Box2 seen = NadirSensor{}.footprint(v);
    double sum = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
      if (seen.contains(map.centre(i))) sum += map.variance(i);
    return sum;
  }
};

/// Random views, lower from call to call: it remembers how often it was asked.
struct ToySampler {
  std::uint64_t calls = 0;
  template <class M>
  Candidates sample(const M& map, const Situation&, const Score&, Rng& rng) {
    ++calls;
    Candidates c;
    const double side = map.bounds().max().x();
    for (int i = 0; i < 8; ++i)
      c.views.push_back(nadir(rng.uniform(0, side), rng.uniform(0, side), 1 + 1 / static_cast<double>(calls)));
    return c;
  }
  void save(Sink& sink) const { sink.put(calls); }
  void load(Source& source) { source.get(calls); }
};

struct ToySelector {
  template <class M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    const auto best = std::max_element(c.utilities.begin(), c.utilities.end());
    const auto i = static_cast<std::size_t>(best - c.utilities.begin());
    const double d = distance_m(q.here, c.views[i]);
    return Decision{.index = i, .travel_s = d, .travel_m = d};
  }
};

struct ToyStop {
  double budget_s;
  template <class M>
  bool operator()(const M&, const Situation& q) const {
    return q.elapsed_s >= budget_s;
  }
};

inline auto toy_loop(int n = 8) { return NbvLoop{ToyMap(n), ToyUtility{}, ToySampler{}, ToySelector{}}; }

}  // namespace toy
