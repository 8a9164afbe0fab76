// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/voxel/render_voxels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

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
      render_voxels(map, Sensor(), NoClasses(), range, view, camera, out);
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
  render_voxels(map, Sensor(), NoClasses(), 5, views[0], camera, both);
  render_voxels(map, Sensor(), NoClasses(), 5, views[0], camera, depth);
  render_voxels(map, Sensor(), NoClasses(), 5, views[0], camera, gain);
  EXPECT_TRUE((both.information_gain == gain.information_gain).all());
  EXPECT_TRUE(((both.depth == depth.depth) || (both.depth.isNaN() && depth.depth.isNaN())).all());
}

TEST(RenderVoxels, UnknownSpaceHasTwiceTheEntropyOfAVoxel) {
  const DrawnLogOdds map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(9, 9, 9)}, 0.1));
  Rendering<channel::Entropy, channel::Depth> out;
  render_voxels(map, Sensor(), NoClasses(), 100, look_at({4.5, 4.5, 4.5}, {9, 5, 5}), camera, out);
  for (Eigen::Index i = 0; i < out.entropy.size(); ++i) EXPECT_NEAR(out.entropy(i), 2 * std::numbers::ln2, 1e-4);
  EXPECT_TRUE(out.depth.isNaN().all());
}

TEST(RenderVoxels, ACameraInsideOfSomethingSeesItAtOnce) {
  DrawnLogOdds map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)}, 0.1));
  map.set({5, 5, 5}, 3);
  Rendering<channel::Depth> out;
  render_voxels(map, Sensor(), NoClasses(), 100, look_at({0.55, 0.55, 0.55}, {1, 0.5, 0.5}), camera, out);
  EXPECT_TRUE((out.depth == std::numeric_limits<float>::min()).all());
}

TEST(RenderVoxels, ThreadsDoNotMatter) {
  const DrawnLogOdds map = random_map();
  const auto draw = [&] {
    Rendering<channel::Entropy, channel::InformationGain> out;
    render_voxels(map, Sensor(), NoClasses(), 5, views[0], camera, out);
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
  EXPECT_THROW(render_voxels(map, Sensor(), NoClasses(), 5, view, camera, out), Error);
  EXPECT_THROW(render_voxels(map, Sensor(), NoClasses(), 5, views[0], Camera{}, out), Error);
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

/// What a map with classes draws, voxel by voxel along a ray and in double precision, by what it says of voxels.
template <class M>
std::vector<double> slow_classes(const M& map, const View& view, const Camera& from, int row, int column) {
  constexpr std::size_t n = std::tuple_size_v<decltype(map.class_counts({}))>;
  std::vector<double> of_class(n);
  double visibility = 1;
  for (GridRay ray(map.grid(), view.position(), view.T_W_C.linear() * from.ray(column + 0.5, row + 0.5));
       ray && ray.enter() <= map.config().range.max_m; ray.step()) {
    const double p = map.probability(ray.voxel()), prior = map.config().semantics.prior;
    const auto counts = map.class_counts(ray.voxel());
    const double all = std::accumulate(counts.begin(), counts.end(), 0.0) + static_cast<double>(n) * prior;
    for (std::size_t c = 0; c < n; ++c) {
      const double of_voxel = (counts[c] + prior) / all;
      EXPECT_NEAR(map.class_probability(ray.voxel(), static_cast<std::uint16_t>(c)), of_voxel, 1e-12);
      of_class[c] += visibility * p * of_voxel;
    }
    visibility *= 1 - p;
  }
  of_class[0] += visibility;
  return of_class;
}
template <class Update>
void expect_slow_classes(double range_m, double prior) {
  using M = VoxelMap<Update, ClassCounts<5>>;
  typename M::Config config{.bounds = test::small_room, .voxel_m = 0.13, .clearance_m = 0.1, .semantics = {prior}};
  config.range.max_m = range_m;
  M map(config);
  const auto expect_drawn = [&] {
    double seen = 0;
    for (const View& view : {test::random_frame(Rng(4)).view, test::random_frame(Rng(7).fork(1)).view, views[1]}) {
      Rendering<channel::Semantics> out;
      map.render(view, camera, out);
      ASSERT_EQ(out.probability.size(), 5U);
      for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column) {
          const std::vector<double> slow = slow_classes(map, view, camera, row, column);
          for (std::size_t c = 0; c < 5; ++c) ASSERT_NEAR(out.probability[c](row, column), slow[c], 2e-5);
          for (std::size_t c = 1; c < 5; ++c) seen = std::max(seen, slow[c] - slow[0]);
        }
    }
    EXPECT_EQ(seen > 0.02, map.counts().explored > 0) << "of what was seen the class is known better";
  };
  expect_drawn();
  for (std::uint64_t k = 0; k < 8; ++k) map.integrate(test::random_frame(Rng(7).fork(k)));
  expect_drawn();
}
TEST(RenderVoxels, ClassesAreWhatSlowRaysMeet) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expect_slow_classes<RayCast>(infinity, 0.2);
  expect_slow_classes<RayCast>(0.9, 3);
  expect_slow_classes<Projective>(infinity, 1e-6);
}

TEST(RenderVoxels, ClassesOfOneVoxelByHand) {
  using M = VoxelMap<RayCast, ClassCounts<4>>;
  M map({.bounds = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.2, 0.2, 0.2)}, .clearance_m = 0, .semantics = {0.5}});
  Frame f;
  f.camera = Camera::from_fov(4, 4, deg(10));
  f.view = look_at({-1, 0.1, 0.1}, {1, 0.1, 0.1});
  f.depth.setConstant(4, 4, 1.1F);
  f.labels.setConstant(4, 4, 2);
  f.labels.row(0) = 0;
  f.labels(3, 3) = 3;
  map.integrate(f);
  ASSERT_EQ(map.class_counts({0, 0, 0}), (std::array<std::uint32_t, 4>{0, 0, 11, 1}));
  const std::array<double, 4> expected = {0.5 / 14, 0.5 / 14, 11.5 / 14, 1.5 / 14};
  Rendering<channel::Semantics> at, away;
  map.render(f.view, f.camera, at);
  map.render(look_at({-1, 0.1, 0.1}, {-2, 0.1, 0.1}), f.camera, away);
  const double p = probability(0.85);
  for (std::uint16_t c = 0; c < 4; ++c) {
    EXPECT_NEAR(map.class_probability({0, 0, 0}, c), expected[c], 1e-12);
    EXPECT_EQ(map.class_probability({1, 0, 0}, c), 0.25) << "nothing is known outside of the grid";
    EXPECT_NEAR(at.probability[c](1, 1), p * expected[c] + (c == 0 ? 1 - p : 0), 1e-5);
    EXPECT_TRUE((away.probability[c] == (c == 0 ? 1.0F : 0.0F)).all()) << "nothing is met";
  }
  EXPECT_EQ(map.label({0, 0, 0}), 2);
}

TEST(RenderVoxels, TheLikeliestClassIsTheOneThatIsThere) {
  // Behind two metres of voxels that were passed once, each of which may well be occupied.
  using M = VoxelMap<RayCast, ClassCounts<6>>;
  M map({.bounds = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 1, 1)}, .clearance_m = 0});
  Frame f;
  f.camera = Camera::from_fov(20, 20, deg(10));
  f.view = look_at({0.1, 0.5, 0.5}, {9, 0.5, 0.5});
  f.depth.setConstant(20, 20, 2.0F);
  f.labels.setConstant(20, 20, 4);
  const auto likeliest = [&] {
    Rendering<channel::Semantics> out;
    map.render(f.view, f.camera, out);
    std::size_t most = 0;
    for (std::size_t c = 1; c < 6; ++c)
      if (out.probability[c](10, 10) > out.probability[most](10, 10)) most = c;
    return most;
  };
  EXPECT_EQ(likeliest(), 0U);
  map.integrate(f);
  EXPECT_EQ(likeliest(), 4U);
}

TEST(RenderVoxels, ClassesAreDrawnTogetherWithAllElseAndByAnyNumberOfThreads) {
  using M = VoxelMap<RayCast, ClassCounts<5>>;
  M map({.bounds = test::small_room, .voxel_m = 0.1, .clearance_m = 0.1});
  for (std::uint64_t k = 0; k < 4; ++k) map.integrate(test::random_frame(Rng(7).fork(k)));
  const View view = test::random_frame(Rng(7)).view;
  Rendering<channel::Semantics> alone;
  test::with_threads(1, [&] { map.render(view, camera, alone); });
  Rendering<channel::Depth, channel::Entropy> others;
  map.render(view, camera, others);
  for (const int n : {1, 2, 4}) {
    Rendering<channel::Semantics, channel::InformationGain, channel::Depth, channel::Entropy> all;
    test::with_threads(n, [&] { map.render(view, camera, all); });
    for (std::size_t c = 0; c < 5; ++c) EXPECT_TRUE((all.probability[c] == alone.probability[c]).all());
    EXPECT_TRUE((all.entropy == others.entropy).all());
    EXPECT_TRUE(((all.depth == others.depth) || (all.depth.isNaN() && others.depth.isNaN())).all());
  }
}

TEST(RenderVoxels, ThePriorOfClassesIsChecked) {
  VoxelMap<RayCast, ClassCounts<5>>::Config config{.bounds = test::small_room};
  for (const double bad : {0.0, -1.0, 1e7, std::nan("")}) {
    config.semantics.prior = bad;
    EXPECT_REFUSED((VoxelMap<RayCast, ClassCounts<5>>(config)), "prior");
  }
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
