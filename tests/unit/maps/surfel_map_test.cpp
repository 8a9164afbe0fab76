// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The surfel map as a whole: what it learns of a furnished room, draws, gives up and refuses.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/eval/image_metrics.hpp>
#include <vantage/maps/surfel/reference_rasteriser.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/sim/rgbd_camera.hpp>
#include <vantage/sim/room.hpp>

#include "voxel_scenes.hpp"

namespace vantage::test {
namespace {

using Published = ActiveGsMap<preset::reference>;
using Written = ActiveGsMap<preset::thesis>;
constexpr float none = std::numeric_limits<float>::quiet_NaN();

static_assert(SurfelRasteriser<TileRasteriser<>> && SurfelConfidence<IncrementalConfidence>);

template <class M>
M in_small_room() {
  auto c = surfel_config<M>(small_room);
  c.voxels.voxel_m = 0.1;
  c.voxels.clearance_m = 0.15;
  c.iterations = 3;
  return M(c);
}
Published published() { return in_small_room<Published>(); }
template <class M>
std::vector<std::byte> bytes(const M& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}
template <class M>
M after(std::size_t frames, M map) {
  for (std::size_t k = 0; k < frames; ++k) {
    Rng rng(k);
    map.integrate(random_frame(Rng(11).fork(k), 40), rng);
  }
  return map;
}

/// A furnished room, seen from its start all around.
class FurnishedRoom : public testing::Test {
 protected:
  static constexpr int size_px = 96;
  const Room room = procedural_room({}, Rng(3));

  [[nodiscard]] View view(double k) const {
    const Eigen::Vector3d eye = room.scene.start->position();
    return look_at(eye + Eigen::Vector3d(0.05 * k, 0.03 * k, 0),
                   eye + Eigen::Vector3d(3 * std::cos(deg(20) * k), 3 * std::sin(deg(20) * k), -0.4));
  }
  [[nodiscard]] Frame frame(double k, bool noisy = true) const {
    RgbdConfig config{.camera = Camera::from_fov(size_px, size_px, deg(60))};
    if (!noisy) config.depth_noise = 0;
    return RgbdCamera(room.scene, config).capture(view(k), Rng(5).fork(static_cast<std::uint64_t>(10 * k)));
  }
  template <class M>
  M after(int frames) const {
    Box3 box;
    for (const Eigen::Vector3f& v : room.scene.mesh.vertices) box.extend(v.cast<double>());
    M map{surfel_config<M>(box)};
    Rng rng(1);
    for (int k = 0; k < frames; ++k) map.integrate(frame(k), rng);
    return map;
  }
};

TEST_F(FurnishedRoom, AViewThatWasNotTrainedOnIsRenderedWell) {
  Published map = after<Published>(6);
  const auto look = [&] {
    double decibels = 0, depth_m = 0;
    for (const double k : {0.5, 2.5, 4.5}) {
      const Frame truth = frame(k, false);
      Rendering<channel::Colour, channel::Depth, channel::Uncertainty> out;
      map.render(truth.view, truth.camera, out);
      decibels += psnr(static_cast<const ColourImage&>(out), truth.colour) / 3;
      std::vector<float> errors;
      for (Eigen::Index i = 0; i < out.depth.size(); ++i)
        if (const float e = std::abs(out.depth.data()[i] - truth.depth.data()[i]); !std::isnan(e)) errors.push_back(e);
      EXPECT_GT(errors.size(), 0.98 * size_px * size_px);
      std::ranges::nth_element(errors, errors.begin() + std::ssize(errors) / 2);
      depth_m += static_cast<double>(errors[errors.size() / 2]) / 3;
    }
    return std::pair(decibels, depth_m);
  };
  const auto [first_db, first_m] = look();
  EXPECT_GT(first_db, 20);
  EXPECT_LT(first_m, 0.02);  // the noise is 1 % of 2 to 4 m
  Rng rng(2);
  map.refine(20, rng);
  const auto [refined_db, refined_m] = look();
  EXPECT_GT(refined_db, 26);
  EXPECT_GT(refined_db, first_db + 2);
  EXPECT_LT(refined_m, 0.02);
}

TEST_F(FurnishedRoom, TheSameBitsWithOneAndTwoThreads) {
  const auto run = [&](int threads) {
    std::vector<std::byte> saved;
    tbb::task_arena(threads).execute([&] { saved = bytes(after<Published>(2)); });
    return saved;
  };
  EXPECT_TRUE(run(1) == run(2));
}

TEST(SurfelMap, TrainsWithTheSlowRasteriserAsWithTheFast) {
  using Slow = ActiveGsMap<preset::reference, IncrementalConfidence, ReferenceRasteriser<double>>;
  const Slow slow = after(1, in_small_room<Slow>());
  const Published fast = after(1, published());
  ASSERT_EQ(slow.surfels().size(), fast.surfels().size());
  Rendering<channel::Colour, channel::Opacity> a, b;
  const View view = slow.frames()[0].view;
  const Camera camera = slow.frames()[0].camera;
  slow.render(view, camera, a);
  fast.render(view, camera, b);
  EXPECT_LT((a.r - b.r).abs().mean(), 1e-3F);
  EXPECT_LT((a.opacity - b.opacity).abs().mean(), 1e-3F);
}

TEST(SurfelMap, BothPresetsLearn) {
  const auto check = [](const auto& map) {
    EXPECT_GT(map.surfels().size(), 100U);
    EXPECT_GT(map.coverage(), 0);
    EXPECT_EQ(map.frames().size(), 5U);
    Rendering<channel::Uncertainty> out;
    map.render(random_frame(Rng(11).fork(0), 40).view, Camera::from_fov(20, 20, deg(60)), out);
    EXPECT_LT(out.uncertainty.mean(), 1);
  };
  check(after(5, published()));
  check(after(5, in_small_room<Written>()));
}

// The numbers are those of the types, whatever else a map is made of.
TEST(SurfelMap, ConfigurationsFollowThePreset) {
  const auto thesis = [](const auto& c) {
    EXPECT_FALSE(c.densify.squared_colour_error);
    EXPECT_EQ(c.densify.most_colour_error, 0.5);
    EXPECT_FALSE(c.batch.by_error);
    EXPECT_EQ(c.prune.least_weight, 0.3);
    EXPECT_EQ(c.prune.least_opacity, 0);
  };
  const auto reference = [](const auto& c) {
    EXPECT_TRUE(c.densify.squared_colour_error);
    EXPECT_EQ(c.densify.most_colour_error, 0.25);
    EXPECT_TRUE(c.batch.by_error);
    EXPECT_EQ(c.prune.least_weight, 0.03);
    EXPECT_EQ(c.prune.least_opacity, 0.1);
  };
  using Slow = ReferenceRasteriser<double>;
  thesis(surfel_config<Written>(small_room));
  thesis(surfel_config<ActiveGsMap<preset::thesis, ViewCountConfidence>>(small_room));
  thesis(surfel_config<ActiveGsMap<preset::thesis, IncrementalConfidence, Slow>>(small_room));
  reference(surfel_config<ActiveGsMap<>>(small_room));
  reference(surfel_config<ActiveGsMap<preset::reference, DispersionConfidence, Slow>>(small_room));
}

TEST(SurfelMap, DrawsWhatTheChannelsMean) {
  const Published map = after(3, published());
  const Frame f = random_frame(Rng(11).fork(2), 40);
  Rendering<channel::Colour, channel::Depth, channel::Opacity, channel::Normal, channel::Confidence,
            channel::Uncertainty>
      all;
  map.render(f.view, f.camera, all);
  EXPECT_TRUE((all.r >= 0 && all.r <= 1 && all.g >= 0 && all.g <= 1 && all.b >= 0 && all.b <= 1).all());
  EXPECT_TRUE((all.depth.isNaN() || all.depth > 0).all());
  EXPECT_TRUE((all.opacity >= 0 && all.opacity <= 1).all());
  EXPECT_TRUE((all.confidence >= 0).all());
  EXPECT_TRUE((all.uncertainty == 1 - all.confidence.min(1.0F)).all());
  const Image<float> length = (all.x.square() + all.y.square() + all.z.square()).sqrt();
  EXPECT_TRUE((length == 0 || (length - 1).abs() < 1e-5F).all());
  // Where it is opaque, normals face the camera, and depth is about what was measured.
  float error = 0;
  int compared = 0, facing = 0;
  for (int v = 0; v < f.camera.height; ++v)
    for (int u = 0; u < f.camera.width; ++u) {
      if (!(all.opacity(v, u) > 0.5F) || std::isnan(f.depth(v, u))) continue;
      const Eigen::Vector3d ray = f.view.T_W_C.linear() * f.camera.ray(u + 0.5, v + 0.5);
      facing += ray.dot(Eigen::Vector3d(all.x(v, u), all.y(v, u), all.z(v, u))) < 0;
      error += std::abs(all.depth(v, u) - f.depth(v, u));
      ++compared;
    }
  ASSERT_GT(compared, 300);
  EXPECT_GT(facing, 0.97 * compared);
  EXPECT_LT(error / static_cast<float>(compared), 0.05F);
  // Channels alone are the same as together.
  Rendering<channel::Normal> normal;
  Rendering<channel::Uncertainty> uncertainty;
  map.render(f.view, f.camera, normal);
  map.render(f.view, f.camera, uncertainty);
  EXPECT_TRUE((normal.x == all.x).all() && (uncertainty.uncertainty == all.uncertainty).all());
}

TEST(SurfelMap, NothingIsKnownAtFirst) {
  const Published map = published();
  Rendering<channel::Colour, channel::Depth, channel::Uncertainty, channel::Normal> out;
  map.render(look_at({0, 0, 1}, {1, 0, 1}), Camera::from_fov(8, 6, deg(60)), out);
  EXPECT_TRUE((out.uncertainty == 1).all() && out.depth.isNaN().all() && (out.r == 0).all() && (out.x == 0).all());
  EXPECT_TRUE(map.regions(low_confidence{}).empty());
  EXPECT_EQ(map.parameters(), 0U);
  Published other = map;
  Rng rng(1);
  other.refine(3, rng);
  EXPECT_EQ(bytes(other), bytes(map));
}

TEST(SurfelMap, AFrameWithoutDepthChangesTheVoxelsAlone) {
  Published map = after(2, published());
  const Surfels before = map.surfels();
  Frame f = random_frame(Rng(11).fork(2), 40);
  f.depth.setConstant(none);
  Rng rng(1);
  map.integrate(f, rng);
  f.depth.setConstant(7);  // beyond what the sensor is trusted with
  map.integrate(f, rng);
  EXPECT_EQ(map.frames().size(), 2U);
  for (std::size_t p = 0; p < surfel::parameters; ++p) EXPECT_EQ(map.surfels().parameter[p], before.parameter[p]);
}

TEST(SurfelMap, RefusesWithoutChange) {
  Published map = after(1, published());
  const auto before = bytes(map);
  const Frame good = random_frame(Rng(11).fork(1), 40);
  std::vector<Frame> bad(7, good);
  bad[0].colour = {};
  bad[1].depth.resize(0, 0);
  bad[2].colour.r(3, 4) = 2;
  bad[3].colour.g(3, 4) = none;
  bad[4].depth(2, 2) = -1;
  bad[5].depth.setOnes(3, 4);
  bad[6].view.T_W_C.linear() *= 1.1;
  for (const Frame& f : bad) {
    Rng rng(1);
    EXPECT_THROW(map.check(f), Error);
    EXPECT_THROW(map.integrate(f, rng), Error);
    EXPECT_EQ(bytes(map), before);
  }
  Published::Config small = map.config();
  small.max_bytes = 10000;
  EXPECT_THROW(Published(small).check(good), Error);
  std::vector<double> few(3);
  EXPECT_THROW(map.fisher(good.view, good.camera, few), Error);
}

TEST(SurfelMap, BadConfigurationsAreNamed) {
  const auto refuses = [](auto&& spoil) {
    Published::Config c = surfel_config<Published>(small_room);
    spoil(c);
    EXPECT_THROW(Published{c}, Error);
  };
  refuses([](auto& c) { c.far_m = 0; });
  refuses([](auto& c) { c.iterations = -1; });
  refuses([](auto& c) { c.scale.unit_m = -1; });
  refuses([](auto& c) { c.densify.spacing_m = 0; });
  refuses([](auto& c) { c.batch.newest = 0; });
  refuses([](auto& c) { c.loss.depth = std::numeric_limits<double>::infinity(); });
  refuses([](auto& c) { c.rates.position = -1; });
  refuses([](auto& c) { c.prune.every_frames = 0; });
  refuses([](auto& c) { c.low_confidence.opacity = 1; });
  refuses([](auto& c) { c.voxels.bounds = Box3(); });
  const Eigen::Vector3d low = small_room.min(), high = small_room.max();
  for (const double bad : {low.z(), static_cast<double>(none), std::numeric_limits<double>::infinity()})
    refuses([&](auto& c) { c.voxels.bounds = Box3(low, Eigen::Vector3d(high.x(), high.y(), bad)); });
}

TEST(SurfelMap, FisherInformationIsOfWhatIsSeen) {
  const Published map = after(2, published());
  std::vector<double> diagonal(map.parameters());
  map.fisher(map.frames()[0].view, map.frames()[0].camera, diagonal);
  std::size_t informed = 0;
  for (std::size_t i = 0; i < map.surfels().size(); ++i) informed += diagonal[surfel::parameters * i + surfel::red] > 0;
  EXPECT_GT(informed, map.surfels().size() / 4);
}

TEST(Prune, KeepsWhatIsSeenAndOpaqueInOrder) {
  Surfels s;
  std::vector<float> state, weight;
  for (int i = 0; i < 10; ++i) {
    Surfel one;
    one.parameter[surfel::x] = static_cast<float>(i);
    one.parameter[surfel::logit] = i == 4 ? -3.0F : i == 5 ? none : 1.0F;
    one.confidence = static_cast<float>(i);
    s.push_back(one);
    state.push_back(static_cast<float>(i)), state.push_back(static_cast<float>(-i));
    weight.push_back(i == 2 ? 0.03F : i == 9 ? none : 0.5F);
  }
  EXPECT_EQ(prune(s, state, 2, weight, {}), 4U);
  EXPECT_EQ(s.confidence, (std::vector<float>{0, 1, 3, 6, 7, 8}));
  EXPECT_EQ(s.parameter[surfel::x], s.confidence);
  EXPECT_EQ(state, (std::vector<float>{0, 0, 1, -1, 3, -3, 6, -6, 7, -7, 8, -8}));
}

}  // namespace
}  // namespace vantage::test
