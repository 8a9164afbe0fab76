// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <vantage/core/error.hpp>

namespace vantage::detail {

/// One run of Qhull (its reentrant library): catches what it prints (nothing reaches the terminal) and frees what it
/// holds. `coordinates` of all points in a row have to outlive it; Qhull's tolerances are made for numbers around 1.
class Qhull {
 public:
  Qhull(std::string_view where, std::string command, int dimension, std::vector<double>& coordinates) {
    log_ = open_memstream(&text_, &size_);
    if (!log_) throw Error(where, "no memory for Qhull's messages");
    qh_zero(&qh, log_);
    code = qh_new_qhull(&qh, dimension, static_cast<int>(coordinates.size()) / dimension, coordinates.data(), False,
                        command.data(), nullptr, log_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    qh.NOerrexit = True;
    qh_freeqhull(&qh, !qh_ALL);
    int current = 0, total = 0;
    qh_memfreeshort(&qh, &current, &total);
    std::fclose(log_);
    std::free(text_);
  }
  /// The first line of its complaint.
  [[nodiscard]] std::string message() const {
    std::fflush(log_);
    return text_ ? std::string(text_, std::find(text_, text_ + size_, '\n')) : std::string();
  }

  qhT qh = {};
  int code = 0;  ///< 0: done

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* log_ = nullptr;
};

}  // namespace vantage::detail
