// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <vantage/geometry/image.hpp>

// What reference/make_reference.py computed, and the formulas of its inputs once more.
namespace vantage::test {

inline nlohmann::json reference(const std::string& part) {
  const auto file = std::filesystem::path(__FILE__).parent_path() / "reference" / "reference.json";
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return nlohmann::json::parse(in).at(part);
}

inline std::vector<double> hashed(std::size_t n, std::uint32_t seed) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t x = static_cast<std::uint32_t>(i) + seed * 1000003u;
    for (const std::uint32_t multiplier : {0x7FEB352Du, 0x846CA68Bu}) x = (x ^ (x >> 16)) * multiplier;
    x ^= x >> 15;
    values[i] = static_cast<double>(x >> 8) / 16777216.0;
  }
  return values;
}

inline Image<float> picture(Eigen::Index rows, Eigen::Index columns, Eigen::Index seed) {
  Image<float> image(rows, columns);
  for (Eigen::Index y = 0; y < rows; ++y)
    for (Eigen::Index x = 0; x < columns; ++x) {
      const double smooth = static_cast<double>((3 * x * x + 5 * y + 7 * seed * x) % 1024) / 1024;
      const double steps = static_cast<double>((x / 7 + y / 5 + seed) % 3) / 4;
      image(y, x) = static_cast<float>(std::nearbyint((0.5 * smooth + 0.5 * steps) * 4096) / 4096);
    }
  return image;
}
inline Image<float> noisy(const Image<float>& image, double amount, std::uint32_t seed) {
  Image<float> result = image;
  const std::vector<double> noise = hashed(static_cast<std::size_t>(image.size()), seed);
  for (Eigen::Index i = 0; i < image.size(); ++i) {
    const double n = std::nearbyint((noise[static_cast<std::size_t>(i)] - 0.5) * amount * 4096) / 4096;
    result.data()[i] = static_cast<float>(std::clamp(static_cast<double>(image.data()[i]) + n, 0.0, 1.0));
  }
  return result;
}

}  // namespace vantage::test
