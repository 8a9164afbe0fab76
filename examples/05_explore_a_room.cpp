// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
//
// A robot with a depth camera in a room that it does not know: it maps voxels, flies only through space that it knows
// to be free, and looks where the known world ends, until it ends nowhere.
#include <cstdio>

#include <vantage/sim/rgbd_world.hpp>
#include <vantage/sim/room.hpp>
#include <vantage/vantage.hpp>

using namespace vantage;

int main() {
  const Room room = procedural_room({.pieces = 8}, Rng{3});
  const RgbdConfig sensor{.camera = Camera::from_fov(160, 120, deg(75))};
  RgbdWorld world(room.scene, Rng{1}, sensor);
  const View start = *room.scene.start;

  VoxelMap<> map({.bounds = room.scene.mesh.bounds(),
                  .voxel_m = 0.1,
                  .clearance_m = 0.2,
                  // The sensor says nothing about what is beyond its range: all that is nearer is free then.
                  .range = {.max_m = sensor.max_depth_m, .no_return_m = sensor.max_depth_m}});
  // What utilities render may be coarser than what the sensor measures.
  const Unexplored unexplored({.camera = Camera::from_fov(80, 60, deg(75)), .far_m = sensor.max_depth_m});
  NbvLoop loop{std::move(map), unexplored, Frontier{}, TravelTradeoff{Shortcut{AStar{}}}};

  const MissionState end = loop.run(world, start, look_all_around(start, deg(75)), MissionTime{300},
                                    ModelledClock{{.mapping_s = 0.01, .planning_s = 0.1}}, Rng{7});

  std::printf("%zu views, %.0f m of flight, %.1f %% of the voxels explored\n", end.visited.size(), end.travelled_m,
              100 * loop.map.coverage());
}
