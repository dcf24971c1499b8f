// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/sizing/sizing_field.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "discretise/sizing/tissue_lookup.hpp"
#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/grid_cell.hpp"
#include "segmentation/geometry/point_tree.hpp"

namespace brainshift::discretise {
namespace {

/// How fast the spacing may grow away from a fine place, mm a mm.
constexpr double growth = 0.25;
/// The grid of factors never has more points than this.
constexpr double most_samples = 4e6;

/// Points within whose reach the spacing is finer.
class FinePlaces {
 public:
  FinePlaces(Points places, double reach, double factor)
      : points_(std::move(places)), tree_(points_), reach_(reach), factor_(factor) {}

  /// Of the spacing there; beyond the reach it grows. spacing: the uniform one.
  double factor(const Eigen::Vector3d& x, double spacing) const {
    const double distance = std::sqrt(tree_.nearest(x.data()).second);
    return factor_ + growth * std::max(0.0, distance - reach_) / spacing;
  }

 private:
  Points points_;
  PointTree tree_;
  double reach_;
  double factor_;
};

using FineList = std::deque<FinePlaces>;  // where each is built it stays: its tree refers to its points

std::shared_ptr<const FineList> fine_places(const LabelMap* labels, const DiscretiseOptions& options) {
  const auto fine = std::make_shared<FineList>();
  const auto add = [&](Points places, double reach, double factor) {
    if (places.rows() > 0) {
      fine->emplace_back(std::move(places), reach, factor);
    }
  };
  if (options.craniotomy && options.craniotomy->factor < 1) {
    add(distinct_points(options.craniotomy->centres), options.craniotomy->radius, options.craniotomy->factor);
  }
  const double voxel_radius = labels == nullptr ? 0.0 : 0.5 * labels->geometry.spacing.norm();
  if (labels != nullptr && options.tumour_factor < 1) {
    add(label_voxels(*labels, options.tumour_label), voxel_radius, options.tumour_factor);
  }
  if (labels != nullptr && options.tissue_boundary_factor < 1) {
    add(tissue_boundary(*labels, options.brain_labels, options.alike), voxel_radius, options.tissue_boundary_factor);
  }
  return fine;
}

}  // namespace

SizingField::SizingField(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double step,
                         const std::function<double(const Eigen::Vector3d&)>& factor)
    : low_(low), step_(step) {
  size_ = ((high - low) / step).array().ceil().cast<int>() + 1;
  const Eigen::Index slice = Eigen::Index{size_.x()} * size_.y();
  factor_.resize(static_cast<std::size_t>(slice * size_.z()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < size_.z(); ++k) {
    for (Eigen::Index in_slice = 0; in_slice < slice; ++in_slice) {
      const Eigen::Vector3d index(static_cast<double>(in_slice % size_.x()), static_cast<double>(in_slice / size_.x()),
                                  static_cast<double>(k));
      factor_[static_cast<std::size_t>(k * slice + in_slice)] = factor(low + step * index);
    }
  }
}

double SizingField::factor(const Eigen::Vector3d& x) const {
  const GridCell cell(size_, (x - low_) / step_);
  return cell.interpolate([this](std::size_t offset) { return factor_[offset]; });
}

double SizingField::smallest() const {
  return *std::min_element(factor_.begin(), factor_.end());
}

std::function<SizingField(double spacing)> sizing_by_spacing(const Surface& surface, const LabelMap* labels,
                                                             const DiscretiseOptions& options) {
  const std::shared_ptr<const FineList> fine = fine_places(labels, options);
  const Eigen::Vector3d low = surface.vertices.colwise().minCoeff();
  const Eigen::Vector3d high = surface.vertices.colwise().maxCoeff();
  return [=](double spacing) -> SizingField {
    if (fine->empty()) {
      return {};
    }
    const auto factor = [&](const Eigen::Vector3d& x) {
      double least = 1;
      for (const FinePlaces& places : *fine) {
        least = std::min(least, places.factor(x, spacing));
      }
      return least;
    };
    const double step = std::max(0.5 * spacing, std::cbrt((high - low).prod() / most_samples));
    return {low, high, step, factor};
  };
}

}  // namespace brainshift::discretise
