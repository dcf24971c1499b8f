// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wittek et al., section 6.2: a rectangle of 100 × 40 mm with 57 nodes, held at one end, lengthened by 30 %.

#include "segmentation/geometry/neighbour_distance.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"
#include "tests/verification/cases/cases.hpp"
#include "tests/verification/cases/cylinder_model.hpp"
#include "tests/verification/reference.hpp"

namespace brainshift::verification::extension_cases {

namespace {

constexpr double length = 100, width = 40, pulled = 30;  // mm

/// The irregular cloud of 57 nodes at which the references give their displacement.
NodeCloud reference_cloud() {
  NodeCloud cloud;
  const auto rows = read_rows("extension_nodes.csv");
  cloud.positions.resize(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    cloud.positions.row(static_cast<Eigen::Index>(a)) << rows[a][0], rows[a][1], 0;
    const bool edge = rows[a][0] == 0 || rows[a][0] == length || rows[a][1] == 0 || rows[a][1] == width;
    cloud.on_surface.push_back(edge ? 1 : 0);
  }
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, 4), 4);
  return cloud;
}

solve::SolveResult pull(solve::Plane plane, Basis basis) {
  solve::Model model;
  model.plane = plane;
  model.cloud = reference_cloud();
  model.conditions = test::all_free(model.cloud);
  model.cells = test::rectangle_cells(100, 40, length, width);
  model.materials[1] = {3000, 0.49, 1000};
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const double x = model.cloud.positions(a, 0);
    if (x == 0 || x == length) {
      model.conditions.displacement.row(a) << (x == 0 ? 0 : pulled), 0, 0;
    }
  }
  solve::SolveOptions options = steady_options();
  options.points_per_cell = 1;
  options.shape.basis = basis;
  return solved(model, options);
}

/// The samples inside and on the free edges, in their order; those next to the singular corners come after them.
constexpr Eigen::Index even_samples = 420 + 100;

}  // namespace

Outcome extension(bool) {
  Outcome outcome;
  for (const auto& [name, plane, file] :
       {std::tuple{std::string("plane strain"), solve::Plane::strain, std::string("extension_plane_strain")},
        {"plane stress", solve::Plane::stress, "extension_plane_stress"}}) {
    const Reference reference = read_reference(file, file + "_force");
    const Reference nodes = read_reference(file + "_nodes", file + "_force");
    for (const auto& [basis_name, basis, bounded] : {std::tuple{"MMLS", Basis::modified_quadratic, true},
                                                     {"MLS, linear basis", Basis::linear, false},
                                                     {"MLS, quadratic basis", Basis::quadratic, false}}) {
      const solve::SolveResult result = pull(plane, basis);
      const Differences at_nodes = differences(result.solution, nodes.positions, nodes.displacement);
      const Differences even = differences(result.solution, reference.positions.topRows(even_samples),
                                           reference.displacement.topRows(even_samples));
      const double seconds = result.measures.seconds_setup + result.measures.seconds_stepping;
      const std::string row = name + ", 57 nodes, " + basis_name + ": ";
      outcome.figures.push_back({row + "largest difference at the nodes",
                                 bounded ? "0.5 mm" : "worse",
                                 at_nodes.largest,
                                 "mm",
                                 bounded ? std::optional(0.4) : std::nullopt,
                                 {},
                                 reference.error,
                                 seconds});
      outcome.figures.push_back({row + "mean at the nodes", "", at_nodes.mean, "mm", {}, {}, reference.error, seconds});
      outcome.figures.push_back({row + "largest between the nodes, free edges too",
                                 "",
                                 even.largest,
                                 "mm",
                                 {},
                                 {},
                                 reference.error,
                                 seconds});
    }
  }
  return outcome;
}

}  // namespace brainshift::verification::extension_cases
