// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>

namespace vantage {

namespace detail {

/// Whether name a comes before b; runs of digits compare as numbers.
inline bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      while (i < a.size() && a[i] == '0') ++i;
      while (j < b.size() && b[j] == '0') ++j;
      std::size_t m = i, n = j;
      while (m < a.size() && digit(a[m])) ++m;
      while (n < b.size() && digit(b[n])) ++n;
      if (m - i != n - j) return m - i < n - j;
      if (const int order = a.compare(i, m - i, b, j, n - j); order != 0) return order < 0;
      i = m;
      j = n;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

}  // namespace detail

/// The pictures (PNG, JPEG, PGM, PPM, by their names' ends) of a folder whose names start with `prefix`, in the order
/// in which a person counts: 2.png before 10.png. None if there is no such folder. Throws Error if it cannot be listed.
inline std::vector<std::filesystem::path> pictures(const std::filesystem::path& folder, std::string_view prefix = "") {
  std::vector<std::filesystem::path> out;
  if (!folder_exists(folder)) return out;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    const std::string kind = extension_of(at->path());
    const bool picture = kind == "png" || kind == "jpg" || kind == "jpeg" || kind == "pgm" || kind == "ppm";
    if (picture && at->path().filename().string().starts_with(prefix)) out.push_back(at->path());
  }
  if (failed) throw Error(folder.string(), concat("cannot be listed: ", failed.message()));
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return detail::natural_less(a.filename().string(), b.filename().string());
  });
  return out;
}

}  // namespace vantage
