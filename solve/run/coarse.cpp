// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/coarse.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solve/cut/boundary_normals.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/quadrature/missing_octants.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/shape_matrix.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

constexpr double least_distance = 0.705;  // of chosen nodes, over their own spacing
constexpr double looser = 0.1;            // stop, over the region's displacement

/// Loaded nodes first, then the surface, then the inside; each in the cloud's order.
std::vector<std::int32_t> by_importance(const NodeCloud& cloud, const Conditions& conditions) {
  std::vector<std::int32_t> order;
  for (const int wanted : {0, 1, 2}) {
    for (std::size_t a = 0; a < cloud.size(); ++a) {
      const auto node = static_cast<std::int32_t>(a);
      const int rank = conditions.is_prescribed(node) ? 0 : cloud.on_surface[a] != 0 ? 1 : 2;
      if (rank == wanted) {
        order.push_back(node);
      }
    }
  }
  return order;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> shape_at(const ShapeFunctions& shape, const Points& positions,
                                                      Eigen::Index nodes) {
  return shape_matrix(shape.evaluate(positions, false), nodes);
}

/// Forces on all nodes, (n × 3) N, at the coarse ones: their sum and their moments stay. The coarse shape functions
/// spread them once more, as all forces on nodes.
Points forces_on_coarse(const Points& force, const Points& positions, const NodeCloud& coarse,
                        const ShapeOptions& options) {
  const ShapeFunctions shape(coarse.positions, coarse.spacing, options);
  return shape_at(shape, positions, coarse.positions.rows()).transpose() * force;
}

/// All free surface nodes of the cloud may touch the skull, moved by the coarse parameters: coarse nodes alone would
/// let the surface between them through, and the body sink by tenths of a millimetre.
void touch_with_whole_surface(const Model& model, const ShapeOptions& options,
                              std::shared_ptr<const Visibility> visibility, Body& body) {
  const std::vector<std::int32_t> surface = free_surface_nodes(model.cloud, model.conditions);
  std::vector<std::int32_t> ordinal(surface.size());
  std::iota(ordinal.begin(), ordinal.end(), 0);
  const Points positions = model.cloud.positions(surface, Eigen::all);
  std::vector<double> spacing;
  for (const std::int32_t a : body.original) {
    spacing.push_back(body.spacing[static_cast<std::size_t>(a)]);
  }
  const ShapeFunctions shape(body.positions(body.original, Eigen::all), spacing, options, std::move(visibility));
  body.contact.emplace(std::shared_ptr(body.contact->skull()), positions, ordinal, shape.evaluate(positions, false));
}

std::vector<std::int32_t> nodes_apart(const NodeCloud& cloud, const Conditions& conditions, double wider) {
  const SupportSearch search(cloud.positions, cloud.spacing);
  std::vector<std::uint8_t> excluded(cloud.size(), 0);
  std::vector<std::int32_t> chosen;
  std::vector<std::int32_t> near;
  for (const std::int32_t a : by_importance(cloud, conditions)) {
    if (excluded[static_cast<std::size_t>(a)] != 0) {
      continue;
    }
    chosen.push_back(a);
    search.find(cloud.positions.row(a), least_distance * wider, near);
    for (const std::int32_t node : near) {
      excluded[static_cast<std::size_t>(node)] = 1;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

std::vector<std::int32_t> coarse_nodes(const NodeCloud& cloud, const Conditions& conditions) {
  return nodes_apart(cloud, conditions, coarser);
}

CoarseBody coarse_body(const std::vector<std::int32_t>& nodes, const Model& model, const SolveOptions& given,
                       const Progress& progress, bool keep_parts, double wider) {
  CoarseBody coarse{.model = model, .options = given, .measures = {}, .prepared = {}};
  coarse.model.cloud = subset(model.cloud, nodes);
  coarse.model.conditions = subset(model.conditions, nodes);
  coarse.model.conditions.at_nodes_alone = true;
  for (double& spacing : coarse.model.cloud.spacing) {
    spacing *= wider;
  }
  if (is_planar(model.cells.kind)) {  // the coarse surface nodes tell less of the body's outline
    if (Surface boundary = known_boundary(model); boundary.triangles.rows() > 0) {
      coarse.model.boundary = std::move(boundary);
    }
    if (std::optional<BackgroundCells> cells = with_missing_octants(model.cells, model.boundary, model.cloud)) {
      coarse.model.cells = std::move(*cells);
    }
  }
  if (model.resection) {
    coarse.measures.resection.emplace();  // stepping measures the wall into it
  }
  coarse.options.region = 0;
  coarse.options.points_per_cell = 1;
  coarse.options.shape = {.basis = Basis::linear, .derivatives = given.shape.derivatives, .planar = given.shape.planar};
  if (model.conditions.force.rows() > 0) {
    coarse.model.conditions.force =
        forces_on_coarse(model.conditions.force, model.cloud.positions, coarse.model.cloud, coarse.options.shape);
  }
  coarse.options.snapshot_every = 0;
  coarse.options.tolerance = std::max(given.tolerance, looser * given.region);
  coarse.prepared = prepare(coarse.model, coarse.options, {}, coarse.measures, progress, keep_parts);
  if (coarse.prepared.body.contact) {
    touch_with_whole_surface(model, coarse.options.shape,
                             coarse.prepared.cut ? coarse.prepared.cut->visibility : nullptr, coarse.prepared.body);
  }
  return coarse;
}

Points as_prescribed(Points displacement, const Model& model) {
  if (model.conditions.measured) {
    return displacement;  // what was measured gives way
  }
  const Points& prescribed = model.conditions.displacement;
  const double fraction = model.curve.at(model.curve.duration());
  for (Eigen::Index i = 0; i < prescribed.size(); ++i) {
    if (!std::isnan(prescribed.data()[i])) {
      displacement.data()[i] = fraction * prescribed.data()[i];
    }
  }
  return displacement;
}

FromCoarse::FromCoarse(const ShapeFunctions& shape, const NodeCloud& coarse, const Model& model)
    : model_(model),
      at_coarse_(shape_at(shape, coarse.positions, coarse.positions.rows())),
      at_all_(shape_at(shape, model.cloud.positions, coarse.positions.rows())) {}

Points FromCoarse::operator()(const Points& displacement) const {
  return as_prescribed(at_all_ * parameters_from_displacement(at_coarse_, displacement), model_);
}

namespace {

std::optional<CoarseSolution> solved_on(const std::vector<std::int32_t>& nodes, double wider, const Model& model,
                                        const SolveOptions& given, const Progress& progress) {
  auto [coarse, options, measures, prepared] = coarse_body(nodes, model, given, progress, false, wider);
  const SolveResult result = step_to_end(coarse, options, std::move(prepared), measures, {}, progress);
  if (result.rounded) {
    SolveOptions doubled = given;
    doubled.precision = Precision::double_precision;
    return solved_on(nodes, wider, model, doubled, progress);
  }
  if (!result.failure.empty()) {
    return std::nullopt;
  }
  return CoarseSolution{as_prescribed(displacement_at(result.solution, model.cloud.positions), model),
                        result.measures.error_bound, result.measures.steps, wider};
}

/// Empty as coarse_solution().
std::optional<CoarseSolution> solved_with(double wider, const Model& model, const SolveOptions& options,
                                          const Progress& progress) {
  const std::vector<std::int32_t> nodes = nodes_apart(model.cloud, model.conditions, wider);
  if (nodes.size() < fewest_coarse_nodes) {
    return std::nullopt;
  }
  SolveOptions own = options;
  if (own.device == Device::cuda) {
    own.device = Device::automatic;  // what the whole cloud's answer can do without is no reason to refuse it
  }
  try {
    return solved_on(nodes, wider, model, own, progress);
  } catch (const std::logic_error&) {
    return std::nullopt;  // what the whole cloud holds in place, the coarse one may not
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<CoarseSolution> coarse_solution(const Model& model, const SolveOptions& options,
                                              const Progress& progress) {
  return solved_with(coarser, model, options, progress);
}

std::optional<CoarseSolution> less_coarse_solution(const Model& model, const SolveOptions& options,
                                                   const Progress& progress) {
  constexpr std::size_t small_cloud = 1000;  // nodes
  constexpr double wider = 1.5;
  return model.cloud.size() <= small_cloud ? solved_with(wider, model, options, progress) : std::nullopt;
}

std::optional<Points> coarse_displacement(const Model& model, const SolveOptions& options, const Progress& progress) {
  std::optional<CoarseSolution> solution = coarse_solution(model, options, progress);
  return solution ? std::optional(std::move(solution->displacement)) : std::nullopt;
}

}  // namespace brainshift::solve
