// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A mission with checkpoints, of a map that cannot be saved.
// expect: archetype::Map
// expect: a Checkpoint needs a Persistent map
// expect: give it `void save(Sink&) const` and `void load(Source&)`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/mission/checkpoint.hpp>

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  vantage::archetype::World world;
  vantage::Checkpoint checkpoint(vantage::CheckpointConfig{.file = "mission.checkpoint"});
  loop.run(world, vantage::View{}, {}, vantage::MissionTime{300}, vantage::ModelledClock{}, vantage::Rng{7},
           checkpoint);
}
