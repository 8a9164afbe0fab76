// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <string>
#include <string_view>

#include <vantage/core/error.hpp>

namespace study {

struct MethodInfo {
  std::string_view name, label;
};

/// In the order of Table 3.1, and one more: the same map as Ours by another covariance.
inline constexpr std::array<MethodInfo, 7> all_methods = {{{"fr_idp", "FR-IDP"},
                                                           {"ar_idp", "AR-IDP"},
                                                           {"ar_bcm", "AR-BCM"},
                                                           {"ar_gpr_ik", "AR-GPR-IK"},
                                                           {"fr_gpf", "FR-GPF"},
                                                           {"ours", "Ours"},
                                                           {"ours_latent", "Ours, latent"}}};

inline const MethodInfo& method_info(std::string_view name) {
  for (const MethodInfo& m : all_methods)
    if (m.name == name) return m;
  throw vantage::Error("method", "'" + std::string(name) + "'", "a method of the study");
}

/// Those that are fast enough to plan on (section 3.2.3).
inline constexpr std::array<std::string_view, 5> planned_methods = {"fr_idp", "ar_idp", "fr_gpf", "ours",
                                                                    "ours_latent"};

}  // namespace study
