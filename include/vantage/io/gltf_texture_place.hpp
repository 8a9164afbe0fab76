// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include <vantage/io/json.hpp>

namespace vantage {

/// Where in a texture a glTF material looks: one of a vertex' pairs of coordinates which, with KHR_texture_transform,
/// are scaled, then turned, then moved.
struct GltfTexturePlace {
  std::size_t set = 0;  ///< the n of TEXCOORD_n
  Eigen::Matrix2d scaled_turn = Eigen::Matrix2d::Identity();
  Eigen::Vector2d move = Eigen::Vector2d::Zero();

  GltfTexturePlace() = default;
  /// What a textureInfo object tells. Throws Error naming the way to what is no number.
  explicit GltfTexturePlace(const JsonItem& texture) {
    constexpr std::size_t most_sets = 1 << 16;
    if (const auto n = texture.find("texCoord")) set = n->count(most_sets);
    const auto extensions = texture.find("extensions");
    const auto transform = extensions ? extensions->find("KHR_texture_transform") : std::optional<JsonItem>();
    if (!transform) return;
    if (const auto n = transform->find("texCoord")) set = n->count(most_sets);
    if (const auto offset = transform->find("offset")) move = offset->vector<2>();
    Eigen::Vector2d scale = Eigen::Vector2d::Ones();
    if (const auto factors = transform->find("scale")) scale = factors->vector<2>();
    const auto rotation = transform->find("rotation");
    const double angle_rad = rotation ? rotation->number() : 0, c = std::cos(angle_rad), s = std::sin(angle_rad);
    // Counter-clockwise to the eye, in coordinates whose v points down: u turns towards -v. The extension's example and
    // its test model want this; its GLSL, read column by column as GLSL does, turns the other way (KhronosGroup/glTF,
    // issue 1563).
    scaled_turn << c * scale.x(), s * scale.y(), -s * scale.x(), c * scale.y();
  }
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& uv) const { return scaled_turn * uv + move; }
};

}  // namespace vantage
