// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/region/region.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/cut/resection.hpp"
#include "solve/interface/unfit_parts.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/missing_octants.hpp"
#include "solve/quadrature/taken_cells.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/step.hpp"
#include "solve/run/whole_body.hpp"
#include "solve/shape/node_supports.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

/// A cell is in the region when a node nearer to its centre than this share of the node's support radius moves enough.
constexpr double margin = 1;

/// Next to the rim are the region's nodes that move by less than this many times the region.
constexpr double next_to_rim = 2;

/// The coarse solution is trusted outside when it is wrong by less than this share of the region there: further out it
/// may be a little more wrong than where that can be seen.
constexpr double trusted = 0.75;

struct Region {
  std::vector<std::int32_t> nodes;  ///< kept, ascending
  std::vector<std::uint8_t> rim;    ///< one a kept node
  BackgroundCells cells;

  bool has_rim() const { return std::find(rim.begin(), rim.end(), 1) != rim.end(); }
  bool is_all_rim() const { return std::find(rim.begin(), rim.end(), 0) == rim.end(); }
};

/// One a cell: whether it moves by more than the region, with a margin about it.
std::vector<std::uint8_t> moving_cells(const BackgroundCells& cells, const SupportSearch& search,
                                       const Eigen::VectorXd& moved, double region) {
  std::vector<std::uint8_t> moving;
  std::vector<std::int32_t> near;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Eigen::Vector3d centre = corners_of(cells, cell).colwise().mean();
    search.find(centre, margin, near);
    const bool moves = std::any_of(near.begin(), near.end(), [&](std::int32_t node) { return moved[node] > region; });
    moving.push_back(moves ? 1 : 0);
  }
  return moving;
}

/// The nodes that the points of these cells see.
std::vector<std::uint8_t> seen_by(const BackgroundCells& cells, const Model& model, const SolveOptions& options,
                                  const ShapeFunctions& shape) {
  std::vector<std::uint8_t> seen(shape.nodes(), 0);
  if (cells.size() > 0) {
    const IntegrationPoints points =
        integration_points(cells, points_per_cell(options.points_per_cell, cells.kind, false),
                           model.labels ? &*model.labels : nullptr, tissues_of(model));
    for (const std::int32_t a : shape.evaluate(points.positions, false).node) {
      seen[static_cast<std::size_t>(a)] = 1;
    }
  }
  return seen;
}

/// By the points that the cells have where they are whole or have octants, as those will have that are solved.
Region choose(const Model& model, const SolveOptions& options, const Eigen::VectorXd& moved) {
  const NodeCloud& cloud = model.cloud;
  const std::optional<BackgroundCells> completed = with_missing_octants(model.cells, model.boundary, cloud);
  const BackgroundCells& cells = completed ? *completed : model.cells;
  const SupportSearch search(cloud.positions, support_radii(cloud.spacing, options.shape));
  const std::vector<std::uint8_t> moving = moving_cells(cells, search, moved, options.region);
  const ShapeFunctions shape(cloud.positions, cloud.spacing, options.shape);
  Region region;
  region.cells = taken_cells(cells, moving, 1);
  const auto inside = seen_by(region.cells, model, options, shape);
  const auto outside = seen_by(taken_cells(cells, moving, 0), model, options, shape);
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    if (inside[a] != 0) {
      region.nodes.push_back(static_cast<std::int32_t>(a));
      region.rim.push_back(outside[a]);
    }
  }
  return region;
}

/// The part of the model in the region, its rim moved as the coarse solution moves it.
Model part_of(const Model& model, const Region& region, const Points& coarse) {
  Model part = model;
  part.cloud = subset(model.cloud, region.nodes);
  part.conditions = subset(model.conditions, region.nodes);
  part.cells = region.cells;
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    if (region.rim[i] != 0) {
      part.conditions.displacement.row(static_cast<Eigen::Index>(i)) = coarse.row(region.nodes[i]);
      part.cloud.on_surface[i] = 1;  // forces act there
    }
  }
  return part;
}

/// The region's displacement on the whole cloud, elsewhere a share of the coarse one.
Points on_whole_cloud(const Region& region, const Points& displacement, Points coarse) {
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    coarse.row(region.nodes[i]) = displacement.row(static_cast<Eigen::Index>(i));
  }
  return coarse;
}

SolveResult on_whole_cloud(const Model& model, const Region& region, const Points& coarse, SolveResult part) {
  SolveResult whole = std::move(part);
  Solution& solution = whole.solution;
  Points force = Points::Zero(coarse.rows(), 3);
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    if (region.rim[i] == 0) {
      force.row(region.nodes[i]) = solution.reaction_force.row(static_cast<Eigen::Index>(i));
    }
  }
  solution = {model.cloud.positions, on_whole_cloud(region, solution.displacement, coarse), force, model.cloud.spacing,
              solution.shape};
  for (Snapshot& s : whole.snapshots) {
    const double share = model.curve.at(s.time * model.curve.duration());
    s.displacement = on_whole_cloud(region, s.displacement, share * coarse);
  }
  whole.measures.nodes = model.cloud.size();
  whole.measures.region_nodes = region.nodes.size();
  whole.measures.loaded_nodes = count_loaded(model.conditions);
  whole.measures.largest_displacement = solution.displacement.rowwise().norm().maxCoeff();
  return whole;
}

/// How wrong the coarse solution is where it can be seen: at the free nodes that move little, mm.
double error_next_to_rim(const Region& region, const Points& displacement, const Points& coarse, double limit) {
  double largest = 0;
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    const Eigen::RowVector3d u = displacement.row(static_cast<Eigen::Index>(i));
    if (region.rim[i] == 0 && u.norm() < next_to_rim * limit) {
      largest = std::max(largest, (u - coarse.row(region.nodes[i])).norm());
    }
  }
  return largest;
}

SolveResult solve_whole(const Model& model, SolveOptions options, double seconds_coarse, const Progress& progress) {
  options.region = 0;
  SolveResult result = solve_whole_body(model, options, progress);
  result.measures.region_nodes = model.cloud.size();
  result.measures.seconds_coarse += seconds_coarse;
  return result;
}

}  // namespace

void check_region(const Model& model, const SolveOptions& options) {
  const std::vector<UnfitPart> unfit = {
      {options.dynamics == Dynamics::transient, "transient dynamics: waves run through the whole body"},
      {!model.gravity.isZero() || model.fluid, "gravity: it moves the whole body"},
      {model.conditions.force.rows() > 0 || model.body_force, "forces: take prescribed displacements alone"},
      {options.integration_tolerance > 0, "adaptive integration"},
      {!model.cuts.empty() || model.rupture, "cuts or rupture"},
      {model.septum.has_value(), "a septum"},
      {model.resection.has_value(), "a resection: the rest of the body relaxes"},
      {model.plane != Plane::none, "a plane problem"}};
  refuse_unfit("a region does not go", unfit, "solve the whole body, with region 0");
}

SolveResult solve_region(const Model& model, const SolveOptions& given, const Progress& progress) {
  check_region(model, given);
  const SolveOptions options = completed(given, model);
  const Stopwatch start;
  report(progress, 0, "solving a coarse cloud");
  const std::optional<Points> coarse = coarse_displacement(model, options, {});
  const double seconds_coarse = start.seconds();
  if (!coarse) {
    return solve_whole(model, given, seconds_coarse, progress);
  }
  const Stopwatch setup;
  const Eigen::VectorXd moved = coarse->rowwise().norm();
  const Region region = choose(model, options, moved);
  if (moved.maxCoeff() <= options.region || region.is_all_rim()) {
    std::ostringstream text;
    text << "the region of what moves by more than " << options.region << " mm is empty or too small to be solved: "
         << "the largest displacement is " << moved.maxCoeff()
         << " mm; ask for a smaller region, or 0 for the whole body";
    throw std::invalid_argument(text.str());
  }
  if (!region.has_rim()) {
    return solve_whole(model, given, seconds_coarse, progress);
  }
  const Model part = part_of(model, region, *coarse);
  SolveMeasures measures;
  measures.seconds_coarse = seconds_coarse;
  Prepared prepared = prepare(part, options, region.rim, measures, progress);
  measures.seconds_setup = setup.seconds();
  SolveResult solved = step_to_end(part, options, std::move(prepared), measures, {}, progress);
  solved.measures.coarse_error = error_next_to_rim(region, solved.solution.displacement, *coarse, options.region);
  if (solved.unstable || solved.rounded || solved.measures.coarse_error > trusted * options.region) {
    return solve_whole(model, given, start.seconds(), progress);
  }
  return on_whole_cloud(model, region, *coarse, std::move(solved));
}

}  // namespace brainshift::solve
