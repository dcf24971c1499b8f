// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

namespace brainshift::discretise {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

}  // namespace

std::vector<std::array<std::int32_t, 4>> delaunay_tetrahedra(const Points& points) {
  std::vector<std::pair<Kernel::Point_3, std::int32_t>> input;
  input.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    input.emplace_back(Kernel::Point_3(points(i, 0), points(i, 1), points(i, 2)), static_cast<std::int32_t>(i));
  }
  const Triangulation triangulation(input.begin(), input.end());
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  tetrahedra.reserve(triangulation.number_of_finite_cells());
  for (const auto cell : triangulation.finite_cell_handles()) {
    tetrahedra.push_back(
        {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
  }
  return tetrahedra;
}

}  // namespace brainshift::discretise
