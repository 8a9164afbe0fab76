// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Surfels drawn and differentiated against numbers of the published rasteriser in double precision: one surfel, and
// twenty of which some lie behind, outside, or are seen from their edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/maps/surfel/reference_rasteriser.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>

#include "golden.hpp"
#include "surfel_scenes.hpp"

namespace {

using namespace vantage;

using Everything = Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Opacity, channel::Confidence>;

struct Case {
  std::filesystem::path folder;
  Surfels surfels;
  RasterView view;

  explicit Case(const std::string& name)
      : folder(test::golden("surfel/" + name)), surfels(test::surfels_of(read_csv(folder / "params.csv"))) {
    const auto rows = test::named_numbers(test::text_of(folder / "camera.csv"));
    const auto number = [&](const char* key) { return rows.at(key).at(0); };
    const double w = number("W"), h = number("H");
    view.camera = {static_cast<int>(w), static_cast<int>(h), number("fx"), number("fy"), w / 2, h / 2};
    view.view = test::poses(rows.at("c2w_rowmajor")).at(0);
    for (std::size_t k = 0; k < 3; ++k) view.background[k] = static_cast<float>(rows.at("bg").at(k));
    surfels.scale = {static_cast<float>(number("scale_factor")), static_cast<float>(number("scale_max"))};
  }
  [[nodiscard]] std::vector<double> npy(const std::string& name) const {
    return read_npy(folder / (name + ".npy")).values<double>(name);
  }
  [[nodiscard]] Image<float> image(const std::string& name, std::size_t plane = 0) const {
    const std::vector<double> values = npy(name);
    Image<float> out(view.camera.height, view.camera.width);
    const auto n = static_cast<std::size_t>(out.size());
    for (std::size_t i = 0; i < n; ++i) out.data()[i] = static_cast<float>(values[plane * n + i]);
    return out;
  }
};

template <class Raster>
Everything draw(const Case& c, SurfelGradient* gradient = nullptr, const ImageGradient& d = {}) {
  const Raster raster;
  typename Raster::Pass pass;
  Everything out;
  raster.forward(c.surfels, c.view, pass, out);
  if (gradient != nullptr) raster.backward(c.surfels, c.view, pass, d, *gradient);
  return out;
}

struct Tolerance {
  double colour = 2e-5, depth = 2e-4, normal = 2e-5;
};

void expect_image(const Case& c, const Image<float>& ours, const std::string& name, std::size_t plane,
                  double tolerance) {
  const Image<float> theirs = c.image(name, plane);
  ASSERT_EQ(ours.rows(), theirs.rows());
  for (Eigen::Index i = 0; i < ours.size(); ++i) {
    if (std::isnan(ours.data()[i])) {
      EXPECT_EQ(theirs.data()[i], 0) << name << " at " << i;
      continue;
    }
    ASSERT_NEAR(ours.data()[i], theirs.data()[i], tolerance) << c.folder << " " << name << plane << " at " << i;
  }
}

struct GoldenSurfels : test::Golden {
  GoldenSurfels() : Golden("surfel/case_A") {}
};

template <class Raster>
class GoldenRaster : public GoldenSurfels {};

// Floats are compared with numbers in double: 2e-5, depth 2e-4, as the published kernels in float reach them.
using Rasters = testing::Types<ReferenceRasteriser<double, LinearDepth, PublishedTiles>,
                               ReferenceRasteriser<float, LinearDepth, PublishedTiles>>;
TYPED_TEST_SUITE(GoldenRaster, Rasters);

void expect_images(const Case& c, const Everything& out, const Tolerance& within) {
  const channel::Colour& colour = out;
  const channel::Normal& normal = out;
  expect_image(c, colour.r, "C", 0, within.colour);
  expect_image(c, colour.g, "C", 1, within.colour);
  expect_image(c, colour.b, "C", 2, within.colour);
  expect_image(c, out.depth, "D", 0, within.depth);
  expect_image(c, normal.x, "N", 0, within.normal);
  expect_image(c, normal.y, "N", 1, within.normal);
  expect_image(c, normal.z, "N", 2, within.normal);
  expect_image(c, out.opacity, "O", 0, within.colour);
  expect_image(c, out.confidence, "K", 0, within.colour);
}

TYPED_TEST(GoldenRaster, Images) {
  for (const char* name : {"case_A", "case_B"}) {
    Case c(name);
    const TypeParam raster;
    typename TypeParam::Pass pass;
    Everything out;
    raster.forward(c.surfels, c.view, pass, out);
    expect_images(c, out, {});
    const std::vector<std::int64_t> blended = read_npy(c.folder / "ncontrib.npy").template values<std::int64_t>("n");
    for (Eigen::Index i = 0; i < pass.blended.size(); ++i)
      EXPECT_EQ(pass.blended.data()[i], blended[static_cast<std::size_t>(i)]);
    c.view.front_only = true;
    raster.forward(c.surfels, c.view, pass, out);
    expect_image(c, out.confidence, "K_frontonly", 0, 2e-5);
    expect_image(c, out.opacity, "O_frontonly", 0, 2e-5);
  }
}

// To 1e-4 of the largest of a parameter. Floats, of the largest in a position, a quaternion, ... of any surfel: of an
// axis that a view hardly tells of, the derivative is a difference of larger numbers, and float has 7 digits of those.
constexpr std::array<std::size_t, surfel::parameters> group = {0, 0, 0, 3, 3, 3, 3, 7, 7, 9, 9, 9, 12};
template <class Raster>
constexpr bool in_double = false;
template <class Depth, class Extent>
constexpr bool in_double<ReferenceRasteriser<double, Depth, Extent>> = true;

template <class Raster>
void expect_gradients(const Case& c, const std::string& loss) {
  const std::string suffix = "_" + loss;
  const ImageGradient d{{c.image("dL_dC" + suffix, 0), c.image("dL_dC" + suffix, 1), c.image("dL_dC" + suffix, 2)},
                        c.image("dL_dD" + suffix),
                        {},
                        c.image("dL_dN" + suffix, 0),
                        c.image("dL_dN" + suffix, 1),
                        c.image("dL_dN" + suffix, 2)};
  SurfelGradient gradient;
  draw<Raster>(c, &gradient, d);
  const CsvTable theirs = read_csv(c.folder / ("grad" + suffix + "_exact.csv"));
  for (std::size_t p = 0; p < surfel::parameters; ++p) {
    double largest = 0;
    for (std::size_t k = 0; k < surfel::parameters; ++k)
      if (in_double<Raster> ? k == p : group[k] == group[p])
        for (const double g : theirs.column(k)) largest = std::max(largest, std::abs(g));
    EXPECT_GT(largest, 0) << c.folder << loss << p;
    for (std::size_t i = 0; i < c.surfels.size(); ++i)
      EXPECT_NEAR(gradient.parameter[p][i], theirs.column(p)[i], 1e-4 * largest)
          << c.folder << loss << p << " of " << i;
  }
}

TYPED_TEST(GoldenRaster, ExactGradients) {
  expect_gradients<TypeParam>(Case("case_A"), "simple");
  expect_gradients<TypeParam>(Case("case_B"), "simple");
  expect_gradients<TypeParam>(Case("case_B"), "activegs");
}

// The fast rasteriser cuts no splat off at a tile. One tile holds all of case A; in case B that makes no more of a
// difference than the data's description states of a third case, which is not among the data.
TEST_F(GoldenSurfels, WithoutTheCutAtTiles) {
  for (const auto& out : {draw<TileRasteriser<>>(Case("case_A")), draw<TileRasteriser<8>>(Case("case_A"))})
    expect_images(Case("case_A"), out, {});
  expect_gradients<TileRasteriser<>>(Case("case_A"), "simple");
  expect_images(Case("case_B"), draw<TileRasteriser<>>(Case("case_B")), {3e-3, 2e-3, 1.7e-2});
  expect_image(Case("case_A"), draw<TileRasteriser<16, RayPlaneDepth>>(Case("case_A")).depth, "D_exact_rayplane", 0,
               2e-4);
}

// Which surfels a view sees, in published numbers: pixels whose weight is above a threshold.
TYPED_TEST(GoldenRaster, Visibility) {
  for (const char* name : {"case_A", "case_B"}) {
    Case c(name);
    c.view.front_only = true;
    const CsvTable theirs = read_csv(c.folder / "visibility.csv");
    const auto count = [&](const std::string& masked, const Image<float>& measured) {
      const TypeParam raster;
      typename TypeParam::Pass pass;
      std::vector<float> weight(c.surfels.size(), 0);
      raster.visibility(c.surfels, c.view, pass, measured, weight);
      for (std::size_t i = 0; i < weight.size(); ++i) {
        EXPECT_EQ(weight[i] > 0.03F, theirs.column("count_0.03_" + masked)[i] > 0) << name << " " << i;
        EXPECT_EQ(weight[i] > 0.3F, theirs.column("count_0.3_" + masked)[i] > 0) << name << " " << i;
      }
    };
    count("mask", c.image("target_D"));
    count("nomask", Image<float>::Ones(c.view.camera.height, c.view.camera.width));
  }
}

template <class S>
void expect_projection() {
  for (const char* name : {"case_A", "case_B"}) {
    const Case c(name);
    const std::string text = test::text_of(c.folder / "preprocess.csv");
    const CsvTable theirs = parse_csv(std::regex_replace(text, std::regex("nan"), ""));
    const Projector<S> camera(c.view, c.surfels.scale);
    for (std::size_t i = 0; i < c.surfels.size(); ++i) {
      surfel::Parameters<S> in;
      for (std::size_t p = 0; p < surfel::parameters; ++p) in[p] = c.surfels.parameter[p][i];
      const auto s = project<LinearDepth>(camera, in);
      const bool in_sight = camera.in_sight(s.p, s.centre) != 0;
      const double cull = theirs.column(0)[i];
      EXPECT_EQ(in_sight, cull != 1) << name << " " << i;
      if (!in_sight) continue;
      EXPECT_EQ(is_drawn(camera, in, S(0), s) != 0, cull != 2) << name << " " << i;
      if (cull != 0) continue;
      const auto near = [&](S ours, const char* column, double relative) {
        const double value = theirs.column(column)[i];
        EXPECT_NEAR(ours, value, relative * (1 + std::abs(value))) << name << " " << i << " " << column;
      };
      const double r = std::is_same_v<S, float> ? 2e-5 : 1e-12;
      near(s.centre[0], "u", r);
      near(s.centre[1], "v", r);
      near(s.p[2], "z", r);
      near(s.covariance[0], "cov_xx", r);
      near(s.covariance[1], "cov_xy", r);
      near(s.covariance[2], "cov_yy", r);
      near(s.conic[0], "conic_A", r);
      near(s.conic[1], "conic_B", r);
      near(s.conic[2], "conic_C", r);
      near(s.slope[0], "dz_du", r);
      near(s.slope[1], "dz_dv", r);
      near(s.axis[2][0], "ncam_x", r);
      near(s.axis[2][1], "ncam_y", r);
      near(s.axis[2][2], "ncam_z", r);
      near(PublishedTiles::radius_px(s), "radius_px", 0);
      const auto tiles = PublishedTiles::tiles(s, c.view.camera);
      EXPECT_EQ(tiles[0], theirs.column("tile_x0")[i]);
      EXPECT_EQ(tiles[1], theirs.column("tile_x1")[i]);
      EXPECT_EQ(tiles[2], theirs.column("tile_y0")[i]);
      EXPECT_EQ(tiles[3], theirs.column("tile_y1")[i]);
    }
  }
}
TEST_F(GoldenSurfels, Projection) {
  expect_projection<double>();
  expect_projection<float>();
}

TEST_F(GoldenSurfels, RayPlaneDepth) {
  for (const char* name : {"case_A", "case_B"}) {
    const Case c(name);
    const ReferenceRasteriser<double, RayPlaneDepth, PublishedTiles> raster;
    ReferenceRasteriser<double, RayPlaneDepth, PublishedTiles>::Pass pass;
    Everything out;
    raster.forward(c.surfels, c.view, pass, out);
    expect_image(c, out.depth, "D_exact_rayplane", 0, 2e-4);
  }
}

}  // namespace
