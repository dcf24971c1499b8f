// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/solution_file.hpp"

#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <limits>

#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/geometry/neighbour_distance.hpp"
#include "segmentation/geometry/plane.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift {

namespace {

constexpr std::array bases = {Basis::linear, Basis::quadratic, Basis::modified_quadratic};

void check_range(const std::filesystem::path& file, const std::string& name, double value, double highest) {
  if (!(value >= 0 && value <= highest)) {
    refuse(file, name + " is " + write_number(value) + "; 0 to " + write_number(highest) + " is expected.");
  }
}

/// A body may be stretched to many times its length, but what is beyond a hundred of them is no displacement.
void check_displacement(const std::filesystem::path& file, const Solution& solution) {
  const Points& at = solution.positions;
  const double across = (at.colwise().maxCoeff() - at.colwise().minCoeff()).norm();
  for (Eigen::Index a = 0; a < at.rows(); ++a) {
    const double moved = solution.displacement.row(a).norm();
    if (!std::isfinite(moved)) {
      refuse(file, "the displacement of node " + std::to_string(a) + " is not finite.");
    }
    if (moved > 100 * across) {
      refuse(file, "the displacement of node " + std::to_string(a) + " is " + write_number(moved) +
                       " mm, more than a hundred times the body (" + write_number(across) + " mm).");
    }
  }
}

/// The shape options of the file; the defaults where it names none.
ShapeOptions shape_options(const std::filesystem::path& file, vtkFieldData& data) {
  ShapeOptions options;
  const std::vector<std::int32_t> basis = vtu::whole_number_array(file, data, "shape_basis", 1, "entry");
  if (!basis.empty()) {
    if (basis[0] < 0 || basis[0] >= static_cast<std::int32_t>(bases.size())) {
      refuse(file, "shape_basis is " + std::to_string(basis[0]) +
                       "; 0 (linear), 1 (quadratic) or 2 (modified quadratic) is expected.");
    }
    options.basis = bases[static_cast<std::size_t>(basis[0])];
  }
  const std::vector<double> dilatation = vtu::array(file, data, "shape_dilatation", 1);
  if (!dilatation.empty()) {
    options.dilatation = dilatation[0];
    check_range(file, "shape_dilatation", options.dilatation, 10);
  }
  const std::vector<double> penalty = vtu::array(file, data, "shape_penalty", 1);
  if (!penalty.empty()) {
    options.penalty = penalty[0];
    check_range(file, "shape_penalty", options.penalty, 1);
  }
  const std::vector<std::int32_t> planar = vtu::whole_number_array(file, data, "shape_planar", 1, "entry");
  if (!planar.empty()) {
    if (planar[0] != 0 && planar[0] != 1) {
      refuse(file, "shape_planar is " + std::to_string(planar[0]) + "; 0 or 1 is expected.");
    }
    options.planar = planar[0] == 1;
  }
  return options;
}

/// Rows of a field array, as many as the file has; none: no rows.
Eigen::MatrixXd field_rows(const std::filesystem::path& file, vtkFieldData& data, const char* name, int components) {
  vtkAbstractArray* array = data.GetAbstractArray(name);
  const auto rows = array == nullptr ? 0 : static_cast<std::size_t>(array->GetNumberOfTuples());
  const std::vector<double> values = vtu::array(file, data, name, rows, components);
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), static_cast<Eigen::Index>(rows), components);
}

/// The same of vertices' numbers, -1 for none.
Eigen::MatrixXi vertex_rows(const std::filesystem::path& file, vtkFieldData& data, const char* name, int components) {
  const Eigen::MatrixXd rows = field_rows(file, data, name, components);
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  if (!(rows.array() >= -1 && rows.array() <= most).all()) {
    refuse(file, std::string(name) + " holds what is no vertex's number.");
  }
  return rows.cast<int>();
}

/// The cut of the file; empty where it has none.
solve::CutFacets cut_of(const std::filesystem::path& file, vtkFieldData& data) {
  solve::CutFacets cut;
  cut.vertices = field_rows(file, data, "cut_vertices", 3);
  cut.facets = vertex_rows(file, data, "cut_facets", 3);
  const Eigen::MatrixXi front = vertex_rows(file, data, "cut_front", 2);
  for (Eigen::Index i = 0; i < front.rows(); ++i) {
    cut.front.push_back({front(i, 0), front(i, 1)});
  }
  cut.planar = !cut.empty() && cut.facets.col(2).maxCoeff() < 0;
  const auto beyond = static_cast<std::int32_t>(cut.vertices.rows());
  const bool facets_fit =
      cut.empty() || (cut.facets.leftCols(cut.planar ? 2 : 3).minCoeff() >= 0 && cut.facets.maxCoeff() < beyond);
  const bool front_fits = front.rows() == 0 || (front.minCoeff() >= 0 && front.maxCoeff() < beyond);
  if (!facets_fit || !front_fits || !cut.vertices.allFinite()) {
    refuse(file, "cut_facets or cut_front names a vertex that cut_vertices has not, or one is not finite.");
  }
  return cut;
}

void add_cut(const solve::CutFacets& cut, vtkFieldData& data) {
  if (cut.empty()) {
    return;
  }
  const Points facets = cut.facets.cast<double>();
  std::vector<double> front;
  for (const auto& edge : cut.front) {
    front.insert(front.end(), edge.begin(), edge.end());
  }
  vtu::add_array(data, "cut_vertices", {cut.vertices.data(), static_cast<std::size_t>(cut.vertices.size())}, 3);
  vtu::add_array(data, "cut_facets", {facets.data(), static_cast<std::size_t>(facets.size())}, 3);
  vtu::add_array(data, "cut_front", front, 2);
}

void check_plane(const std::filesystem::path& file, const Points& positions) {
  if (const auto fault = off_plane(positions, "node")) {
    refuse(file, "shape_planar is 1, but " + *fault);
  }
}

}  // namespace

solve::ShapeFunctions shape_functions(const Solution& solution) {
  const auto visibility = solution.cut.empty() ? nullptr : std::make_shared<const solve::Visibility>(solution.cut);
  return {solution.positions, solution.spacing, solution.shape, visibility};
}

Solution read_solution(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  Solution solution;
  solution.shape = shape_options(file, *grid->GetFieldData());
  solution.cut = cut_of(file, *grid->GetFieldData());
  solution.positions = vtu::points(file, *grid, "node");
  if (solution.shape.planar) {
    check_plane(file, solution.positions);
  }
  const auto nodes = static_cast<std::size_t>(solution.positions.rows());
  vtkPointData& data = *grid->GetPointData();
  solution.displacement = vtu::vectors(file, data, "displacement", nodes);
  const std::size_t least = solution.shape.planar ? 3 : 4;
  if (nodes < least || solution.displacement.rows() == 0) {
    refuse(file, "it has no point array `displacement` of three components over at least " + std::to_string(least) +
                     " nodes.");
  }
  check_displacement(file, solution);
  solution.reaction_force = vtu::vectors(file, data, "reaction_force", nodes);
  if (solution.reaction_force.rows() == 0) {
    solution.reaction_force = Points::Zero(solution.positions.rows(), 3);
  }
  solution.spacing = vtu::array(file, data, "spacing", nodes);
  if (solution.spacing.empty()) {
    solution.spacing = mean_neighbour_distance(nearest_neighbours(solution.positions, 6));
  }
  for (std::size_t a = 0; a < nodes; ++a) {
    if (!(solution.spacing[a] > 0 && std::isfinite(solution.spacing[a]))) {
      refuse(file, "the spacing of node " + std::to_string(a) + " is not positive.");
    }
  }
  solution.estimated_error = vtu::array(file, data, "estimated_error", nodes);
  return solution;
}

void write_solution(const std::filesystem::path& file, const Solution& solution) {
  const auto grid = vtu::vertex_grid(solution.positions);
  const auto flat = [](const Points& p) { return std::span(p.data(), static_cast<std::size_t>(p.size())); };
  vtkPointData& data = *grid->GetPointData();
  vtu::add_array(data, "displacement", flat(solution.displacement), 3);
  vtu::add_array(data, "reaction_force", flat(solution.reaction_force), 3);
  vtu::add_array(data, "spacing", solution.spacing);
  if (!solution.estimated_error.empty()) {
    vtu::add_array(data, "estimated_error", solution.estimated_error);
  }
  const std::array basis = {static_cast<std::int32_t>(solution.shape.basis)};
  const std::array dilatation = {solution.shape.dilatation};
  const std::array penalty = {solution.shape.penalty};
  const std::array planar = {static_cast<std::uint8_t>(solution.shape.planar)};
  vtu::add_array(*grid->GetFieldData(), "shape_penalty", std::span<const double>(penalty));
  vtu::add_array(*grid->GetFieldData(), "shape_planar", std::span<const std::uint8_t>(planar));
  vtu::add_array(*grid->GetFieldData(), "shape_basis", std::span<const std::int32_t>(basis));
  vtu::add_array(*grid->GetFieldData(), "shape_dilatation", std::span<const double>(dilatation));
  add_cut(solution.cut, *grid->GetFieldData());
  vtu::write(file, *grid);
}

}  // namespace brainshift
