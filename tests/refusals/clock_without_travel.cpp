// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A clock that is not told how long the robot travels.
// expect: MyClock
// expect: the clock tells no mission time
// expect: begin(), mapped(), planned() and travelled(double s)
// expect: or take MeasuredClock or ModelledClock
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyClock {
  double elapsed_s() const { return 0; }
  void begin() {}
  void mapped() {}
  void planned() {}
};

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  vantage::archetype::World world;
  loop.run(world, vantage::View{}, {}, vantage::Measurements{5}, MyClock{}, vantage::Rng{7});
}
