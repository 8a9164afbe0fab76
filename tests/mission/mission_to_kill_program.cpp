// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A mission that crash_test.cpp kills and starts again: mission_to_kill_program toy|field FOLDER. It goes on from the
// checkpoint in the folder if there is one, and leaves mission.json and map.bytes.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vantage/eval/field_metrics.hpp>
#include <vantage/io/file.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/mission/checkpoint.hpp>
#include <vantage/mission/recorder.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/utility/variance_reduction.hpp>
#include <vector>

#include "toy/mission.hpp"

namespace {

using namespace vantage;

template <class Loop, class World, class Stop, class Metrics>
void fly(const std::filesystem::path& folder, Loop loop, World world, const View& start, const Stop& stop,
         Metrics metrics) {
  ModelledClock clock;
  MissionState state{.here = start, .rng = Rng(5)};
  Recorder recorder(RecorderConfig{.file = folder / "mission.json", .seed = 5, .write_every_s = 0}, metrics);
  Checkpoint checkpoint(CheckpointConfig{.file = folder / "mission.checkpoint"}, recorder);
  checkpoint.load(loop, world, clock, state);
  loop.resume(world, state, {}, stop, clock, recorder, checkpoint);
  write_file(folder / "map.bytes", checkpoint_bytes(loop.map));
}

void fly_toy(const std::filesystem::path& folder) {
  // A map of some size, so that writing it takes a while.
  fly(folder, toy::toy_loop(64), toy::ToyWorld{}, nadir(4, 4, 2), Measurements{150}, [](const toy::ToyMap& map) {
    return std::vector<Metric>{{"variance", map.total_variance()}};
  });
}

void fly_field(const std::filesystem::path& folder) {
  const ScalarField truth = random_field(Rng(3), {.columns = 64, .rows = 64});
  const auto metrics = [&](const auto& map) {
    const FieldMetrics m = field_metrics(map, truth, map.interest());
    return std::vector<Metric>{{"rmse", m.rmse}, {"iou", m.iou}, {"cells", static_cast<double>(m.cells)}};
  };
  fly(folder,
      NbvLoop{IntegralGp<>({.tree = {.depth = 4}, .prior_mean = 0.7}), VarianceReduction{},
              Lattice{Lattice::reference()}, PerFlightTime{}},
      FieldWorld(truth, VarianceByHeight{}, Rng(9)), nadir(0, 0, 0), Measurements{80}, metrics);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    std::string(argv[1]) == "toy" ? fly_toy(argv[2]) : fly_field(argv[2]);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
