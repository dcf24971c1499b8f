// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/interface/model.hpp"
#include "solve/interface/options.hpp"
#include "solve/run/prepare.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

/// About an eighth of the cloud's nodes, evenly: none nearer to another than a multiple of its spacing, the loaded ones
/// chosen first, then those on the surface, then the inner ones. Ascending.
std::vector<std::int32_t> coarse_nodes(const NodeCloud& cloud, const Conditions& conditions);

/// Spacing of coarse nodes over that of the cloud.
inline constexpr double coarser = 2;

/// A model on its coarse nodes, their spacing so many times as wide, with linear shape functions and one point a cell.
struct CoarseBody {
  Model model;
  SolveOptions options;
  SolveMeasures measures;  ///< as prepare() left them
  Prepared prepared;
};

/// Throws as prepare() does, which sees keep_parts.
CoarseBody coarse_body(const std::vector<std::int32_t>& nodes, const Model& model, const SolveOptions& options,
                       const Progress& progress, bool keep_parts = false, double wider = coarser);

/// A cloud with fewer coarse nodes is not solved on them.
inline constexpr std::size_t fewest_coarse_nodes = 24;

/// A displacement of another solution at all nodes, with what is prescribed exactly as it is at the end of the load's
/// curve.
Points as_prescribed(Points displacement, const Model& model);

/// Displacements of the coarse nodes, mm, at all nodes, as as_prescribed() has them: what the two clouds have to do
/// with each other is found once and kept.
class FromCoarse {
 public:
  /// shape: of the coarse cloud. The model must outlive this.
  FromCoarse(const ShapeFunctions& shape, const NodeCloud& coarse, const Model& model);

  /// Throws as parameters_from_displacement() does. Many threads may ask.
  Points operator()(const Points& displacement) const;

 private:
  const Model& model_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> at_coarse_, at_all_;  // shape functions at the nodes
};

struct CoarseSolution {
  Points displacement;     ///< at all nodes, (n × 3) mm, at the end of the load's curve
  double error_bound = 0;  ///< mm, of the coarse relaxation
  int steps = 0;           ///< that it took
  double wider = coarser;  ///< its spacing over that of the cloud
};

/// The solution on the coarse nodes with linear shape functions and one point a cell. Empty when that cannot be solved:
/// too few nodes, or refused, or not converged.
std::optional<CoarseSolution> coarse_solution(const Model& model, const SolveOptions& options,
                                              const Progress& progress);

/// Of a small cloud, on about a third of its nodes: it tells the error where the coarse one cannot be solved. It is no
/// start, as from it a cube pressed to 0.7 came to rest folded.
std::optional<CoarseSolution> less_coarse_solution(const Model& model, const SolveOptions& options,
                                                   const Progress& progress);

/// The displacement of coarse_solution() alone.
std::optional<Points> coarse_displacement(const Model& model, const SolveOptions& options, const Progress& progress);

}  // namespace brainshift::solve
