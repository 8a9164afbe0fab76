// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sampler/view_tree.hpp>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/selector/first_of_branch.hpp>

#include "drawn_voxels.hpp"
#include "tight_box.hpp"

namespace vantage {
namespace {

static_assert(Persistent<ViewTree> && SamplerFor<ViewTree, test::DrawnVoxels>);

/// A corridor of 8 m x 2 m x 2 m with a wall across it that leaves a gap of 1 m.
class Corridor : public testing::Test {
 protected:
  VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(8, 2, 2)}, 0.2);
  test::DrawnVoxels map{grid, 0.2};
  View here = look_at({1.1, 1.1, 1.1}, {2, 1.1, 1.1});
  Corridor() {
    map.draw_all([](const Eigen::Vector3i& v) { return v.x() == 20 && v.y() < 5 ? Space::occupied : Space::free; });
  }
};

/// How far to the right, less what is already given near it.
struct Rightmost {
  void operator()(Views given, Views views, std::span<double> out) const {
    for (std::size_t i = 0; i < views.size(); ++i) {
      out[i] = views[i].position().x();
      for (const View& g : given) out[i] -= 0.1 * std::exp(-distance_m(g, views[i]));
    }
  }
};
Candidates grow(ViewTree& tree, const test::DrawnVoxels& map, const View& here, std::uint64_t seed,
                const auto& scorer) {
  Rng rng(seed);
  return tree.sample(map, {.here = here}, Score(scorer), rng);
}
std::vector<double> numbers(const Candidates& c) {
  std::vector<double> n = c.utilities;
  for (const View& v : c.views) n.insert(n.end(), v.T_W_C.data(), v.T_W_C.data() + 16);
  for (const int p : c.parent) n.push_back(p);
  return n;
}

TEST_F(Corridor, EveryEdgeIsShortAndOpenAndEveryViewLevel) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ViewTree tree({.nodes = 100, .step_m = 0.7});
    const Candidates c = grow(tree, map, here, seed, Rightmost{});
    ASSERT_EQ(c.views.size(), 100u);
    ASSERT_EQ(c.parent.size(), 100u);
    for (std::size_t i = 0; i < c.views.size(); ++i) {
      ASSERT_GE(c.parent[i], -1);
      ASSERT_LT(c.parent[i], static_cast<int>(i));
      const View& before = c.parent[i] < 0 ? here : c.views[static_cast<std::size_t>(c.parent[i])];
      EXPECT_LE(distance_m(before, c.views[i]), 0.7 + 1e-9);
      for (int k = 0; k <= 100; ++k)
        EXPECT_TRUE(
            map.navigable(grid.voxel_at(before.position() + 0.01 * k * (c.views[i].position() - before.position()))));
      EXPECT_NEAR(c.views[i].forward().z(), 0, 1e-12);
      EXPECT_NO_THROW(check_view(c.views[i], "node"));
    }
  }
}

TEST_F(Corridor, GainsAddUpAlongTheBranchDiscounted) {
  ViewTree tree({.nodes = 60, .step_m = 0.7, .discount_per_m = 0.3});
  const Rightmost psi;
  const Candidates c = grow(tree, map, here, 3, psi);
  for (std::size_t i = 0; i < c.views.size(); ++i) {
    std::vector<View> branch;  // from the root
    for (int k = static_cast<int>(i); k >= 0; k = c.parent[static_cast<std::size_t>(k)])
      branch.insert(branch.begin(), c.views[static_cast<std::size_t>(k)]);
    double gain = 0, way_m = 0;
    for (std::size_t k = 0; k < branch.size(); ++k) {
      way_m += distance_m(k == 0 ? here : branch[k - 1], branch[k]);
      double worth = 0;
      psi(std::span(branch).first(k), {&branch[k], 1}, {&worth, 1});
      gain += worth * std::exp(-0.3 * way_m);
    }
    EXPECT_NEAR(c.utilities[i], gain, 1e-12);
  }
}

TEST_F(Corridor, TheRestOfTheBestBranchBeginsTheNextTree) {
  ViewTree tree({.nodes = 60, .step_m = 0.5, .discount_per_m = 0});
  grow(tree, map, here, 5, Rightmost{});
  const std::vector<View> branch = tree.branch();
  ASSERT_GE(branch.size(), 4u);
  ViewTree other = tree, third = tree;
  const Candidates next = grow(tree, map, branch[0], 6, Rightmost{});
  for (std::size_t k = 1; k < branch.size(); ++k) {
    EXPECT_EQ(next.views[k - 1].T_W_C.matrix(), branch[k].T_W_C.matrix());
    EXPECT_EQ(next.parent[k - 1], static_cast<int>(k) - 2);
  }
  // Not if the robot went elsewhere; and only as far as it is open.
  const Candidates elsewhere = grow(other, map, here, 6, Rightmost{});
  EXPECT_NE(elsewhere.views[0].T_W_C.matrix(), branch[1].T_W_C.matrix());
  map.draw(grid.voxel_at(branch[2].position()), Space::occupied);
  const Candidates cut = grow(third, map, branch[0], 6, Rightmost{});
  EXPECT_EQ(cut.views[0].T_W_C.matrix() == branch[1].T_W_C.matrix(),
            map.navigable(grid.voxel_at(branch[1].position())));
  for (const View& v : cut.views) EXPECT_NE(v.T_W_C.matrix(), branch[2].T_W_C.matrix());
}

TEST_F(Corridor, GrowsOnWhileNothingIsWorthAnything) {
  const auto nothing = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = 0;
  };
  ViewTree tree({.nodes = 10, .max_nodes = 75});
  EXPECT_EQ(grow(tree, map, here, 1, nothing).views.size(), 75u);
  const auto far = [](Views, Views views, std::span<double> out) {
    for (std::size_t i = 0; i < views.size(); ++i) out[i] = views[i].position().x() > 6 ? 1 : 0;
  };
  const Candidates c = grow(tree, map, here, 1, far);
  EXPECT_GT(*std::max_element(c.utilities.begin(), c.utilities.end()), 0);
  EXPECT_LE(c.views.size(), 75u);
}

TEST_F(Corridor, ProposesNothingWhereItCannotGo) {
  ViewTree tree;
  for (const View& outside : {nadir(-1, 1, 1), nadir(1e300, 0, 0)})
    EXPECT_TRUE(grow(tree, map, outside, 1, Rightmost{}).views.empty());
  test::DrawnVoxels closed(grid, 0.2);
  closed.draw_all([](const Eigen::Vector3i&) { return Space::occupied; });
  for (const View& v : grow(tree, closed, here, 1, Rightmost{}).views)  // within its own voxel at most
    EXPECT_EQ(grid.voxel_at(v.position()), grid.voxel_at(here.position()));
}

TEST_F(Corridor, LeavesWhereItDoesNotFitAndDoesNotCreepOn) {
  // Around the robot nothing is known, but its own ball reaches to where it fits.
  test::DrawnVoxels narrow(grid, 0.2);
  narrow.draw_all([&](const Eigen::Vector3i& v) {
    return (grid.centre(v) - here.position()).norm() < 0.45 ? Space::unknown : Space::free;
  });
  ViewTree tree({.nodes = 50, .own_ball_m = 0.7});
  int away = 0;
  for (const View& v : grow(tree, narrow, here, 1, Rightmost{}).views) {
    const Eigen::Vector3i voxel = grid.voxel_at(v.position());
    EXPECT_TRUE(voxel == grid.voxel_at(here.position()) || narrow.navigable(voxel));
    away += narrow.navigable(voxel);
  }
  EXPECT_GT(away, 0);
}

TEST(ViewTree, KeepsToWhereItIsInABoxThatIsSmallerThanTheBody) {
  for (const double length_m : {1.2, 0.1}) {
    const VoxelMap<> box = test::tight_box(length_m, std::min(length_m, 0.4));
    ASSERT_EQ(box.counts().navigable, 0u);
    const View start = look_at(box.grid().centre({0, 0, 0}), {5, 0.05, 0.05});
    const Rightmost scorer;
    ViewTree tree;
    Rng rng(3);
    // Within the ball around the robot, which is open because the robot is there.
    for (const View& v : tree.sample(box, {.here = start}, Score(scorer), rng).views)
      EXPECT_LE(distance_m(v, start), 0.3 + 0.05 * std::sqrt(3.0) + 1e-9);
  }
}

TEST_F(Corridor, TheSameSeedTheSameBitsWithAnyNumberOfThreads) {
  const auto with_threads = [&](int n) {
    const tbb::global_control most(tbb::global_control::max_allowed_parallelism, 8);
    return tbb::task_arena(n).execute([&] {
      ViewTree tree;
      return numbers(grow(tree, map, here, 9, Rightmost{}));
    });
  };
  const std::vector<double> one = with_threads(1);
  EXPECT_EQ(one, with_threads(2));
  EXPECT_EQ(one, with_threads(8));
}

TEST_F(Corridor, GoesOnFromWhatItSaved) {
  ViewTree tree, restored;
  grow(tree, map, here, 5, Rightmost{});
  Sink sink;
  tree.save(sink);
  Source source(sink.bytes());
  restored.load(source);
  source.done();
  const View next = tree.branch().front();
  EXPECT_EQ(numbers(grow(tree, map, next, 6, Rightmost{})), numbers(grow(restored, map, next, 6, Rightmost{})));
  for (const std::size_t length : {0u, 7u, 8u, 100u}) {  // cut off: refused, and as it was
    ViewTree untouched = tree;
    Source cut(sink.bytes().first(length));
    EXPECT_THROW(untouched.load(cut), Error);
    ASSERT_EQ(untouched.branch().size(), tree.branch().size());
  }
}

struct ToTheRight {
  template <Map M>
  double operator()(const M&, const View& v) const {
    return v.position().x();
  }
};
TEST_F(Corridor, ALoopGoesThroughTheGap) {
  NbvLoop loop{map, ToTheRight{}, ViewTree{{.step_m = 0.8, .discount_per_m = 0.1}}, FirstOfBranch{}};
  archetype::World world;
  const MissionState end = loop.run(world, here, {}, Measurements{30}, ModelledClock{}, Rng{7});
  EXPECT_EQ(end.visited.size(), 30u);
  EXPECT_GT(end.here.position().x(), 6);
}

TEST(ViewTree, RefusesBadConfigs) {
  EXPECT_THROW(ViewTree({.nodes = 0}), Error);
  EXPECT_THROW(ViewTree({.nodes = 300}), Error);  // max_nodes is less
  EXPECT_THROW(ViewTree({.step_m = 0}), Error);
  EXPECT_THROW(ViewTree({.discount_per_m = -1}), Error);
  EXPECT_THROW(ViewTree({.own_ball_m = std::numeric_limits<double>::infinity()}), Error);
}

}  // namespace
}  // namespace vantage
