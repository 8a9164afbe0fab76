// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/field/kernel.hpp>

namespace vantage {

/// Prior covariance of averages over boxes, eq. 3.3: K[rows, columns]. The factors of each pair of distinct intervals
/// are computed once, so that boxes on grids cost little. Throws Error on an empty or infinite box.
template <SeparableKernel K>
Eigen::MatrixXd average_covariance(const K& kernel, std::span<const Box2> rows, std::span<const Box2> columns) {
  struct Axis {
    std::map<std::pair<double, double>, Eigen::Index> number;
    std::vector<Eigen::Index> of;

    Axis(std::span<const Box2> boxes, int axis) {
      for (const Box2& b : boxes) {
        const double low = b.min()[axis], high = b.max()[axis];
        if (!(std::isfinite(low) && std::isfinite(high) && low < high))
          throw Error("average_covariance", concat("a box from ", low, " to ", high), "finite boxes of positive area");
        of.push_back(number.try_emplace({low, high}, static_cast<Eigen::Index>(number.size())).first->second);
      }
    }
  };
  const auto factors = [&](const Axis& a, const Axis& b) {
    Eigen::MatrixXd f(static_cast<Eigen::Index>(a.number.size()), static_cast<Eigen::Index>(b.number.size()));
    const std::vector<std::pair<std::pair<double, double>, Eigen::Index>> column(b.number.begin(), b.number.end());
    parallel_for_blocks(column.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j)
        for (const auto& [interval, i] : a.number)
          f(i, column[j].second) =
              kernel.average({interval.first, interval.second}, {column[j].first.first, column[j].first.second});
    });
    return f;
  };
  const Axis row_x(rows, 0), row_y(rows, 1), column_x(columns, 0), column_y(columns, 1);
  const Eigen::MatrixXd x = factors(row_x, column_x), y = factors(row_y, column_y);
  Eigen::MatrixXd k(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  dense::for_tiles(
      k.cols(),
      [&](Eigen::Index begin, Eigen::Index count) {
        for (Eigen::Index j = begin; j < begin + count; ++j) {
          const double* fx = x.col(column_x.of[static_cast<std::size_t>(j)]).data();
          const double* fy = y.col(column_y.of[static_cast<std::size_t>(j)]).data();
          for (std::size_t i = 0; i < rows.size(); ++i)
            k(static_cast<Eigen::Index>(i), j) = kernel.variance * fx[row_x.of[i]] * fy[row_y.of[i]];
        }
      },
      32);
  return k;
}

/// Boxes of a regular grid over an area, row by row from its lower corner.
inline std::vector<Box2> grid_boxes(const Box2& area, int columns, int rows) {
  Check check("grid_boxes");
  check(columns >= 1 && columns <= 1 << 14, "columns", columns, "1 to 16384");
  check(rows >= 1 && rows <= 1 << 14, "rows", rows, "1 to 16384");
  check.done();
  std::vector<Box2> boxes;
  const auto corner = [&](int ix, int iy) {
    return Eigen::Vector2d(area.min().x() + area.sizes().x() * ix / columns,
                           area.min().y() + area.sizes().y() * iy / rows);
  };
  for (int iy = 0; iy < rows; ++iy)
    for (int ix = 0; ix < columns; ++ix) boxes.emplace_back(corner(ix, iy), corner(ix + 1, iy + 1));
  return boxes;
}

/// Averages of the field over boxes, in their order.
struct Decompressed {
  Eigen::VectorXd mean, variance;
};

/// A higher resolution after the mission (Fig. 3.4h; Reece et al. for the idea): what a map of merged cells c, with
/// beliefs m and P, says about averages over any boxes, through the prior's correlations,
///
///     m* = mu + K*c Kcc^-1 (m - mu),    P* = K** - K*c Kcc^-1 (Kcc - P) Kcc^-1 Kc*.
///
/// Needs a map of cell averages whose belief says how cells covary: `covariance_matrix(tree)` or `covariance(i, j)`.
/// `jitter`, in shares of the prior variance, is added to Kcc's diagonal; it smooths away up to jitter |Kcc^-1 (m -
/// mu)| of a cell's deviation. n^3 / 3 + 3 n^2 q flops for n cells and q boxes; 2 n^2 + n q numbers. Throws Error on
/// bad boxes, or a prior that is not positive definite to working precision with this jitter.
template <SeparableKernel Kernel, class Cells, class Belief, class Resolution, class Sensor>
Decompressed decompress(const IntegralGp<Kernel, Cells, Belief, Resolution, Sensor>& map, std::span<const Box2> boxes,
                        double jitter = 1e-8) {
  static_assert(std::is_same_v<Cells, CellAverage>,
                "decompress: the map's cells must stand for averages (CellAverage)");
  constexpr bool whole = requires { map.belief().covariance_matrix(map.tree()); };
  static_assert(
      whole || requires { map.belief().covariance(std::size_t{}, std::size_t{}); },
      "decompress: the map's belief must say how cells covary: Full and Latent do, Diagonal does not");
  Check check("decompress");
  check(jitter > 0 && jitter <= 1e-3, "jitter", jitter, "0 (excluded) to 1e-3");
  check.done();
  const auto& c = map.config();
  const auto n = static_cast<Eigen::Index>(map.size());
  std::vector<Box2> cells;
  for (std::size_t i = 0; i < map.size(); ++i) cells.push_back(map.cell(i));

  Eigen::MatrixXd kcc = average_covariance(c.kernel, cells, cells);
  Eigen::MatrixXd explained = kcc;  // Kcc - P
  if constexpr (whole) {
    explained -= map.belief().covariance_matrix(map.tree());
  } else {
    dense::for_tiles(
        n,
        [&](Eigen::Index begin, Eigen::Index count) {
          for (Eigen::Index j = begin; j < begin + count; ++j)
            for (Eigen::Index i = 0; i < n; ++i)
              explained(i, j) -= map.belief().covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
        },
        32);
  }
  kcc.diagonal().array() += jitter * c.kernel.variance;
  dense::cholesky<double>(kcc, "decompress");
  const auto lower = kcc.triangularView<Eigen::Lower>();
  Eigen::VectorXd alpha = Eigen::VectorXd::NullaryExpr(
      n, [&](Eigen::Index i) { return map.mean(static_cast<std::size_t>(i)) - c.prior_mean; });
  lower.solveInPlace(alpha);
  lower.adjoint().solveInPlace(alpha);

  Decompressed out;
  out.mean.resize(static_cast<Eigen::Index>(boxes.size()));
  out.variance.resize(out.mean.size());
  const Eigen::MatrixXd cross = average_covariance(c.kernel, cells, boxes);
  dense::for_tiles(
      cross.cols(),
      [&](Eigen::Index begin, Eigen::Index count) {
        const auto k = cross.middleCols(begin, count);
        out.mean.segment(begin, count) = (k.transpose() * alpha).array() + c.prior_mean;
        Eigen::MatrixXd x = k;
        lower.solveInPlace(x);
        lower.adjoint().solveInPlace(x);
        const Eigen::VectorXd lost = x.cwiseProduct(explained * x).colwise().sum();
        for (Eigen::Index j = 0; j < count; ++j) {
          const Box2& b = boxes[static_cast<std::size_t>(begin + j)];
          const Interval bx{b.min().x(), b.max().x()}, by{b.min().y(), b.max().y()};
          out.variance[begin + j] =
              std::max(0.0, c.kernel.variance * c.kernel.average(bx, bx) * c.kernel.average(by, by) - lost[j]);
        }
      },
      128);
  return out;
}

}  // namespace vantage
