// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/core/error.hpp>

namespace vantage::test {

/// What f complains about, or "" if it does not.
template <class F>
std::string message_of(F&& f) {
  try {
    static_cast<void>(f());
  } catch (const Error& e) { return e.what(); }
  return "";
}

}  // namespace vantage::test

/// That f() throws an Error whose text holds `part`.
#define EXPECT_REFUSED(f, part)                                                                     \
  do {                                                                                              \
    const std::string complaint = vantage::test::message_of([&]() -> decltype(auto) { return f; }); \
    EXPECT_NE(complaint.find(part), std::string::npos) << #f << " said: '" << complaint << "'";     \
  } while (false)
