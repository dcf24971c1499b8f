// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "solve/arrays/lanes.hpp"
#include "solve/interface/shape_options.hpp"

namespace brainshift::solve {

/// Number of monomials up to an order (1 or 2): 4 or 10 in space, 3 or 6 in the plane.
constexpr int monomial_count(int dimensions, int order) {
  return order == 1 ? dimensions + 1 : (dimensions + 1) * (dimensions + 2) / 2;
}

/// Nodes that some points may see: places and support radii side by side.
struct Candidates {
  std::vector<std::int32_t> node;
  std::vector<double> x, y, z, radius;
};

/// A node as eight points see it, one a lane.
struct Neighbour {
  std::int32_t node;
  double radius;      ///< of its support, mm, as grown
  Lane away[3];       ///< X_a − x
  Lane distance;      ///< mm
  Lane weight;        ///< 0 where the node is not in the point's support
  Lane weight_slope;  ///< of the weight: its slope by the distance, over the distance
  Lane value;         ///< φ_a

  bool supports(int lane) const { return distance[lane] < radius; }
};

/// −½ ∂distance²/∂x of a Neighbour where a cut makes it other than `away`.
struct DistanceGradient {
  Lane axis[3];
};

/// ∂φ_a/∂x of a Neighbour, 1/mm.
struct ShapeGradient {
  Lane axis[3];
};

/// A ball about some places.
struct Ball {
  Eigen::Vector3d centre;
  double extent;
};

/// Eight places and a ball about them. Those that are to see nothing have an infinity.
struct PointLanes {
  Lane at[3];
  Lane unwanted;
  Ball ball;
};

struct FitOptions {
  int dimensions;         ///< 3, or 2: looks at x and y alone
  int order;              ///< of the basis, 1 or 2
  double penalty;         ///< κ of MMLS on the quadratic coefficients, 0 for plain MLS
  bool leave_to_penalty;  ///< accept quadratic terms that only the penalty holds
};

/// Moving least squares at eight points.
struct Fit {
  static constexpr int most = monomial_count(3, 2);
  Mask admissible;          ///< where the support determines the basis; elsewhere nothing else means anything
  Mask count;               ///< nodes in each support
  Lane length;              ///< by which coordinates are scaled, mm
  Lane factor[most][most];  ///< the moment matrix M as L D Lᵀ: L below the diagonal, 1 / D on it
  Lane coefficient[most];   ///< M⁻¹ p(x)
};

/// Neighbours among the candidates that the places may see, in the candidates' order; out has room for all. Returns how
/// many there are. scale: of the radii.
std::size_t find_neighbours(const Candidates& candidates, double scale, const PointLanes& places, Neighbour* out);

/// (Modified) moving least squares at eight points, METHOD.md (2) and (3), in local scaled coordinates ξ = (X_a − x)/r:
/// there p(x) is the first unit vector, and the moment matrix is well conditioned in any unit and at any offset. Fills
/// weights and values of the neighbours.
void fit_shape(std::span<Neighbour> neighbours, const FitOptions& options, Fit& fit);

/// Derivatives of what fit_shape() gave; in the plane those by z are 0. distance_gradients: one a neighbour, or none
/// where no cut is near.
void differentiate(std::span<const Neighbour> neighbours, std::span<const DistanceGradient> distance_gradients,
                   const FitOptions& options, Derivatives kind, const Fit& fit, ShapeGradient* out);

/// Σ φ_a values_a of each point; values (n × 3).
void blend(std::span<const Neighbour> neighbours, const Points& values, Lane (&sum)[3]);

/// The functions above for one instruction set.
struct FitKernels {
  const char* name;
  decltype(&find_neighbours) find;
  decltype(&fit_shape) fit;
  decltype(&differentiate) slopes;
  decltype(&blend) mean;
};

/// Those that this processor runs, the fastest first, which the functions above call.
std::span<const FitKernels> fit_kernels();

}  // namespace brainshift::solve
