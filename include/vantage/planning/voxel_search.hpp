// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/planning/lattice_moves.hpp>
#include <vantage/planning/passable.hpp>

namespace vantage {

/// Shortest paths from one voxel to many, over passable voxels and from centre to centre of each of the 26 neighbours:
/// A* whose heuristic is the length of the way to the box around all goals, were everything passable. Exact: lengths
/// are integers, multiples of 2^-36 of the shortest move, so that equally long ways compare equal and every move is
/// right to 1e-11. Of several shortest paths it takes the same on every machine. The search is over when the
/// constructor returns; then const members run concurrently.
///
/// Cost: of a voxel reached, one visit as a rule, and one to a few of its 26 neighbours tried (LatticeMoves). Open ends
/// wait in buckets as wide as the shortest move, so that nothing is ever sorted. Memory: 6.5 KB for each block of
/// 8 x 8 x 8 voxels that the search enters, each asked once for its passable voxels; nothing for the rest of the grid.
template <PassableVoxels P>
class VoxelSearch {
 public:
  /// Of goals outside of the grid, or not passable, it says that there is no path; as it does for all, if the start is.
  VoxelSearch(const P& passable, const Eigen::Vector3i& from, std::span<const Eigen::Vector3i> goals)
      : passable_(passable), grid_(passable.grid()) {
    measure_moves();
    if (!passable_(from)) return;
    std::vector<Eigen::Vector3i> wanted;
    for (const Eigen::Vector3i& goal : goals)
      if (passable_(goal)) wanted.push_back(goal);
    if (wanted.empty()) return;
    goals_low_ = goals_high_ = wanted.front();
    for (const Eigen::Vector3i& goal : wanted)
      goals_low_ = goals_low_.cwiseMin(goal), goals_high_ = goals_high_.cwiseMax(goal);
    run(from, wanted);
  }

  /// Of the shortest path to one of the goals [m]; infinity if there is none.
  [[nodiscard]] double length_m(const Eigen::Vector3i& goal) const {
    const Cost cost = cost_of(goal);
    return cost == unreached ? std::numeric_limits<double>::infinity() : static_cast<double>(cost) * unit_m_;
  }
  /// The voxels of a shortest path to one of the goals, start and goal included; empty if there is none. Among the
  /// shortest it goes straight on, seen from the goal, where it can.
  [[nodiscard]] std::vector<Eigen::Vector3i> path(const Eigen::Vector3i& goal) const {
    if (cost_of(goal) == unreached) return {};
    std::vector<Eigen::Vector3i> voxels = {goal};
    std::size_t last = detail::stay;
    for (;;) {
      const Eigen::Vector3i& voxel = voxels.back();
      const MoveSet in = labels_of(block_of(voxel))->in[local_of(voxel)];
      if (in == MoveSet{1} << detail::stay) break;
      if ((in >> last & 1) == 0) last = static_cast<std::size_t>(std::countr_zero(in));
      voxels.push_back(voxel - detail::move_at(last));
    }
    std::reverse(voxels.begin(), voxels.end());
    return voxels;
  }
  /// How many voxels the search has reached.
  [[nodiscard]] std::size_t reached() const { return reached_; }

 private:
  using Cost = std::uint64_t;
  using MoveSet = detail::MoveSet;
  static constexpr Cost unreached = std::numeric_limits<Cost>::max();
  static constexpr std::size_t block_voxels = 512;

  struct Labels {
    std::array<Cost, block_voxels> cost;
    std::array<MoveSet, block_voxels> in{};                // the moves by which shortest paths come here
    VoxelBits waiting{};                                   // has something new to tell its neighbours
    std::array<std::array<std::uint16_t, 10>, 10> open{};  // passable, one voxel beyond the block: bit x of row z, y
    std::array<std::uint32_t, detail::moves> neighbour{};  // blocks around
    bool surrounded = false;                               // the two above are known
    bool in_goals_box = false;
    Labels() { cost.fill(unreached); }
  };
  struct Block {
    Eigen::Vector3i index;
    VoxelBits passable;
    std::unique_ptr<Labels> labels;  // once it is reached
  };
  struct Hash {
    std::size_t operator()(const Eigen::Vector3i& v) const {
      const auto word = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
      return (word(v.x()) | word(v.y()) << 16 | word(v.z()) << 32) * 0x9E3779B97F4A7C15u >> 20;
    }
  };

  void measure_moves() {
    // Along an axis of one voxel there is nowhere to go.
    const Eigen::Vector3d edge = (grid_.size().array() > 1).select(grid_.voxel_m(), Eigen::Vector3d::Zero());
    double shortest_m = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      if (edge[axis] > 0) shortest_m = std::min(shortest_m, edge[axis]);
    if (!std::isfinite(shortest_m)) shortest_m = 1;
    unit_m_ = std::ldexp(shortest_m, -bucket_bits);
    for (std::size_t i = 0; i < detail::moves; ++i) {
      const Eigen::Vector3i move = detail::move_at(i);
      const auto cost =
          static_cast<Cost>(std::llround(move.template cast<double>().cwiseProduct(edge).norm() / unit_m_));
      move_cost_[i] = cost;
      kind_cost_[detail::kind_of_move(move)] = cost;
    }
    // What is put in a bucket is at most the longest move there and back (by cost and by heuristic) beyond the current.
    buckets_.resize(std::bit_ceil(static_cast<std::size_t>(2 * (kind_cost_[7] >> bucket_bits) + 4)));
  }

  void run(const Eigen::Vector3i& from, std::vector<Eigen::Vector3i>& wanted) {
    reach(block_at(block_of(from)), local_of(from), 0, detail::stay);
    for (current_ = to_the_goals(from) >> bucket_bits; waiting_ > 0; ++current_) {
      // First come, first served: towards the goals the heuristic leaves all of a way in one bucket, where voxels
      // told last, expanded first, would be told better again and again.
      auto& bucket = bucket_of(current_);
      for (std::size_t k = 0; k < bucket.size(); ++k) {
        const std::uint64_t entry = bucket[k];
        expand(static_cast<std::uint32_t>(entry / block_voxels), static_cast<std::size_t>(entry % block_voxels));
      }
      waiting_ -= bucket.size();
      bucket.clear();
      // Whatever costs no more than this bucket holds is final.
      std::erase_if(wanted, [&](const Eigen::Vector3i& goal) {
        const Cost cost = cost_of(goal);
        return cost != unreached && cost >> bucket_bits <= current_;
      });
      if (wanted.empty()) break;
    }
    buckets_.clear();
  }

  void expand(std::uint32_t b, std::size_t local) {
    Block& block = blocks_[b];
    Labels& here = *block.labels;
    if (!here.waiting[local]) return;
    here.waiting.reset(local);
    if (!here.surrounded) surround(b);
    const std::size_t x = local & 7, y = local >> 3 & 7, z = local >> 6;
    MoveSet open = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) open |= (here.open[z + k][y + j] >> x & 7u) << (3 * j + 9 * k);
    open &= detail::all_moves;
    const Cost cost = here.cost[local];
    detail::for_each_move(table_.after(here.in[local], open), [&](std::size_t i) {
      const std::size_t nx = x + i % 3 + 7, ny = y + i / 3 % 3 + 7, nz = z + i / 9 + 7;  // 8 more than in this block
      const std::size_t side = (nx >> 3) + 3 * (ny >> 3) + 9 * (nz >> 3);
      reach(here.neighbour[side], (nx & 7) | (ny & 7) << 3 | (nz & 7) << 6, cost + move_cost_[i], i);
    });
  }

  void reach(std::uint32_t b, std::size_t local, Cost cost, std::size_t move) {
    Block& block = blocks_[b];
    if (!block.labels) {
      block.labels = std::make_unique<Labels>();
      const Eigen::Array3i low = block_edge * block.index.array(), high = low + (block_edge - 1);
      block.labels->in_goals_box = (low >= goals_low_.array()).all() && (high <= goals_high_.array()).all();
    }
    Labels& there = *block.labels;
    if (cost > there.cost[local]) return;
    const MoveSet in = MoveSet{1} << move;
    if (cost < there.cost[local]) {
      reached_ += there.cost[local] == unreached;
      there.cost[local] = cost;
      there.in[local] = in;
    } else {
      if ((there.in[local] & in) != 0) return;
      there.in[local] |= in;  // as good as what is known: waits already, or tells its neighbours once more
      if (there.waiting[local]) return;
    }
    there.waiting.set(local);
    ++waiting_;
    const Cost whole = there.in_goals_box ? cost : cost + to_the_goals(voxel_of(block.index, local));
    // At least the current one: no rounding puts an open end where nobody looks any more.
    bucket_of(std::max(current_, whole >> bucket_bits)).push_back(b * block_voxels + local);
  }

  /// How long the way to the box around the goals is, were everything passable.
  [[nodiscard]] Cost to_the_goals(const Eigen::Vector3i& voxel) const {
    Eigen::Vector3i steps = (goals_low_ - voxel).cwiseMax(voxel - goals_high_).cwiseMax(0);
    Cost cost = 0;
    while (const unsigned axes = detail::kind_of_move(steps)) {  // diagonally along all axes that are left
      int n = std::numeric_limits<int>::max();
      for (const int s : steps)
        if (s > 0) n = std::min(n, s);
      cost += static_cast<Cost>(n) * kind_cost_[axes];
      steps = (steps.array() - n).max(0);
    }
    return cost;
  }
  std::vector<std::uint64_t>& bucket_of(Cost b) { return buckets_[b & (buckets_.size() - 1)]; }

  std::uint32_t block_at(const Eigen::Vector3i& index) {
    const auto [at, is_new] = at_.try_emplace(index, static_cast<std::uint32_t>(blocks_.size()));
    if (is_new) blocks_.push_back({index, passable_.in(index), nullptr});
    return at->second;
  }
  void surround(std::uint32_t b) {
    Labels& here = *blocks_[b].labels;
    const Eigen::Vector3i index = blocks_[b].index, last = block_of(grid_.size() - Eigen::Vector3i::Ones());
    for (std::size_t i = 0; i < detail::moves; ++i) {
      const Eigen::Vector3i side = detail::move_at(i), other = index + side;
      if ((other.array() < 0).any() || (other.array() > last.array()).any()) continue;
      here.neighbour[i] = block_at(other);
      const VoxelBits& bits = blocks_[here.neighbour[i]].passable;
      const auto first = [](int s) { return static_cast<std::size_t>(s < 0 ? 7 : 0); };
      const auto count = [](int s) { return static_cast<std::size_t>(s == 0 ? 8 : 1); };
      const auto row = [](int s) { return static_cast<std::size_t>(s < 0 ? 0 : s == 0 ? 1 : 9); };
      for (std::size_t z = 0; z < count(side.z()); ++z)
        for (std::size_t y = 0; y < count(side.y()); ++y) {
          std::uint64_t line = bits.slice[first(side.z()) + z] >> 8 * (first(side.y()) + y) & 0xFF;
          if (side.x() != 0) line = line >> first(side.x()) & 1;
          here.open[row(side.z()) + z][row(side.y()) + y] |= static_cast<std::uint16_t>(line << row(side.x()));
        }
    }
    here.surrounded = true;
  }

  [[nodiscard]] const Labels* labels_of(const Eigen::Vector3i& block) const {
    const auto at = at_.find(block);
    return at == at_.end() ? nullptr : blocks_[at->second].labels.get();
  }
  [[nodiscard]] Cost cost_of(const Eigen::Vector3i& voxel) const {
    const Labels* labels = grid_.contains(voxel) ? labels_of(block_of(voxel)) : nullptr;
    return labels ? labels->cost[local_of(voxel)] : unreached;
  }

  static constexpr int bucket_bits = 36;
  const detail::LatticeMoves& table_ = detail::LatticeMoves::table();
  P passable_;
  VoxelGrid grid_;
  double unit_m_ = 1;
  std::array<Cost, detail::moves> move_cost_{};
  std::array<Cost, 8> kind_cost_{};
  Eigen::Vector3i goals_low_ = Eigen::Vector3i::Zero(), goals_high_ = Eigen::Vector3i::Zero();
  std::vector<Block> blocks_;
  std::unordered_map<Eigen::Vector3i, std::uint32_t, Hash> at_;
  std::vector<std::vector<std::uint64_t>> buckets_;
  Cost current_ = 0;  // bucket
  std::size_t waiting_ = 0, reached_ = 0;
};

}  // namespace vantage
