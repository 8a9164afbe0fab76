// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Somebody else's program: vantage's map at a size of its own (cells that split 3 x 3), in vantage's loop, with a
// utility, a sampler and a world of its own; and its map of surfaces, with a rasteriser of another kind.
#include <cmath>
#include <cstdio>
#include <optional>

#include <vantage/vantage.hpp>

// How little is known under the camera, less what it costs to fly low.
struct DoubtFromAbove {
  using MapNeeds = vantage::Needs<vantage::need::Field>;

  template <vantage::FieldMap M>
  double operator()(const M& map, const vantage::View& view) const {
    return map.variance(map.cell_at(view.position().head<2>())) - 0.001 / view.position().z();
  }
};

// Anywhere above the field, at random.
struct Somewhere {
  template <vantage::Map M>
  vantage::Candidates sample(const M& map, const vantage::Situation&, const vantage::Score&, vantage::Rng& rng) const {
    const vantage::Box3 box = map.bounds();
    const Eigen::Vector3d size = box.sizes();
    vantage::Candidates candidates;
    for (int i = 0; i < 50; ++i)
      candidates.views.push_back(vantage::nadir(box.min().x() + rng.uniform() * size.x(),
                                                box.min().y() + rng.uniform() * size.y(), 1 + rng.uniform()));
    return candidates;
  }
};

// A plane that rises along x from 0 to 1, measured without noise.
struct Slope {
  vantage::NadirSensor sensor{.pixels = 10};

  std::optional<vantage::FieldImage> observe(const vantage::View& view) const {
    vantage::FieldImage image{view, sensor.footprint(view), {}};
    image.values.resize(sensor.pixels, sensor.pixels);
    for (int column = 0; column < sensor.pixels; ++column)
      image.values.col(column).setConstant(
          (image.footprint.min().x() + image.footprint.sizes().x() * (column + 0.5) / sensor.pixels) / 20);
    return image;
  }
};

// A wall, 2 m away, in a map of surfels that are drawn in tiles of 8 px, with depths of the surfels' planes.
bool maps_a_wall() {
  using Rasteriser = vantage::TileRasteriser<8, vantage::RayPlaneDepth>;
  using Map = vantage::ActiveGsMap<vantage::preset::reference, vantage::IncrementalConfidence, Rasteriser>;
  Map map{vantage::surfel_config<Map>(vantage::Box3(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 3)))};
  vantage::Frame frame;
  frame.camera = vantage::Camera::from_fov(40, 30, 1.0);
  frame.depth.setConstant(30, 40, 2.0F);
  for (vantage::Image<float>* plane : {&frame.colour.r, &frame.colour.g, &frame.colour.b})
    plane->setConstant(30, 40, 0.5F);
  vantage::Rng rng{1};
  map.integrate(frame, rng);
  vantage::Rendering<vantage::channel::Depth> image;
  map.render(frame.view, frame.camera, image);
  std::printf("%zu surfels, %.3f m away\n", map.surfels().size(), static_cast<double>(image.depth(15, 20)));
  return map.surfels().size() > 100 && std::abs(image.depth(15, 20) - 2.0F) < 0.05F;
}

int main() {
  using Map = vantage::IntegralGp<vantage::SquaredExponential, vantage::CellAverage, vantage::Full<>, vantage::Fixed<>>;
  vantage::NbvLoop loop{Map{{.tree = {.branching = 3, .depth = 2}}}, DoubtFromAbove{}, Somewhere{}, vantage::ArgMax{}};
  const auto error = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < loop.map.size(); ++i)
      sum += std::abs(loop.map.mean(i) - loop.map.cell(i).center().x() / 20);
    return sum / static_cast<double>(loop.map.size());
  };
  const double before = error();
  Slope world;
  loop.run(world, vantage::nadir(10, 10, 1), {}, vantage::Measurements{30}, vantage::ModelledClock{}, vantage::Rng{7});
  std::printf("vantage %s: %zu cells, mean error %.4f before, %.4f after\n", VANTAGE_VERSION, loop.map.size(), before,
              error());
  return loop.map.size() == 81 && error() < before / 4 && maps_a_wall() ? 0 : 1;
}
