// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/splat_ply.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

Surfels some(std::size_t n) {
  Surfels s;
  Rng rng(1);
  for (std::size_t i = 0; i < n; ++i) {
    Surfel one;
    for (float& p : one.parameter) p = static_cast<float>(rng.uniform(-1.5, 2));
    one.confidence = static_cast<float>(rng.uniform());
    s.push_back(one);
  }
  return s;
}

// The header, line by line, as the tools of Gaussian splatting write and expect it.
std::string layout(std::size_t n) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(n) + "\n";
  const auto property = [&](const std::string& name) { text += "property float " + name + "\n"; };
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"}) property(name);
  for (int k = 0; k < 45; ++k) property("f_rest_" + std::to_string(k));
  for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    property(name);
  return text + "end_header\n";
}

TEST(SplatPly, HasTheLayoutOfViewersPropertyByProperty) {
  const Surfels s = some(17);
  const std::string file = encode_splat_ply(s), header = layout(17);
  ASSERT_EQ(file.substr(0, header.size()), header);
  constexpr std::size_t columns = 62;
  ASSERT_EQ(file.size(), header.size() + 17 * columns * 4);
  for (std::size_t i = 0; i < 17; ++i) {
    std::array<float, columns> row;
    std::memcpy(row.data(), file.data() + header.size() + i * columns * 4, columns * 4);
    const auto& p = s[i].parameter;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(row[k], p[k]);
    const Eigen::Vector3f n = normal_of(s, i);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(row[3 + k], n[static_cast<Eigen::Index>(k)], 1e-6F);
      EXPECT_NEAR(0.5F + 0.28209479177387814F * row[6 + k], p[surfel::red + k], 1e-6F);
    }
    for (std::size_t k = 9; k < 54; ++k) EXPECT_EQ(row[k], 0);
    EXPECT_EQ(row[54], p[surfel::logit]);
    for (std::size_t k = 0; k < 2; ++k) {
      const float scale_m = std::min(0.01F * std::exp(p[surfel::log_scale_x + k]), 0.05F);
      EXPECT_NEAR(std::exp(row[55 + k]), scale_m, 1e-6F * scale_m + 1e-8F);
    }
    EXPECT_LT(std::exp(row[57]), 1e-5F);
    float square = 0, dot = 0, length = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      square += row[58 + k] * row[58 + k];
      dot += row[58 + k] * p[surfel::qw + k];
      length += p[surfel::qw + k] * p[surfel::qw + k];
    }
    EXPECT_NEAR(square, 1, 1e-6F);
    EXPECT_NEAR(dot, std::sqrt(length), 1e-5F);
    for (const float x : row) EXPECT_TRUE(std::isfinite(x));
  }
}

TEST(SplatPly, ComesBack) {
  const test::TemporaryFolder folder;
  const Surfels s = some(40);
  write_splat_ply(folder.path() / "a.ply", s);
  const Surfels again = read_splat_ply(folder.path() / "a.ply");
  ASSERT_EQ(again.size(), s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(position_of(again, i), position_of(s, i));
    EXPECT_LT((normal_of(again, i) - normal_of(s, i)).norm(), 1e-5F);
    EXPECT_NEAR(again.parameter[surfel::green][i], s.parameter[surfel::green][i], 1e-6F);
    EXPECT_EQ(again.parameter[surfel::logit][i], s.parameter[surfel::logit][i]);
    EXPECT_EQ(again.confidence[i], 0);
  }
  EXPECT_EQ(again.scale.unit_m, 1);
  EXPECT_EQ(encode_splat_ply(Surfels{}), layout(0));
  EXPECT_EQ(decode_splat_ply(layout(0), "none").size(), 0U);
}

TEST(SurfelPly, ComesBackToTheBit) {
  const test::TemporaryFolder folder;
  write_surfel_ply(folder.path() / "a.ply", some(40));
  const Surfels s = read_surfel_ply(folder.path() / "a.ply");
  ASSERT_EQ(s.size(), 40U);
  const Surfels original = some(40);
  for (const std::size_t p : {surfel::x, surfel::qy, surfel::red, surfel::logit})
    EXPECT_EQ(s.parameter[p], original.parameter[p]);
  EXPECT_EQ(s.confidence, original.confidence);
  EXPECT_EQ(encode_surfel_ply(s), read_file(folder.path() / "a.ply", 1 << 20));
}

TEST(SurfelPly, WhatCannotBeDrawnIsLeftOut) {
  Surfels s = some(6);
  s.parameter[surfel::x][1] = std::numeric_limits<float>::quiet_NaN();
  s.parameter[surfel::logit][2] = std::numeric_limits<float>::infinity();
  for (const std::size_t p : {surfel::qw, surfel::qx, surfel::qy, surfel::qz}) s.parameter[p][3] = 0;
  s.confidence[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(decode_splat_ply(encode_splat_ply(s), "a").size(), 2U);
  EXPECT_EQ(decode_surfel_ply(encode_surfel_ply(s), "a").size(), 2U);
}

// A colour of the largest floats is finite, but not as a spherical harmonic.
TEST(SplatPly, HasFiniteNumbersOnly) {
  Surfels s = some(4);
  s.parameter[surfel::green][1] = 9.7e37F;
  s.parameter[surfel::blue][2] = -std::numeric_limits<float>::max();
  s.parameter[surfel::red][3] = 9.5e37F;
  const Surfels again = decode_splat_ply(encode_splat_ply(s), "a");  // which refuses what is not finite
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(position_of(again, 0), position_of(s, 0));
  EXPECT_EQ(position_of(again, 1), position_of(s, 3));
  EXPECT_EQ(decode_surfel_ply(encode_surfel_ply(s), "a").size(), 4U);
}

TEST(SurfelPly, RefusesWhatIsDamaged) {
  const std::string good = encode_surfel_ply(some(3)), splat = encode_splat_ply(some(3));
  for (std::size_t n = 0; n < good.size(); n += 5) EXPECT_THROW(decode_surfel_ply(good.substr(0, n), "a"), Error) << n;
  const auto without = [](std::string file, const std::string& name) {
    const std::size_t at = file.find(" " + name + "\n");
    return file.replace(at + 1, 1, "_");
  };
  EXPECT_NE(test::message_of([&] { (void)decode_splat_ply(without(splat, "rot_2"), "a"); }).find("'rot_2'"),
            std::string::npos);
  EXPECT_THROW(decode_splat_ply(without(splat, "x"), "a"), Error);
  EXPECT_THROW(decode_surfel_ply(splat, "a"), Error);
  EXPECT_THROW(decode_splat_ply(good, "a"), Error);
  std::string bad = good;
  const float not_finite = std::numeric_limits<float>::infinity();
  std::memcpy(bad.data() + bad.size() - 8, &not_finite, 4);
  EXPECT_NE(test::message_of([&] { (void)decode_surfel_ply(bad, "a"); }).find("vertex 2 has logit inf"),
            std::string::npos);
  std::string turned = good;
  std::memset(turned.data() + turned.size() - 14 * 4 + 3 * 4, 0, 16);
  EXPECT_NE(test::message_of([&] { (void)decode_surfel_ply(turned, "a"); }).find("quaternion"), std::string::npos);
}

}  // namespace
}  // namespace vantage
