// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Somebody else's program: a map, a utility and a world of its own in vantage's loop.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/version.hpp>

using namespace vantage;

struct Glimpse {
  View view;
};

/// How often each of four sectors was seen.
struct SectorMap {
  using Measurement = Glimpse;
  std::array<double, 4> seen{};

  static std::size_t sector(const View& v) {
    return (v.position().x() > 0 ? 1u : 0u) + (v.position().y() > 0 ? 2u : 0u);
  }
  void integrate(const Glimpse& z, Rng&) { seen[sector(z.view)] += 1; }
  Box3 bounds() const { return {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 1)}; }
};

struct LeastSeen {
  double operator()(const SectorMap& map, const View& v) const { return -map.seen[SectorMap::sector(v)]; }
};

struct Corners {
  template <Map M>
  Candidates sample(const M& map, const Situation&, const Score&, Rng&) const {
    const Box3 b = map.bounds();
    Candidates c;
    for (double y : {b.min().y(), b.max().y()})
      for (double x : {b.min().x(), b.max().x()}) c.views.push_back(nadir(x, y, b.max().z()));
    return c;
  }
};

struct First {
  template <Map M>
  std::optional<Decision> select(const M&, const Situation&, const Candidates& c, const Score&, Rng&) const {
    const auto best = std::max_element(c.utilities.begin(), c.utilities.end());
    return Decision{.index = static_cast<std::size_t>(best - c.utilities.begin())};
  }
};

struct HereWorld {
  std::optional<Glimpse> observe(const View& v) { return Glimpse{v}; }
};

int main() {
  NbvLoop loop{SectorMap{}, LeastSeen{}, Corners{}, First{}};
  HereWorld world;
  const auto eight = [](const SectorMap&, const Situation& q) { return q.visited.size() == 8; };
  loop.run(world, nadir(0, 0, 1), {}, eight, ModelledClock{}, Rng{7});
  for (const double seen : loop.map.seen)
    if (seen != 2) return 1;
  std::printf("vantage %s: every sector seen twice\n", VANTAGE_VERSION);
}
