// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solution.hpp"

#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "discretise/neighbours/neighbour_distance.hpp"
#include "discretise/plane.hpp"
#include "discretise/vtu/vtu_file.hpp"

namespace brainshift {

namespace {

constexpr std::array bases = {Basis::linear, Basis::quadratic, Basis::modified_quadratic};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::invalid_argument(file.string() + ": " + why);
}

Points vectors(const std::filesystem::path& file, vtkPointData& data, const char* name, std::size_t nodes) {
  const std::vector<double> values = vtu::array(file, data, name, nodes, 3);
  return Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
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
  }
  const std::vector<double> penalty = vtu::array(file, data, "shape_penalty", 1);
  if (!penalty.empty()) {
    options.penalty = penalty[0];
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

void check_plane(const std::filesystem::path& file, const Points& positions) {
  if (const auto fault = off_plane(positions, "node")) {
    refuse(file, "shape_planar is 1, but " + *fault);
  }
}

}  // namespace

Solution read_solution(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  Solution solution;
  solution.shape = shape_options(file, *grid->GetFieldData());
  solution.positions = vtu::points(file, *grid, "node");
  if (solution.shape.planar) {
    check_plane(file, solution.positions);
  }
  const auto nodes = static_cast<std::size_t>(solution.positions.rows());
  vtkPointData& data = *grid->GetPointData();
  solution.displacement = vectors(file, data, "displacement", nodes);
  const std::size_t least = solution.shape.planar ? 3 : 4;
  if (nodes < least || solution.displacement.rows() == 0) {
    refuse(file, "it has no point array `displacement` of three components over at least " + std::to_string(least) +
                     " nodes.");
  }
  for (Eigen::Index a = 0; a < solution.displacement.rows(); ++a) {
    if (!solution.displacement.row(a).allFinite()) {
      refuse(file, "the displacement of node " + std::to_string(a) + " is not finite.");
    }
  }
  solution.reaction_force = vectors(file, data, "reaction_force", nodes);
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
  return solution;
}

void write_solution(const std::filesystem::path& file, const Solution& solution) {
  const auto grid = vtu::vertex_grid(solution.positions);
  const auto flat = [](const Points& p) { return std::span(p.data(), static_cast<std::size_t>(p.size())); };
  vtkPointData& data = *grid->GetPointData();
  vtu::add_array(data, "displacement", flat(solution.displacement), 3);
  vtu::add_array(data, "reaction_force", flat(solution.reaction_force), 3);
  vtu::add_array(data, "spacing", solution.spacing);
  const std::array basis = {static_cast<std::int32_t>(solution.shape.basis)};
  const std::array dilatation = {solution.shape.dilatation};
  const std::array penalty = {solution.shape.penalty};
  const std::array planar = {static_cast<std::uint8_t>(solution.shape.planar)};
  vtu::add_array(*grid->GetFieldData(), "shape_penalty", std::span<const double>(penalty));
  vtu::add_array(*grid->GetFieldData(), "shape_planar", std::span<const std::uint8_t>(planar));
  vtu::add_array(*grid->GetFieldData(), "shape_basis", std::span<const std::int32_t>(basis));
  vtu::add_array(*grid->GetFieldData(), "shape_dilatation", std::span<const double>(dilatation));
  vtu::write(file, *grid);
}

}  // namespace brainshift
