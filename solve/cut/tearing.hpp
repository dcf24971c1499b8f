// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solve/force/point_strain.hpp"
#include "solve/interface/cut.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// What a tear adds.
struct Tear {
  Cut segment;         ///< from the tip to where it comes
  bool meets = false;  ///< it ends at another cut
};

/// Where a plane body tears, by its criterion. Ahead of a tip counts the mean over the integration points within the
/// criterion's distance; elsewhere that about a point. A tear runs across the largest principal stretch there, in the
/// undeformed body, and turns by 70 degrees at most at a time.
class Tearing {
 public:
  /// points: of the whole body, in the order of `strains` below; held: places that are clamped: within two spacings of
  /// them nothing tears; stride: how far a tear goes on at a time, mm.
  Tearing(const Rupture& rupture, const IntegrationPoints& points, const Points& held, double spacing, double stride);

  /// What tears now: a segment for each tip where the criterion is met, and one where a tear begins, at the place that
  /// exceeds its strength most, far from cuts that are there.
  /// A tear begins only if it may and none goes on.
  std::vector<Tear> next(const CutFacets& cut, std::span<const PointStrain> strains, bool may_begin) const;

  /// These places go no further.
  void arrest(const Eigen::Vector3d& tip) { arrested_.push_back(tip); }

 private:
  struct Mean {
    double load = 0;  ///< over strength
    Eigen::Matrix2d right_cauchy_green = Eigen::Matrix2d::Zero();
  };
  double load(std::size_t point, std::span<const PointStrain> strains) const;
  Mean mean_about(const Eigen::Vector3d& place, const Eigen::Vector3d& ahead,
                  std::span<const PointStrain> strains) const;
  void begin(const CutFacets& cut, std::span<const PointStrain> strains, std::vector<Tear>& tears) const;

  Rupture rupture_;
  const IntegrationPoints& points_;
  double distance_, stride_;
  std::vector<double> share_;  ///< of the strength that each point has
  std::vector<Eigen::Vector3d> arrested_;
};

}  // namespace brainshift::solve
