// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A frame of 512 x 512 px, 60 degrees, from the inside of a home: colour with mipmapped textures, depth with noise and
// labels. Its yardstick are the same rays through the same packets of 16, and nothing else: peak_share = time of those
// / time of the frame, measured in turn; items are rays. Scenes: a procedural room of 300 k triangles, all of it
// textured (sim/*/512), and an apartment of 210 k triangles if it is there (sim/*/512/home).
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "peak.hpp"

#include <vantage/core/parallel.hpp>
#include <vantage/io/scene_file.hpp>
#include <vantage/sim/rgbd_camera.hpp>
#include <vantage/sim/room.hpp>

namespace {

using namespace vantage;

struct Home {
  explicit Home(const Scene& scene) : camera(scene) {
    const Eigen::Vector3d eye = scene.start->position();
    for (int k = 0; k < 8; ++k) {
      const double heading_rad = deg(45.0 * k);
      views.push_back(look_at(eye, eye + Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), -0.15)));
    }
  }
  RgbdCamera camera;
  std::vector<View> views;  ///< all around
};

const Home& room() {
  static const Home home(procedural_room({.edge_m = 0.04}, Rng(1)).scene);
  return home;
}
const Home* apartment() {
  const std::filesystem::path folder = std::filesystem::path(VANTAGE_DATA_DIR) / "scenes" / "2BedroomApartment";
  static const std::unique_ptr<const Home> home =
      std::filesystem::exists(folder) ? std::make_unique<const Home>(read_scene(folder)) : nullptr;
  return home.get();
}

// Nothing but rays, in blocks of 32 x 32 px.
void cast_all(const Home& home, const View& view) {
  const Camera& camera = home.camera.config().camera;
  const Eigen::Matrix3d axes = view.T_W_C.linear();
  const Eigen::Vector3f right = (axes.col(0) / camera.fx).cast<float>(), down = (axes.col(1) / camera.fy).cast<float>(),
                        forward = axes.col(2).cast<float>();
  const int blocks = camera.width / 32;
  RayPacket::Lanes lane_x, lane_y;
  for (int k = 0; k < RayPacket::size; ++k) {
    lane_x[k] = static_cast<float>(k % 8 + 0.5 - camera.cx);
    lane_y[k] = static_cast<float>(k / 8 + 0.5 - camera.cy);
  }
  parallel_for(static_cast<std::size_t>(blocks * camera.height / 32), [&](std::size_t i) {
    const int left = static_cast<int>(i) % blocks * 32, top = static_cast<int>(i) / blocks * 32;
    RayPacket p;
    p.origin = view.position().cast<float>();
    for (int row = top; row < top + 32; row += 2)
      for (int column = left; column < left + 32; column += 8) {
        const RayPacket::Lanes x = lane_x + static_cast<float>(column), y = lane_y + static_cast<float>(row);
        p.direction_x = forward.x() + x * right.x() + y * down.x();
        p.direction_y = forward.y() + x * right.y() + y * down.y();
        p.direction_z = forward.z() + x * right.z() + y * down.z();
        home.camera.renderer().rays().cast(p);
        benchmark::DoNotOptimize(p.distance.data());
      }
  });
}

std::int64_t pixels(const Home& home) {
  const Camera& camera = home.camera.config().camera;
  return std::int64_t{camera.width} * camera.height;
}

void rays(benchmark::State& state, const Home* home) {
  if (!home) return state.SkipWithError("no such scene: VANTAGE_DATA_DIR");
  std::size_t k = 0;
  for (auto _ : state) cast_all(*home, home->views[k++ % home->views.size()]);
  state.SetItemsProcessed(state.iterations() * pixels(*home));
}

void rgbd(benchmark::State& state, const Home* home) {
  if (!home) return state.SkipWithError("no such scene: VANTAGE_DATA_DIR");
  Frame frame;
  double frames_s = 0, rays_s = 0;
  std::size_t k = 0;
  for (auto _ : state) {
    const View& view = home->views[k++ % home->views.size()];
    frames_s += bench::seconds([&] { home->camera.capture(view, Rng(1), frame); });
    state.PauseTiming();
    rays_s += bench::seconds([&] { cast_all(*home, view); });
    state.ResumeTiming();
  }
  state.counters["peak_share"] = rays_s / frames_s;
  state.SetItemsProcessed(state.iterations() * pixels(*home));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto add = [](const std::string& name, auto kernel, auto home) {
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { kernel(state, home()); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  const auto in_room = [] { return &room(); };
  add("sim/rays/512", rays, in_room);
  add("sim/rgbd/512", rgbd, in_room);
  if (apartment()) {
    add("sim/rays/512/home", rays, apartment);
    add("sim/rgbd/512/home", rgbd, apartment);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
