// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>

namespace vantage {

/// How often each true class was taken for which other, over any number of label images. Pixels whose true label is 0
/// (unknown) do not count; an estimate of 0 where the truth is known is a miss.
class LabelMetrics {
 public:
  using Labels = Image<std::uint16_t>;

  /// `classes`: labels are below it, >= 2 (0 is unknown), at most 4096.
  explicit LabelMetrics(std::size_t classes) : classes_(classes) {
    Check check("LabelMetrics");
    check(classes >= 2 && classes <= 4096, "classes", classes, "2 to 4096");
    check.done();
    counts_.resize(classes * classes);
  }

  /// Throws Error, and counts nothing, for images of different sizes or a label that is no class. O(pixels).
  void add(const Labels& estimate, const Labels& truth) {
    if (estimate.rows() != truth.rows() || estimate.cols() != truth.cols())
      throw Error("LabelMetrics::add",
                  concat("images of ", estimate.cols(), " x ", estimate.rows(), " and ", truth.cols(), " x ",
                         truth.rows(), " px"),
                  "the same size");
    for (const Labels* image : {&estimate, &truth})
      for (Eigen::Index i = 0; i < image->size(); ++i)
        if (image->data()[i] >= classes_)
          throw Error("LabelMetrics::add",
                      concat("label ", image->data()[i], " at row ", i / image->cols(), ", column ", i % image->cols()),
                      concat("below ", classes_));
    for (Eigen::Index i = 0; i < truth.size(); ++i)
      if (truth.data()[i] != 0) ++counts_[truth.data()[i] * classes_ + estimate.data()[i]];
  }

  /// Pixels of class `truth` that were taken for `estimate`.
  [[nodiscard]] std::size_t count(std::size_t truth, std::size_t estimate) const {
    return counts_[truth * classes_ + estimate];
  }
  /// Intersection over union of a class, [0, 1]; NaN if neither the truth nor the estimate has it.
  [[nodiscard]] double iou(std::size_t label) const {
    std::size_t either = 0;
    for (std::size_t other = 1; other < classes_; ++other) either += count(other, label);
    for (std::size_t other = 0; other < classes_; ++other) either += other == label ? 0 : count(label, other);
    return either ? static_cast<double>(count(label, label)) / static_cast<double>(either)
                  : std::numeric_limits<double>::quiet_NaN();
  }
  /// The mean over classes from 1 that the truth or the estimate has; NaN if nothing was counted.
  [[nodiscard]] double mean_iou() const {
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t label = 1; label < classes_; ++label)
      if (const double value = iou(label); !std::isnan(value)) {
        sum += value;
        ++n;
      }
    return n ? sum / static_cast<double>(n) : std::numeric_limits<double>::quiet_NaN();
  }
  /// Share of the pixels that were labelled right, [0, 1]; NaN if nothing was counted.
  [[nodiscard]] double accuracy() const {
    std::size_t right = 0, all = 0;
    for (std::size_t t = 1; t < classes_; ++t) {
      right += count(t, t);
      for (std::size_t e = 0; e < classes_; ++e) all += count(t, e);
    }
    return all ? static_cast<double>(right) / static_cast<double>(all) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::size_t classes_;
  std::vector<std::size_t> counts_;  // truth x estimate
};

}  // namespace vantage
