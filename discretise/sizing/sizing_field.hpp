// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "discretise/interface/options.hpp"
#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::discretise {

/// The wanted local spacing as a fraction of the uniform one, sampled on a grid: 1 where nothing asks for finer nodes.
class SizingField {
 public:
  /// 1 everywhere.
  SizingField() = default;
  /// `factor` sampled over the box [low, high] with the given grid step, mm.
  SizingField(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double step,
              const std::function<double(const Eigen::Vector3d&)>& factor);

  /// In (0, 1]; the box's border continues outside it.
  double factor(const Eigen::Vector3d& x) const;
  double smallest() const;
  bool is_uniform() const { return factor_.size() == 1; }

 private:
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  double step_ = 1;
  Eigen::Array3i size_ = Eigen::Array3i::Ones();
  std::vector<double> factor_ = {1.0};
};

/// The field that the options ask for over the box of a surface, by the uniform spacing, mm. Away from where it is
/// finer the spacing grows by a quarter of the distance. Where that is, is found once: labels are read here alone.
std::function<SizingField(double spacing)> sizing_by_spacing(const Surface& surface, const LabelMap* labels,
                                                             const DiscretiseOptions& options);

}  // namespace brainshift::discretise
