// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include <tbb/task_arena.h>

#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/regression.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/utility/mean_uncertainty.hpp>
#include <vantage/utility/variance_reduction.hpp>

// What runs on several threads, for ThreadSanitizer to watch; and that the results are those of one thread.
namespace {

using namespace vantage;

Lattice::Config few_views() {
  const Box2 area = Lattice::field_20m();
  return {.layers = {Layer::inside(area, 2, 5, 5), Layer::inside(area, 5, 3, 3)}};
}

template <class Map, class Utility, class Selector>
std::vector<std::byte> mission(int threads, const Utility& utility, const Selector& selector) {
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    FieldWorld world(random_field(Rng(1), {.columns = 64, .rows = 64}), DeviationByHeight{0.05}, Rng(2));
    typename Map::Config c;
    c.tree.depth = 4;
    c.prior_mean = 0.7;
    NbvLoop loop{Map(c), utility, Lattice{few_views()}, selector};
    const MissionState end = loop.run(world, nadir(10, 10, 2), {}, Measurements{5}, ModelledClock{}, Rng{7});
    Sink sink;
    loop.map.save(sink);
    end.save(sink);
    return std::move(sink).take();
  });
}

template <class Map, class Utility, class Selector = PerFlightTime>
void expect_same(const Utility& utility, const Selector& selector = {}) {
  const auto one = mission<Map>(1, utility, selector);
  EXPECT_EQ(mission<Map>(2, utility, selector), one);
  EXPECT_EQ(mission<Map>(8, utility, selector), one);
}

TEST(Parallel, MissionsWithTheFullBelief) { expect_same<IntegralGp<>>(VarianceReduction{}); }
TEST(Parallel, MissionsWithTheLatentBelief) {
  expect_same<IntegralGp<SquaredExponential, CellAverage, Latent<>>>(VarianceReduction{});
}
TEST(Parallel, ViewsScoredOneByOne) {
  expect_same<IntegralGp<>, MeanUncertainty, ArgMax>(MeanUncertainty(Camera::from_fov(16, 16, deg(60))));
}
TEST(Parallel, Regression) {
  const auto fit = [](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([] {
      Rng rng(3);
      Points x(400, 2), queries(300, 2);
      for (Points* p : {&x, &queries})
        for (Eigen::Index i = 0; i < p->rows(); ++i) p->row(i) << rng.uniform(0, 20), rng.uniform(0, 20);
      const GpRegression<> gp({}, x, x.col(0).array().sin());
      const Prediction p = gp.predict(queries);
      return std::pair<Eigen::VectorXd, Eigen::VectorXd>(p.mean, p.variance);
    });
  };
  EXPECT_EQ(fit(1), fit(4));
}

}  // namespace
