// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/pressure_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace brainshift::solve {

namespace {

constexpr double tie = 1e-9;  // of a sum: so far rounding does not decide

/// Positions in steps of a hundred millionth of the body. Points of regular cells lie level in rows, and it must not be
/// rounding that decides on which side of a cut they come: the patches would depend on where the body lies.
Points without_rounding(const Points& positions) {
  constexpr double steps = 1e8;
  const Eigen::RowVector3d low = positions.colwise().minCoeff();
  const double extent = (positions.colwise().maxCoeff() - low).maxCoeff();
  return ((positions.rowwise() - low) * (steps / (extent > 0 ? extent : 1))).array().round();
}

class Halving {
 public:
  Halving(const Points& positions, std::span<const double> share, double nodes_per_patch, PressurePatches& out)
      : positions_(without_rounding(positions)), share_(share), nodes_per_patch_(nodes_per_patch), out_(out) {}

  void split(std::span<std::int32_t> points) {
    const double total = nodes_of(points);
    const double parts = std::min(std::round(total / nodes_per_patch_), static_cast<double>(points.size()));
    if (parts < 2 || points.size() < 2) {
      out_.begin.push_back(out_.begin.back() + static_cast<std::int32_t>(points.size()));
      return;
    }
    sort_along_longest_side(points);
    const double wanted = total * std::floor(parts / 2) / parts;
    std::size_t cut = 0;
    double before = 0;
    while (cut + 1 < points.size() && (cut == 0 || before + share_at(points[cut]) / 2 < wanted - tie * total)) {
      before += share_at(points[cut++]);
    }
    split(points.first(cut));
    split(points.subspan(cut));
  }

 private:
  double share_at(std::int32_t point) const { return share_[static_cast<std::size_t>(point)]; }

  double nodes_of(std::span<const std::int32_t> points) const {
    return std::accumulate(points.begin(), points.end(), 0.0,
                           [this](double sum, std::int32_t p) { return sum + share_at(p); });
  }

  void sort_along_longest_side(std::span<std::int32_t> points) const {
    Eigen::RowVector3d low = positions_.row(points[0]), high = low;
    for (const std::int32_t p : points) {
      low = low.cwiseMin(positions_.row(p));
      high = high.cwiseMax(positions_.row(p));
    }
    constexpr double level = 4;  // steps
    const Eigen::RowVector3d side = high - low;
    Eigen::Index axis = side[1] > side[0] + level ? 1 : 0;
    axis = side[2] > side[axis] + level ? 2 : axis;
    std::sort(points.begin(), points.end(), [this, axis](std::int32_t a, std::int32_t b) {
      for (Eigen::Index i = axis; i < axis + 3; ++i) {  // points that lie level by the next axis
        const double xa = positions_(a, i % 3), xb = positions_(b, i % 3);
        if (xa != xb) {
          return xa < xb;
        }
      }
      return a < b;
    });
  }

  const Points positions_;
  std::span<const double> share_;
  double nodes_per_patch_;
  PressurePatches& out_;
};

}  // namespace

PressurePatches pressure_patches(const Points& positions, std::span<const double> share,
                                 std::span<const std::int32_t> material, double nodes_per_patch) {
  PressurePatches patches;
  patches.begin.push_back(0);
  patches.order.resize(share.size());
  std::iota(patches.order.begin(), patches.order.end(), 0);
  std::stable_sort(patches.order.begin(), patches.order.end(), [&](std::int32_t a, std::int32_t b) {
    return material[static_cast<std::size_t>(a)] < material[static_cast<std::size_t>(b)];
  });
  Halving halving(positions, share, nodes_per_patch, patches);
  for (auto first = patches.order.begin(); first != patches.order.end();) {
    const auto last = std::find_if(first, patches.order.end(), [&](std::int32_t p) {
      return material[static_cast<std::size_t>(p)] != material[static_cast<std::size_t>(*first)];
    });
    halving.split({first, last});
    first = last;
  }
  return patches;
}

void pressure_modes(const Points& positions, std::span<const double> volume, std::span<const std::int32_t> points,
                    std::span<double> modes) {
  constexpr double smallest = 1e-3;  // of a mode's norm before and after: below it the points lie in a plane
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> p(n, 4);
  Eigen::VectorXd w(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::int32_t point = points[static_cast<std::size_t>(i)];
    w[i] = volume[static_cast<std::size_t>(point)];
    p.row(i) << 1, positions.row(point) - positions.row(points[0]);
  }
  const double size = p.rightCols<3>().rowwise().norm().maxCoeff();
  for (int k = 0; k < 4; ++k) {
    for (int repeat = 0; repeat < 2; ++repeat) {  // twice is enough
      for (int j = 0; j < k; ++j) {
        p.col(k) -= p.col(j) * p.col(j).cwiseProduct(w).dot(p.col(k));
      }
    }
    const double norm = std::sqrt(p.col(k).cwiseAbs2().dot(w));
    const double reference = k == 0 ? 0 : smallest * size * std::sqrt(w.sum());
    p.col(k) *= norm > reference ? 1 / norm : 0.0;
  }
  std::copy_n(p.data(), 4 * n, modes.begin());
}

}  // namespace brainshift::solve
