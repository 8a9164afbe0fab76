// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/io/number.hpp>
#include <vantage/io/obj_lines.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// What an MTL file says of a material.
struct MtlMaterial {
  Eigen::Vector3d colour = Eigen::Vector3d::Constant(0.8);  ///< Kd
  std::string texture;                                      ///< map_Kd: a path, relative to the MTL file; or none
  bool transparent = false;                                 ///< d < 1 or Tr > 0
};

/// Reads the materials of an MTL text: newmtl, Kd, map_Kd, d, Tr; what else there is does not count. Throws Error
/// naming the line.
inline std::map<std::string, MtlMaterial> parse_mtl(std::string_view text, const std::string& where) {
  // Options of map_Kd and how many words follow each.
  constexpr std::array<std::pair<std::string_view, int>, 11> options = {{{"-blendu", 1},
                                                                         {"-blendv", 1},
                                                                         {"-bm", 1},
                                                                         {"-boost", 1},
                                                                         {"-cc", 1},
                                                                         {"-clamp", 1},
                                                                         {"-imfchan", 1},
                                                                         {"-texres", 1},
                                                                         {"-mm", 2},
                                                                         {"-type", 1},
                                                                         {"-colorspace", 1}}};
  std::map<std::string, MtlMaterial> materials;
  MtlMaterial* current = nullptr;
  ObjLines lines(text, where);
  for (std::string_view key = lines.next(); !key.empty(); key = lines.next()) {
    if (key == "newmtl") {
      current = &materials[std::string(lines.rest())];
      *current = {};
    } else if (key == "Kd" || key == "d" || key == "Tr" || key == "map_Kd") {
      if (current == nullptr) lines.refuse(concat("'", printable(key), "' before the first 'newmtl'"), "newmtl");
      if (key == "Kd") {
        current->colour = lines.numbers<3>("colour");
        if (!current->colour.allFinite()) lines.refuse("a colour that is not finite", "three numbers");
      } else if (key == "map_Kd") {
        std::string_view name = lines.rest();
        while (name.starts_with('-')) {
          const std::string_view option = lines.word();
          const auto* known =
              std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.first == option; });
          if (known != options.end()) {
            for (int i = 0; i < known->second; ++i) lines.word();
          } else {  // -o, -s, -t: one to three numbers
            double ignored = 0;
            for (std::string_view next = lines.rest(); take_number(next, ignored); next = lines.rest()) lines.word();
          }
          name = lines.rest();
        }
        current->texture = name;
      } else {
        const double value = lines.numbers<1>("transparency")[0];
        current->transparent = key == "d" ? value < 1 : value > 0;
      }
    }
  }
  return materials;
}

}  // namespace vantage
