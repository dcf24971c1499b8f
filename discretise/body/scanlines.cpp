// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/body/scanlines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace brainshift::discretise {
namespace {

/// On which side of the edge from a to b a line through (y, z) passes.
struct Side {
  double area;    ///< twice the signed area of (a, b, line) in the y-z plane
  bool positive;  ///< its sign; never undecided
};

/// Computed from the lower to the higher vertex always, so that both triangles at an edge see opposite numbers. A line
/// that meets the edge is taken to pass a hair farther in y, and yet less in z: the same way for all edges, so that the
/// parity holds for a line through a vertex too (simulation of simplicity, Edelsbrunner & Mücke 1990).
Side side_of_edge(const Points& vertices, std::int32_t a, std::int32_t b, double y, double z) {
  const bool swapped = a > b;
  const auto from = vertices.row(swapped ? b : a);
  const auto to = vertices.row(swapped ? a : b);
  const double dy = to[1] - from[1];
  const double dz = to[2] - from[2];
  const double area = dy * (z - from[2]) - dz * (y - from[1]);
  const bool positive = area > 0 || (area == 0 && (dz < 0 || (dz == 0 && dy > 0)));
  return {swapped ? -area : area, positive != swapped};
}

/// Calls visit(bucket) for the buckets that the triangle's box overlaps.
template <class Visit>
void for_buckets(const Surface& surface, Eigen::Index triangle, const Eigen::Vector2d& low, double edge,
                 Eigen::Index count_y, Eigen::Index count_z, const Visit& visit) {
  Eigen::Vector2d from = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d to = -from;
  for (int corner = 0; corner < 3; ++corner) {
    const auto vertex = surface.vertices.row(surface.triangles(triangle, corner));
    const Eigen::Vector2d p(vertex[1], vertex[2]);
    from = from.cwiseMin(p);
    to = to.cwiseMax(p);
  }
  const auto index = [&](double x, double origin, Eigen::Index count) {
    return std::clamp<Eigen::Index>(static_cast<Eigen::Index>((x - origin) / edge), 0, count - 1);
  };
  for (Eigen::Index iz = index(from[1], low[1], count_z); iz <= index(to[1], low[1], count_z); ++iz) {
    for (Eigen::Index iy = index(from[0], low[0], count_y); iy <= index(to[0], low[0], count_y); ++iy) {
      visit(iy, iz);
    }
  }
}

/// Of the stretches between pairs of x what lies between pairs of others (within), or does not.
void keep_common(bool within, const std::vector<double>& others, std::vector<double>& x) {
  std::vector<std::pair<double, bool>> ends;  // whose they are
  for (const double end : x) {
    ends.emplace_back(end, true);
  }
  for (const double end : others) {
    ends.emplace_back(end, false);
  }
  std::sort(ends.begin(), ends.end());
  bool in_body = false, in_other = false, in_both = false;
  x.clear();
  for (const auto& [end, of_body] : ends) {
    (of_body ? in_body : in_other) = !(of_body ? in_body : in_other);
    const bool now = in_body && in_other == within;
    if (now != in_both) {
      x.push_back(end);
      in_both = now;
    }
  }
}

}  // namespace

Scanlines::Scanlines(const Surface& surface) : surface_(surface) {
  low_ = surface_.vertices.rightCols<2>().colwise().minCoeff();
  high_ = surface_.vertices.rightCols<2>().colwise().maxCoeff();
  const Eigen::Vector2d extent = high_ - low_;
  const auto triangles = static_cast<double>(surface_.triangles.rows());
  bucket_edge_ = std::max(std::sqrt(extent.prod() / (1.0 + triangles)), 1e-9 * extent.maxCoeff());
  buckets_y_ = static_cast<Eigen::Index>(extent[0] / bucket_edge_) + 1;
  buckets_z_ = static_cast<Eigen::Index>(extent[1] / bucket_edge_) + 1;

  begin_.assign(static_cast<std::size_t>(buckets_y_ * buckets_z_) + 1, 0);
  const auto visit_all = [&](const auto& visit) {
    for (Eigen::Index t = 0; t < surface_.triangles.rows(); ++t) {
      for_buckets(surface_, t, low_, bucket_edge_, buckets_y_, buckets_z_,
                  [&](Eigen::Index iy, Eigen::Index iz) { visit(t, bucket(iy, iz)); });
    }
  };
  visit_all([&](Eigen::Index, std::size_t b) { ++begin_[b + 1]; });
  for (std::size_t b = 1; b < begin_.size(); ++b) {
    begin_[b] += begin_[b - 1];
  }
  triangle_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  visit_all([&](Eigen::Index t, std::size_t b) { triangle_[next[b]++] = static_cast<std::int32_t>(t); });
}

void Scanlines::collect(double y, double z, std::vector<double>& x) const {
  x.clear();
  if (!(y >= low_[0] && y <= high_[0] && z >= low_[1] && z <= high_[1])) {
    return;
  }
  const auto iy = std::min(static_cast<Eigen::Index>((y - low_[0]) / bucket_edge_), buckets_y_ - 1);
  const auto iz = std::min(static_cast<Eigen::Index>((z - low_[1]) / bucket_edge_), buckets_z_ - 1);
  for (std::size_t k = begin_[bucket(iy, iz)]; k < begin_[bucket(iy, iz) + 1]; ++k) {
    const auto corner = surface_.triangles.row(triangle_[k]);
    const Side side[3] = {side_of_edge(surface_.vertices, corner[1], corner[2], y, z),
                          side_of_edge(surface_.vertices, corner[2], corner[0], y, z),
                          side_of_edge(surface_.vertices, corner[0], corner[1], y, z)};
    if (side[0].positive != side[1].positive || side[0].positive != side[2].positive) {
      continue;
    }
    const double total = side[0].area + side[1].area + side[2].area;
    if (total == 0) {
      continue;
    }
    double at = 0;
    for (int i = 0; i < 3; ++i) {
      at += side[i].area / total * surface_.vertices(corner[i], 0);
    }
    x.push_back(at);
  }
  std::sort(x.begin(), x.end());
}

Scanlines::Scanlines(const Scanlines& body, std::shared_ptr<const Scanlines> other, bool within) : Scanlines(body) {
  other_ = std::move(other);
  within_ = within;
}

void Scanlines::own_crossings(double y, double z, std::vector<double>& x) const {
  collect(y, z, x);
  // Rounding next to a vertex can still lose or double a crossing; a neighbouring line then answers.
  for (int attempt = 1; attempt <= 8 && x.size() % 2 != 0; ++attempt) {
    collect(y + attempt * 1e-7 * bucket_edge_, z + attempt * 0.7e-7 * bucket_edge_, x);
  }
  if (x.size() % 2 != 0) {
    x.clear();
  }
}

void Scanlines::crossings(double y, double z, std::vector<double>& x) const {
  own_crossings(y, z, x);
  if (!other_ || x.empty()) {
    return;
  }
  std::vector<double> others;
  other_->crossings(y, z, others);
  keep_common(within_, others, x);
}

bool Scanlines::inside(const Eigen::Vector3d& point) const {
  thread_local std::vector<double> x;
  crossings(point.y(), point.z(), x);
  return (std::lower_bound(x.begin(), x.end(), point.x()) - x.begin()) % 2 != 0;
}

}  // namespace brainshift::discretise
