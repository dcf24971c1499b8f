// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/sizing/sizing_field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

double distance_to(const PointTree& tree, const Eigen::Vector3d& x) {
  return std::sqrt(tree.nearest(x.data()).second);
}

/// `factor` up to `radius`, then linearly back to 1 over the same distance.
double craniotomy_factor(const Refinement& refinement, double distance) {
  const double back = std::clamp(distance / refinement.radius - 1.0, 0.0, 1.0);
  return refinement.factor + (1.0 - refinement.factor) * back;
}

/// Points near which the spacing is finer, with their search tree.
struct FinePlaces {
  FinePlaces(Points places, double f) : points(std::move(places)), tree(points), factor(f) {}

  Points points;
  PointTree tree;
  double factor;
};

void make(std::optional<FinePlaces>& places, Points points, double factor) {
  if (points.rows() > 0) {
    places.emplace(std::move(points), factor);
  }
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

SizingField sizing_field(const Surface& surface, const LabelMap* labels, const DiscretiseOptions& options,
                         double spacing) {
  std::optional<FinePlaces> opening;
  std::optional<FinePlaces> tumour;
  std::optional<FinePlaces> boundary;
  if (options.craniotomy && options.craniotomy->factor < 1) {
    make(opening, distinct_points(options.craniotomy->centres), options.craniotomy->factor);
  }
  if (labels != nullptr && options.tumour_factor < 1) {
    make(tumour, label_voxels(*labels, options.tumour_label), options.tumour_factor);
  }
  if (labels != nullptr && options.tissue_boundary_factor < 1) {
    make(boundary, tissue_boundary(*labels, options.brain_labels), options.tissue_boundary_factor);
  }
  if (!opening && !tumour && !boundary) {
    return {};
  }
  const double voxel_radius = labels == nullptr ? 0.0 : 0.5 * labels->geometry.spacing.norm();
  const auto grown = [&](const FinePlaces& places, const Eigen::Vector3d& x) {
    return places.factor + growth * std::max(0.0, distance_to(places.tree, x) - voxel_radius) / spacing;
  };
  const auto factor = [&](const Eigen::Vector3d& x) {
    double result = opening ? craniotomy_factor(*options.craniotomy, distance_to(opening->tree, x)) : 1.0;
    result = tumour ? std::min(result, grown(*tumour, x)) : result;
    result = boundary ? std::min(result, grown(*boundary, x)) : result;
    return std::min(1.0, result);
  };
  const Eigen::Vector3d low = surface.vertices.colwise().minCoeff();
  const Eigen::Vector3d high = surface.vertices.colwise().maxCoeff();
  const double step = std::max(0.5 * spacing, std::cbrt((high - low).prod() / most_samples));
  return {low, high, step, factor};
}

}  // namespace brainshift::discretise
