// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
//
// A map of one's own. A map says what it learns from, learns it, and says where it is; what else it can do decides
// which policies it goes with. This one keeps an average per square, and draws how uncertain it is.
#include <cmath>
#include <cstdio>

#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/vantage.hpp>

using namespace vantage;

class Averages {
 public:
  using Measurement = FieldImage;  // any type: here an image of the ground

  void integrate(const FieldImage& z, Rng&) {
    if (!z.footprint.min().allFinite() || !z.footprint.max().allFinite() || z.values.isInf().any())
      throw Error("Averages", "an infinite image", "finite numbers");  // before anything changes
    const Eigen::Array2d pixel_m =
        z.footprint.sizes().array() / Eigen::Array2d(double(z.values.cols()), double(z.values.rows()));
    for (int row = 0; row < z.values.rows(); ++row)
      for (int column = 0; column < z.values.cols(); ++column) {
        const Eigen::Array2d centre(column + 0.5, row + 0.5);
        const int i = square(z.footprint.min().array() + pixel_m * centre);
        if (i < 0 || std::isnan(z.values(row, column))) continue;
        mean_[i] += (z.values(row, column) - mean_[i]) / ++count_[i];
      }
  }
  [[nodiscard]] Box3 bounds() const { return {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 20, 0)}; }

  // With this it is an UncertainMap, and MeanUncertainty plans on it. concepts/map.hpp says what else there is.
  void render(const View& view, const Camera& camera, Rendering<channel::Uncertainty>& out) const {
    out.uncertainty.setZero(camera.height, camera.width);
    const Eigen::Vector3d eye = view.position();
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = view.T_W_C.linear() * camera.ray(u + 0.5, v + 0.5);
        const int i = ray.z() < 0 ? square((eye - eye.z() / ray.z() * ray).head<2>()) : -1;
        if (i >= 0) out.uncertainty(v, u) = 1 / std::sqrt(1 + static_cast<float>(count_[i]));
      }
  }
  [[nodiscard]] double hottest() const { return mean_.maxCoeff(); }

 private:  // squares of a metre; -1: outside
  static int square(const Eigen::Array2d& p) {
    return (p >= 0).all() && (p < 20).all() ? 20 * static_cast<int>(p.y()) + static_cast<int>(p.x()) : -1;
  }
  Eigen::Array<double, 400, 1> mean_ = Eigen::Array<double, 400, 1>::Zero();
  Eigen::Array<int, 400, 1> count_ = Eigen::Array<int, 400, 1>::Zero();
};

int main() {
  FieldWorld world{random_field(Rng{1}), VarianceByHeight{}, Rng{2}};
  NbvLoop loop{Averages{}, MeanUncertainty{Camera::from_fov(20, 20, deg(90))}, Lattice{Lattice::thesis()}, ArgMax{}};
  loop.run(world, nadir(0, 0, 0), {}, MissionTime{100}, ModelledClock{}, Rng{7});
  std::printf("the hottest square that it found: %.2f\n", loop.map.hottest());
}
