// SPDX-License-Identifier: GPL-3.0-or-later
//
// Section 6.2 of the source: a rectangle of 100 × 40 mm with 57 nodes, held at one end, lengthened by 30 %.
#include <cmath>
#include <stdexcept>

#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification {

namespace {

constexpr double length = 100, width = 40, pulled = 30;  // mm

/// An irregular cloud of just so many nodes.
NodeCloud cloud_of(std::size_t nodes) {
  for (unsigned seed = 1; seed < 2000; ++seed) {
    const NodeCloud cloud = rectangle_cloud(length, width, 8.2, seed);
    if (cloud.size() == nodes) {
      return cloud;
    }
  }
  throw std::runtime_error("no cloud of " + std::to_string(nodes) + " nodes was found");
}

solve::SolveResult pull(solve::Plane plane, Basis basis) {
  solve::Model model;
  model.plane = plane;
  model.cloud = cloud_of(57);
  model.cells = rectangle_cells(100, 40, length, width);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    if (x == 0 || x == length) {
      model.cloud.prescribed_displacement.row(a) << (x == 0 ? 0 : pulled), 0, 0;
    }
  }
  solve::SolveOptions options = steady_options();
  options.points_per_cell = 1;
  options.shape.basis = basis;
  return solved(model, options);
}

/// Largest difference at the nodes: the reference has them among its samples only by chance, so over its samples inside
/// and on the free edges, in their order; those next to the singular corners are beside.
constexpr Eigen::Index even_samples = 420 + 100;

}  // namespace

Outcome extension(bool) {
  Outcome outcome;
  for (const auto& [name, plane, file] :
       {std::tuple{std::string("plane strain"), solve::Plane::strain, std::string("extension_plane_strain")},
        {"plane stress", solve::Plane::stress, "extension_plane_stress"}}) {
    const Reference reference = read_reference(file, file + "_force");
    for (const auto& [basis_name, basis, bounded] : {std::tuple{"MMLS", Basis::modified_quadratic, true},
                                                     {"MLS, linear basis", Basis::linear, false},
                                                     {"MLS, quadratic basis", Basis::quadratic, false}}) {
      const solve::SolveResult result = pull(plane, basis);
      const Differences even = differences(result.solution, reference.positions.topRows(even_samples),
                                           reference.displacement.topRows(even_samples));
      const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
      outcome.figures.push_back({name + ", 57 nodes, " + basis_name + ": largest difference",
                                 bounded ? "0.5 mm" : "worse",
                                 even.largest,
                                 "mm",
                                 bounded ? std::optional(0.4) : std::nullopt,
                                 {},
                                 reference.error,
                                 seconds});
      outcome.figures.push_back({name + ", 57 nodes, " + basis_name + ": mean difference",
                                 "",
                                 even.mean,
                                 "mm",
                                 {},
                                 {},
                                 reference.error,
                                 seconds});
    }
  }
  return outcome;
}

}  // namespace brainshift::verification
