// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

// The 26 moves from a voxel to its neighbours, and which of them a shortest path needs after which.
namespace vantage::detail {

/// A move (x, y, z), each of -1, 0 and 1, has the index x + 1 + 3 (y + 1) + 9 (z + 1); 13 is to stay.
inline constexpr std::size_t stay = 13, moves = 27;
/// One bit a move, or a neighbour that it leads to.
using MoveSet = std::uint32_t;
inline constexpr MoveSet all_moves = (MoveSet{1} << moves) - 1 - (MoveSet{1} << stay);

inline Eigen::Vector3i move_at(std::size_t index) {
  const auto i = static_cast<int>(index);
  return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
}
inline std::size_t index_of_move(const Eigen::Vector3i& move) {
  const int index = move.x() + 1 + 3 * (move.y() + 1) + 9 * (move.z() + 1);
  return static_cast<std::size_t>(index);
}
/// The axes along which a move goes, bit 0 for x: moves of one kind are equally long.
inline unsigned kind_of_move(const Eigen::Vector3i& move) {
  return static_cast<unsigned>((move.x() != 0) | (move.y() != 0) << 1 | (move.z() != 0) << 2);
}
/// f(index) for each move of a set, in the order of the indices.
template <class F>
void for_each_move(MoveSet set, F&& f) {
  for (; set != 0; set &= set - 1) f(static_cast<std::size_t>(std::countr_zero(set)));
}

/// Which moves are worth trying after a move into a voxel. Of all shortest paths between two voxels a search needs one:
/// here that which goes diagonally as early as it can (the order of Harabor and Grastien, "Online graph pruning for
/// pathfinding on grid maps", AAAI 2011, carried over to 26 neighbours). So a second move is left out if the voxel
/// behind both is reached from the one before them without this detour: at once, or through another open neighbour, on
/// a way that is shorter, or as long and of higher rank in that order. This holds for voxels of any proportions: of two
/// pairs of moves with the same axes in all, the one is shorter in which the axes of one move include those of the
/// other (the root is concave). In open space 1, 3 or 7 moves are left of 26.
class LatticeMoves {
 public:
  static const LatticeMoves& table() {
    static const LatticeMoves the_table;
    return the_table;
  }
  /// After any of the moves `in` (`stay`: at the start), with the neighbours `open`.
  [[nodiscard]] MoveSet after(MoveSet in, MoveSet open) const {
    MoveSet out = 0;
    for_each_move(in, [&](std::size_t i) {
      if (open == all_moves) {
        out |= in_the_open_[i];
        return;
      }
      MoveSet rest = candidates_[i] & open;
      for_each_move(open & witnesses_[i], [&](std::size_t w) { rest &= ~needless_[i][w]; });
      out |= rest;
    });
    return out;
  }

 private:
  LatticeMoves() {
    for (std::size_t i = 0; i < moves; ++i) {
      const Eigen::Vector3i first = move_at(i);
      for (std::size_t j = 0; j < moves; ++j) {
        const Eigen::Vector3i second = move_at(j);
        if (j == stay || (i != stay && adjacent(first + second))) continue;
        candidates_[i] |= bit(j);
        if (i == stay) continue;
        for (std::size_t w = 0; w < moves; ++w) {  // the neighbour first + other first move
          const Eigen::Vector3i other_first = first + move_at(w), other_second = second - move_at(w);
          if (w == stay || !adjacent(other_first) || !adjacent(other_second)) continue;
          if (better(other_first, other_second, first, second)) {
            needless_[i][w] |= bit(j);
            witnesses_[i] |= bit(w);
          }
        }
      }
      in_the_open_[i] = candidates_[i];
      for (std::size_t w = 0; w < moves; ++w) in_the_open_[i] &= ~needless_[i][w];
    }
  }
  static MoveSet bit(std::size_t i) { return MoveSet{1} << i; }
  static bool adjacent(const Eigen::Vector3i& step) { return step.cwiseAbs().maxCoeff() <= 1; }
  static int rank(const Eigen::Vector3i& move) {
    return 27 * move.cwiseAbs().sum() + static_cast<int>(index_of_move(move));
  }
  /// Whether moves a, b are a better way than c, d to the same place, whatever the voxels' edges.
  static bool better(const Eigen::Vector3i& a, const Eigen::Vector3i& b, const Eigen::Vector3i& c,
                     const Eigen::Vector3i& d) {
    if (a.isZero() || b.isZero()) return true;
    const unsigned ka = kind_of_move(a), kb = kind_of_move(b), kc = kind_of_move(c), kd = kind_of_move(d);
    if ((ka == kc && kb == kd) || (ka == kd && kb == kc)) return rank(a) > rank(c);
    const auto within = [](unsigned inner, unsigned outer) { return (inner & ~outer) == 0; };
    return (within(ka, kb) || within(kb, ka)) && within(ka | kb, kc | kd) && within(ka & kb, kc & kd);
  }
  std::array<MoveSet, moves> candidates_{}, witnesses_{}, in_the_open_{};
  std::array<std::array<MoveSet, moves>, moves> needless_{};
};

}  // namespace vantage::detail
