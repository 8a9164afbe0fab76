// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/voxel/render_voxels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "contract/suite.hpp"
#include "drawn_voxels.hpp"
#include "message_of.hpp"
#include "voxel_scenes.hpp"

namespace vantage {
namespace {

/// Drawn voxels with log-odds, in blocks that can be pointed to.
class DrawnLogOdds : public test::DrawnVoxels {
 public:
  struct Block {
    VoxelBits free, occupied;
    std::array<float, 512> log_odds{};
  };
  explicit DrawnLogOdds(const VoxelGrid& grid) : DrawnVoxels(grid, 0.1) {}
  void set(const Eigen::Vector3i& voxel, float log_odds) {
    const Space space = log_odds > 1 ? Space::occupied : log_odds < -1 ? Space::free : Space::unknown;
    draw(voxel, space);
    const Eigen::Vector3i b = block_of(voxel);
    Block& block = blocks_[{b.x(), b.y(), b.z()}];
    block.log_odds[local_of(voxel)] = log_odds;
    if (space == Space::occupied) block.occupied.set(local_of(voxel));
    if (space == Space::free) block.free.set(local_of(voxel));
  }
  [[nodiscard]] const Block* block(const Eigen::Vector3i& b) const {
    const auto found = blocks_.find({b.x(), b.y(), b.z()});
    return found == blocks_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] double log_odds(const Eigen::Vector3i& voxel) const {
    const Block* b = block(block_of(voxel));
    return b ? static_cast<double>(b->log_odds[local_of(voxel)]) : 0;
  }

 private:
  std::map<std::tuple<int, int, int>, Block> blocks_;
};

struct Sensor {
  [[nodiscard]] float after_hit(float l, float distance_m) const { return std::min(l + 0.9F / (1 + distance_m), 3.5F); }
  [[nodiscard]] float after_pass(float l, float) const { return std::max(l - 0.4F, -2.0F); }
};

/// Some blocks unknown, some free, walls here and there.
DrawnLogOdds random_map() {
  Rng rng(5);
  DrawnLogOdds map(VoxelGrid::dividing({Eigen::Vector3d(-2, -2.1, 0), Eigen::Vector3d(2, 2, 2.5)}, 0.15));
  const Eigen::Vector3i n = map.grid().size();
  for (int z = 0; z < n.z(); ++z)
    for (int y = 0; y < n.y(); ++y)
      for (int x = 0; x < n.x(); ++x) {
        const Eigen::Vector3i v(x, y, z);
        if ((block_of(v).x() + block_of(v).y() + block_of(v).z()) % 3 == 1) continue;
        map.set(v, static_cast<float>(rng.index(25) == 0 ? rng.uniform(0, 3.5) : rng.uniform(-2, 0)));
      }
  return map;
}
const std::vector<View> views = {look_at({-1.5, -1.5, 1.2}, {1, 0.5, 1}), look_at({4, 3, 2}, {0, 0, 1}),
                                 nadir(0.3, 0.1, 2.4), look_at({0, 0, 5}, {0, 0, 9})};
const Camera camera = Camera::from_fov(37, 21, deg(70));

double probability(double l) { return 1 / (1 + std::exp(-l)); }
double entropy(double l) {
  const double p = probability(l);
  return -p * std::log(p) - (1 - p) * std::log(1 - p);
}
/// Voxel by voxel, in double precision, to the end.
struct Slow {
  double depth = std::numeric_limits<double>::quiet_NaN(), entropy_nats = 0, gain = 0, reach = 0;
  Slow(const DrawnLogOdds& map, const View& view, int row, int column, double range_m) {
    const Eigen::Vector3d from = view.position();
    double visibility = 1;
    for (GridRay ray(map.grid(), from, view.T_W_C.linear() * camera.ray(column + 0.5, row + 0.5)); ray; ray.step()) {
      const double l = map.log_odds(ray.voxel()), p = probability(l);
      if (std::isnan(depth) && map.state(ray.voxel()) == Space::occupied) depth = ray.enter();
      if (ray.enter() > range_m) continue;
      const auto distance = static_cast<float>((map.grid().centre(ray.voxel()) - from).norm());
      const auto f = static_cast<float>(l);
      gain += visibility * (1 - p) * (entropy(l) - entropy(static_cast<double>(Sensor().after_pass(f, distance))));
      gain += visibility * p * (entropy(l) - entropy(static_cast<double>(Sensor().after_hit(f, distance))));
      entropy_nats += visibility * entropy(l);
      reach += visibility;
      visibility *= 1 - p;
    }
  }
};

TEST(RenderVoxels, IsWhatSlowRaysGather) {
  const DrawnLogOdds map = random_map();
  int hits = 0, misses = 0;
  for (const double range : {1.3, std::numeric_limits<double>::infinity()})
    for (const View& view : views) {
      Rendering<channel::Depth, channel::Entropy, channel::Uncertainty, channel::InformationGain> out;
      render_voxels(map, Sensor(), range, view, camera, out);
      for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column) {
          const Slow slow(map, view, row, column, range);
          const float depth = out.depth(row, column);
          ASSERT_EQ(std::isnan(depth), std::isnan(slow.depth));
          if (!std::isnan(depth)) {
            ASSERT_EQ(depth, std::max(static_cast<float>(slow.depth), std::numeric_limits<float>::min()));
          }
          ++(std::isnan(depth) ? misses : hits);
          ASSERT_NEAR(out.entropy(row, column), slow.entropy_nats, 3e-4);
          ASSERT_NEAR(out.information_gain(row, column), slow.gain, 3e-4);
          ASSERT_NEAR(out.uncertainty(row, column), slow.reach > 0 ? slow.entropy_nats / slow.reach : 0, 3e-4);
        }
    }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 100);
}

TEST(RenderVoxels, AChannelAloneIsAsItIsAmongOthers) {
  const DrawnLogOdds map = random_map();
  Rendering<channel::Depth, channel::InformationGain> both;
  Rendering<channel::Depth> depth;
  Rendering<channel::InformationGain> gain;
  render_voxels(map, Sensor(), 5, views[0], camera, both);
  render_voxels(map, Sensor(), 5, views[0], camera, depth);
  render_voxels(map, Sensor(), 5, views[0], camera, gain);
  EXPECT_TRUE((both.information_gain == gain.information_gain).all());
  EXPECT_TRUE(((both.depth == depth.depth) || (both.depth.isNaN() && depth.depth.isNaN())).all());
}

TEST(RenderVoxels, UnknownSpaceHasTwiceTheEntropyOfAVoxel) {
  const DrawnLogOdds map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(9, 9, 9)}, 0.1));
  Rendering<channel::Entropy, channel::Depth> out;
  render_voxels(map, Sensor(), 100, look_at({4.5, 4.5, 4.5}, {9, 5, 5}), camera, out);
  for (Eigen::Index i = 0; i < out.entropy.size(); ++i) EXPECT_NEAR(out.entropy(i), 2 * std::numbers::ln2, 1e-4);
  EXPECT_TRUE(out.depth.isNaN().all());
}

TEST(RenderVoxels, ACameraInsideOfSomethingSeesItAtOnce) {
  DrawnLogOdds map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)}, 0.1));
  map.set({5, 5, 5}, 3);
  Rendering<channel::Depth> out;
  render_voxels(map, Sensor(), 100, look_at({0.55, 0.55, 0.55}, {1, 0.5, 0.5}), camera, out);
  EXPECT_TRUE((out.depth == std::numeric_limits<float>::min()).all());
}

TEST(RenderVoxels, ThreadsDoNotMatter) {
  const DrawnLogOdds map = random_map();
  const auto draw = [&] {
    Rendering<channel::Entropy, channel::InformationGain> out;
    render_voxels(map, Sensor(), 5, views[0], camera, out);
    return out;
  };
  const auto one = test::with_threads(1, draw);
  for (const int n : {2, 4}) {
    const auto several = test::with_threads(n, draw);
    EXPECT_TRUE((several.entropy == one.entropy).all());
    EXPECT_TRUE((several.information_gain == one.information_gain).all());
  }
}

TEST(RenderVoxels, BadViewsAreRefused) {
  const DrawnLogOdds map = random_map();
  View view = views[0];
  view.T_W_C.translation().x() = std::nan("");
  Rendering<channel::Depth> out;
  EXPECT_THROW(render_voxels(map, Sensor(), 5, view, camera, out), Error);
  EXPECT_THROW(render_voxels(map, Sensor(), 5, views[0], Camera{}, out), Error);
}

/// That a map says of one voxel what it does to a whole block, and draws what its voxels say.
template <class Update>
void expect_own_sensor() {
  VoxelMap<Update> map({.bounds = test::small_room, .voxel_m = 0.1, .clearance_m = 0.1});
  const VoxelMap<Update> before = map;
  const Frame frame = test::random_frame(Rng(3));
  map.integrate(frame);
  const auto sensor = map.config().update.one_voxel();
  int hit = 0, passed = 0;
  const Eigen::Vector3i n = map.grid().size();
  for (int z = 0; z < n.z(); ++z)
    for (int y = 0; y < n.y(); ++y)
      for (int x = 0; x < n.x(); ++x) {
        const Eigen::Vector3i v(x, y, z);
        if (!map.explored(v)) continue;
        const auto distance = static_cast<float>((map.grid().centre(v) - frame.view.position()).norm());
        const float l = map.log_odds(v);
        ++(l > 0 ? hit : passed);
        ASSERT_NEAR(l, l > 0 ? sensor.after_hit(0, distance) : sensor.after_pass(0, distance), 1e-5);
      }
  EXPECT_GT(hit, 100);
  EXPECT_GT(passed, 100);

  Rendering<channel::Depth, channel::InformationGain, channel::Uncertainty> seen, unseen;
  map.render(frame.view, frame.camera, seen);
  before.render(frame.view, frame.camera, unseen);
  EXPECT_TRUE(unseen.depth.isNaN().all());
  EXPECT_LT((seen.depth.isNaN()).count(), seen.depth.size() / 20);
  EXPECT_LT(seen.information_gain.mean(), unseen.information_gain.mean());
  EXPECT_LT(seen.uncertainty.mean(), unseen.uncertainty.mean());
  EXPECT_NEAR(unseen.uncertainty.maxCoeff(), std::numbers::ln2_v<float>, 1e-6F);
  EXPECT_GT(unseen.information_gain.minCoeff(), 0);
}
TEST(RenderVoxels, AVoxelMapsOwnSensor) {
  expect_own_sensor<RayCast>();
  expect_own_sensor<Projective>();
}

TEST(OccupancyTable, IsTheLogisticFunctionAndItsEntropy) {
  const OccupancyTable& table = OccupancyTable::shared();
  EXPECT_EQ(table(0).probability, 0.5F);
  EXPECT_EQ(table(0).entropy, std::numbers::ln2_v<float>);
  Rng rng(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto l = static_cast<float>(rng.uniform(-16, 16));
    ASSERT_NEAR(table(l).probability, probability(static_cast<double>(l)), 4e-6);
    ASSERT_NEAR(table(l).entropy, entropy(static_cast<double>(l)), 1e-5);
  }
  for (const float l : {-16.0F, 16.0F}) EXPECT_NEAR(table(l).entropy, entropy(static_cast<double>(l)), 1e-6);
  EXPECT_EQ(table(1e30F).entropy, table(16).entropy);
  EXPECT_EQ(table(-1e30F).probability, table(-16).probability);
}

}  // namespace
}  // namespace vantage
