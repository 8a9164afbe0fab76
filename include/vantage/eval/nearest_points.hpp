// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <nanoflann.hpp>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>

namespace vantage {

/// Which of many points is nearest: a KD-tree (nanoflann). Refers to the points, which must outlive it. Const members
/// run concurrently.
class NearestPoints {
 public:
  struct Found {
    std::uint32_t index = 0;
    float distance_m = 0;
  };

  /// Throws Error if there are no points, 2^32 or more, or if one is not finite. O(n log n), one thread.
  explicit NearestPoints(std::span<const Eigen::Vector3f> points) : cloud_{checked(points)}, tree_(3, cloud_, {16}) {}
  explicit NearestPoints(std::vector<Eigen::Vector3f>&&) = delete;  // the points must stay
  NearestPoints(const NearestPoints&) = delete;
  NearestPoints& operator=(const NearestPoints&) = delete;

  /// The K nearest, nearest first; fewer if there are fewer points. Throws Error for a point that is not finite.
  template <std::size_t K>
  [[nodiscard]] std::span<const Found> nearest(const Eigen::Vector3f& p, std::array<Found, K>& found) const {
    if (!p.allFinite()) throw Error("NearestPoints", concat("a query at (", p.transpose(), ")"), "finite coordinates");
    std::array<std::uint32_t, K> index{};
    std::array<float, K> squared{};
    nanoflann::KNNResultSet<float, std::uint32_t> result(static_cast<std::uint32_t>(K));
    result.init(index.data(), squared.data());
    tree_.findNeighbors(result, p.data(), nanoflann::SearchParams());
    for (std::size_t i = 0; i < result.size(); ++i) found[i] = {index[i], std::sqrt(squared[i])};
    return std::span<const Found>(found).first(result.size());
  }
  [[nodiscard]] Found operator()(const Eigen::Vector3f& p) const {
    std::array<Found, 1> found;
    return nearest(p, found)[0];
  }
  /// Of each of many, concurrently; fastest where neighbours in the list are near each other.
  [[nodiscard]] std::vector<Found> operator()(std::span<const Eigen::Vector3f> queries) const {
    std::vector<Found> found(queries.size());
    parallel_for_blocks(queries.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) found[i] = (*this)(queries[i]);
    });
    return found;
  }

 private:
  static std::span<const Eigen::Vector3f> checked(std::span<const Eigen::Vector3f> points) {
    if (points.empty() || points.size() > std::numeric_limits<std::uint32_t>::max())
      throw Error("NearestPoints", concat(points.size(), " points"), "1 to 2^32 - 1");
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite())
        throw Error("NearestPoints", concat("point ", i, " is (", points[i].transpose(), ")"), "finite coordinates");
    return points;
  }
  struct Cloud {  // as nanoflann wants it
    std::span<const Eigen::Vector3f> points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud, float, std::uint32_t>;
  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3, std::uint32_t> tree_;
};

}  // namespace vantage
