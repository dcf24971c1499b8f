// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace brainshift::discretise {

/// Accepted points in buckets, to ask whether a new one is far enough from all of them.
class DartGrid {
 public:
  /// Points lie in the box [low, high]; no distance asked for exceeds `reach`, mm.
  DartGrid(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double reach);

  /// No accepted point is nearer to x than `distance` (at most the reach).
  bool is_free(const Eigen::Vector3d& x, double distance) const;
  void accept(const Eigen::Vector3d& x);

 private:
  Eigen::Array3i bucket_of(const Eigen::Vector3d& x) const;
  std::size_t index_of(const Eigen::Array3i& bucket) const;

  Eigen::Vector3d low_;
  double edge_;
  Eigen::Array3i size_;
  std::vector<std::int32_t> first_;  ///< newest point in each bucket, -1 for none
  std::vector<std::int32_t> next_;   ///< the one before it in the same bucket
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace brainshift::discretise
