// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Shortest paths through an apartment of 12 m x 10 m x 2.5 m, five rooms with furniture, for a body of 30 cm: lengths
// to 100 goals (or one), beside Dijkstra's algorithm with a binary heap over arrays of the whole box.
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "peak.hpp"

#include <vantage/concepts/archetypes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/planning/shortcut.hpp>

namespace {

using namespace vantage;

/// All of it known. Its bits are kept, as a map keeps them that learns.
class Apartment : public archetype::Map {
 public:
  explicit Apartment(double voxel_m) : grid_(VoxelGrid::on_lattice(walls(), voxel_m)) {
    for (int z = 0; z < grid_.size().z(); z += block_edge)
      for (int y = 0; y < grid_.size().y(); y += block_edge)
        for (int x = 0; x < grid_.size().x(); x += block_edge) {
          const Eigen::Vector3i block = block_of({x, y, z});
          VoxelBits& bits = navigable_.emplace_back();
          VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
            if (fits(grid_.centre(voxel_of(block, local)))) bits.set(local);
          });
        }
  }
  static Box3 walls() { return {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(12, 10, 2.5)}; }
  [[nodiscard]] Box3 bounds() const { return grid_.box(); }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] Space at(const Eigen::Vector3d&) const { return Space::free; }
  [[nodiscard]] Space state(const Eigen::Vector3i&) const { return Space::free; }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return {}; }
  [[nodiscard]] VoxelBits free_in(const Eigen::Vector3i& block) const { return navigable_in(block); }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i&) const { return {}; }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i&) const { return {}; }
  [[nodiscard]] double clearance_m() const { return 0.3; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& v) const {
    return grid_.contains(v) && navigable_in(block_of(v))[local_of(v)];
  }
  [[nodiscard]] const VoxelBits& navigable_in(const Eigen::Vector3i& block) const {
    const Eigen::Vector3i n = block_of(grid_.size() + Eigen::Vector3i::Constant(block_edge - 1));
    return navigable_[static_cast<std::size_t>((block.z() * n.y() + block.y()) * n.x() + block.x())];
  }
  [[nodiscard]] View random_view(Rng& rng) const {
    for (;;) {
      const Eigen::Vector3d p(rng.uniform(0, 12), rng.uniform(0, 10), rng.uniform(0, 2.5));
      if (const Eigen::Vector3i v = grid_.voxel_at(p); navigable(v))
        return look_at(grid_.centre(v), grid_.centre(v) + Eigen::Vector3d::UnitX());
    }
  }

 private:
  [[nodiscard]] static bool fits(const Eigen::Vector3d& p) {
    const auto box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
      return Box3(Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1));
    };
    // Two walls along x and two along y, doors of 1 m, 2.1 m high; then furniture.
    static const Box3 solids[] = {
        box(0, 4, 0, 2, 4.1, 2.5),     box(3, 4, 0, 8.5, 4.1, 2.5),     box(9.5, 4, 0, 12, 4.1, 2.5),
        box(2, 4, 2.1, 3, 4.1, 2.5),   box(8.5, 4, 2.1, 9.5, 4.1, 2.5), box(6, 0, 0, 6.1, 1.5, 2.5),
        box(6, 2.5, 0, 6.1, 4, 2.5),   box(6, 1.5, 2.1, 6.1, 2.5, 2.5), box(0, 6, 0, 4, 6.1, 2.5),
        box(5, 6, 0, 12, 6.1, 2.5),    box(4, 6, 2.1, 5, 6.1, 2.5),     box(7, 6.1, 0, 7.1, 8, 2.5),
        box(7, 9, 0, 7.1, 10, 2.5),    box(7, 8, 2.1, 7.1, 9, 2.5),     box(1, 1, 0, 3, 2.2, 0.8),
        box(4, 0, 0, 5, 0.6, 2),       box(9, 1, 0, 11, 2, 0.5),        box(0, 7, 0, 0.6, 9, 2.2),
        box(2, 7.5, 0, 4, 8.5, 0.75),  box(9, 8, 0, 11, 10, 0.6),       box(11.4, 6.1, 0, 12, 8, 2.2),
        box(8, 7, 0.7, 8.8, 7.8, 0.75)};
    if ((p.array() < 0.3).any() || (p.array() > walls().max().array() - 0.3).any()) return false;
    for (const Box3& solid : solids)
      if (solid.squaredExteriorDistance(p) < 0.3 * 0.3) return false;
    return true;
  }
  VoxelGrid grid_;
  std::vector<VoxelBits> navigable_;
};

/// The yardstick: until all goals are settled, or nothing is left.
std::vector<double> dijkstra_m(const Apartment& map, const View& from, Views goals) {
  const VoxelGrid& grid = map.grid();
  const Eigen::Vector3i n = grid.size();
  const auto slot = [&](const Eigen::Vector3i& v) { return (v.z() * n.y() + v.y()) * n.x() + v.x(); };
  std::vector<double> length(grid.count(), std::numeric_limits<double>::infinity());
  std::vector<bool> is_goal(grid.count());
  std::size_t left = 0;
  for (const View& goal : goals) {
    const auto s = static_cast<std::size_t>(slot(grid.voxel_at(goal.position())));
    left += !is_goal[s];
    is_goal[s] = true;
  }
  std::vector<std::pair<Eigen::Vector3i, double>> steps;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (const Eigen::Vector3i s(x, y, z); !s.isZero())
          steps.emplace_back(s, s.cast<double>().cwiseProduct(grid.voxel_m()).norm());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> ends;
  const int start = slot(grid.voxel_at(from.position()));
  length[static_cast<std::size_t>(start)] = 0;
  ends.emplace(0, start);
  while (!ends.empty() && left > 0) {
    const auto [so_far, at] = ends.top();
    ends.pop();
    if (so_far > length[static_cast<std::size_t>(at)]) continue;
    left -= is_goal[static_cast<std::size_t>(at)];
    const Eigen::Vector3i voxel(at % n.x(), at / n.x() % n.y(), at / (n.x() * n.y()));
    for (const auto& [step, step_m] : steps) {
      const Eigen::Vector3i next = voxel + step;
      if (!map.navigable(next)) continue;
      double& there = length[static_cast<std::size_t>(slot(next))];
      if (!(so_far + step_m < there)) continue;
      there = so_far + step_m;
      ends.emplace(there, slot(next));
    }
  }
  std::vector<double> lengths;
  for (const View& goal : goals)
    lengths.push_back(length[static_cast<std::size_t>(slot(grid.voxel_at(goal.position())))]);
  return lengths;
}

template <class F>
void to_goals(benchmark::State& state, double voxel_m, std::size_t n, F lengths_m) {
  const Apartment map(voxel_m);
  Rng rng(1);
  const Eigen::Vector3d centre = map.grid().centre(map.grid().voxel_at({1, 3, 1.5}));
  const View from = look_at(centre, centre + Eigen::Vector3d::UnitX());
  std::vector<View> goals;
  while (goals.size() < n) goals.push_back(map.random_view(rng));
  const std::vector<double> expected_m = dijkstra_m(map, from, goals);
  const std::vector<double> found_m = lengths_m(map, from, goals);
  for (std::size_t i = 0; i < n; ++i)
    if (!(std::abs(found_m[i] - expected_m[i]) < 1e-6)) state.SkipWithError("a path is not the shortest");
  for (auto _ : state) benchmark::DoNotOptimize(lengths_m(map, from, goals));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

void astar(benchmark::State& state, double voxel_m, std::size_t n) {
  to_goals(state, voxel_m, n, [](const auto&... args) { return AStar().lengths_m(args...); });
}
void dijkstra(benchmark::State& state, double voxel_m, std::size_t n) {
  to_goals(state, voxel_m, n, [](const auto&... args) { return dijkstra_m(args...); });
}

// The whole of a step: lengths to 100 goals, each path straightened, as Shortcut gives them to a selector.
void shortcut(benchmark::State& state, double voxel_m, std::size_t n) {
  const Apartment map(voxel_m);
  Rng rng(1);
  const View from = map.random_view(rng);
  std::vector<View> goals;
  while (goals.size() < n) goals.push_back(map.random_view(rng));
  for (auto _ : state) benchmark::DoNotOptimize(Shortcut<AStar>().lengths_m(map, from, goals));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

#define VANTAGE_PLANNING(kernel, name, voxel_m, n) \
  BENCHMARK_CAPTURE(kernel, name, voxel_m, n)->Name(name)->Unit(benchmark::kMillisecond)->UseRealTime()

VANTAGE_PLANNING(astar, "planning/astar/100", 0.2, 100);
VANTAGE_PLANNING(dijkstra, "planning/dijkstra/100", 0.2, 100);
VANTAGE_PLANNING(astar, "planning/astar_10cm/100", 0.1, 100);
VANTAGE_PLANNING(dijkstra, "planning/dijkstra_10cm/100", 0.1, 100);
VANTAGE_PLANNING(astar, "planning/astar_5cm/100", 0.05, 100);
VANTAGE_PLANNING(dijkstra, "planning/dijkstra_5cm/100", 0.05, 100);
VANTAGE_PLANNING(astar, "planning/astar/1", 0.2, 1);
VANTAGE_PLANNING(astar, "planning/astar_5cm/1", 0.05, 1);
VANTAGE_PLANNING(shortcut, "planning/shortcut/100", 0.2, 100);
VANTAGE_PLANNING(shortcut, "planning/shortcut_5cm/100", 0.05, 100);

}  // namespace

BENCHMARK_MAIN();
