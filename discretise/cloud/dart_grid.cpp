// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/dart_grid.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::discretise {
namespace {

constexpr double most_buckets = 5e7;

}  // namespace

DartGrid::DartGrid(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double reach)
    : low_(low), edge_(std::max(reach, std::cbrt((high - low).prod() / most_buckets))) {
  size_ = ((high - low) / edge_).array().floor().cast<int>() + 1;
  first_.assign(index_of(size_ - 1) + 1, -1);
}

Eigen::Array3i DartGrid::bucket_of(const Eigen::Vector3d& x) const {
  return ((x - low_) / edge_).array().floor().cast<int>().max(0).min(size_ - 1);
}

std::size_t DartGrid::index_of(const Eigen::Array3i& bucket) const {
  const Eigen::Index row = Eigen::Index{bucket.z()} * size_.y() + bucket.y();
  return static_cast<std::size_t>(row * size_.x() + bucket.x());
}

bool DartGrid::is_free(const Eigen::Vector3d& x, double distance) const {
  const Eigen::Array3i centre = bucket_of(x);
  const Eigen::Array3i from = (centre - 1).max(0);
  const Eigen::Array3i to = (centre + 1).min(size_ - 1);
  for (int k = from.z(); k <= to.z(); ++k) {
    for (int j = from.y(); j <= to.y(); ++j) {
      for (int i = from.x(); i <= to.x(); ++i) {
        for (std::int32_t p = first_[index_of({i, j, k})]; p >= 0; p = next_[static_cast<std::size_t>(p)]) {
          if ((points_[static_cast<std::size_t>(p)] - x).squaredNorm() < distance * distance) {
            return false;
          }
        }
      }
    }
  }
  return true;
}

void DartGrid::accept(const Eigen::Vector3d& x) {
  const std::size_t bucket = index_of(bucket_of(x));
  next_.push_back(first_[bucket]);
  first_[bucket] = static_cast<std::int32_t>(points_.size());
  points_.push_back(x);
}

}  // namespace brainshift::discretise
