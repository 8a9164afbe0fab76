// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/utility/information_gain.hpp>
#include <vantage/utility/ray_entropy.hpp>

#include "message_of.hpp"

namespace vantage {
namespace {

/// Draws a number a pixel, in two channels.
struct Ramp : archetype::Map {
  void render(const View& view, const Camera& camera, Rendering<channel::Entropy>& out) const {
    draw(view, camera, out.entropy);
  }
  void render(const View& view, const Camera& camera, Rendering<channel::InformationGain>& out) const {
    draw(view, camera, out.information_gain);
    out.information_gain *= -2;
  }

 private:
  static void draw(const View& view, const Camera& camera, Image<float>& image) {
    image.resize(camera.height, camera.width);
    for (Eigen::Index i = 0; i < image.size(); ++i)
      image(i) = static_cast<float>(view.position().x()) + static_cast<float>(i);
  }
};

TEST(RayEntropy, IsTheMeanOfTheImage) {
  const Camera camera = Camera::from_fov(7, 5, 1);
  EXPECT_EQ(RayEntropy(camera)(Ramp{}, nadir(3, 0, 1)), 3 + 17);
  EXPECT_EQ(RayEntropy().camera().width, 128);
  EXPECT_REFUSED(RayEntropy(Camera{}), "width");
}

TEST(InformationGain, IsTheMeanOfTheImage) {
  const Camera camera = Camera::from_fov(7, 5, 1);
  EXPECT_EQ(InformationGain(camera)(Ramp{}, nadir(3, 0, 1)), -2 * (3 + 17));
  EXPECT_REFUSED(InformationGain(Camera{}), "width");
}

}  // namespace
}  // namespace vantage
