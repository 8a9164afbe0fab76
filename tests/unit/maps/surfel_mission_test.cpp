// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A mission with surfels whose camera fails now and then.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include <vantage/core/units.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/skip_refused.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/sampler/roi_and_local.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/sim/rgbd_camera.hpp>
#include <vantage/sim/room.hpp>
#include <vantage/utility/confidence_exploration.hpp>

namespace vantage::test {
namespace {

constexpr std::size_t first = 4, without_depth = 4, lost = 5, cut = 6, in_the_wall = 7, all = 11;

/// Which of its frames are bad is known by their number.
struct FailingCamera {
  RgbdCamera camera;
  Box3 room;
  std::size_t taken = 0;

  std::optional<Frame> observe(const View& view) {
    Frame f = camera.capture(view, Rng(5).fork(taken));
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    if (taken == without_depth) f.depth.setConstant(none);
    if (taken == lost) f.view.T_W_C.translation().x() = std::numeric_limits<double>::quiet_NaN();
    if (taken == cut) f.depth.conservativeResize(f.depth.rows() / 2, f.depth.cols());
    if (taken == in_the_wall) f.view.T_W_C.translation().x() = room.max().x() - 0.12;  // walls overlap in corners
    ++taken;
    return f;
  }
};

struct Sizes {
  std::vector<std::size_t> step = {};
  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>& s) {
    step.push_back(s.index);
  }
};

TEST(SurfelMission, GoesOnWhereItCan) {
  const Scene scene = procedural_room({}, Rng(3)).scene;
  const Box3 box = scene.mesh.bounds();
  FailingCamera world{.camera = RgbdCamera(scene, {.camera = Camera::from_fov(64, 64, deg(90))}), .room = box};
  auto config = surfel_config<ActiveGsMap<>>(box);
  config.iterations = 2;
  const ConfidenceExploration<> utility({.camera = Camera::from_fov(32, 32, deg(90))});
  NbvLoop loop{ActiveGsMap<>(config), utility, RoiAndLocal<frontier, low_confidence>{}, TravelTradeoff{AStar{}}};

  std::vector<View> around;
  const Eigen::Vector3d eye = scene.start->position();
  for (std::size_t k = 0; k < first; ++k) {
    const double yaw_rad = deg(90) * static_cast<double>(k);
    around.push_back(look_at(eye, eye + Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), -0.2)));
  }
  std::ostringstream log;
  SkipRefused skip(log);
  Sizes told;
  const MissionState end =
      loop.run(world, *scene.start, around, Measurements(all), ModelledClock{}, Rng(7), skip, told);
  EXPECT_EQ(end.visited.size(), all) << log.str();
  EXPECT_EQ(skip.steps().size(), 2U) << log.str();
  EXPECT_NE(log.str().find("view 6 refused"), std::string::npos) << log.str();
  EXPECT_NE(log.str().find("view 7 refused"), std::string::npos) << log.str();
  EXPECT_EQ(told.step, (std::vector<std::size_t>{1, 2, 3, 4, 5, 8, 9, 10, 11}));
  EXPECT_EQ(end.visited[in_the_wall].position().x(), box.max().x() - 0.12);
  EXPECT_GT(loop.map.surfels().size(), 1000U);
}

}  // namespace
}  // namespace vantage::test
