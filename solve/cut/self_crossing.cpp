// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/self_crossing.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Segment_2.h>
#include <CGAL/intersections.h>

#include <stdexcept>

#include "segmentation/geometry/cgal_bridge.hpp"

namespace brainshift::solve {
namespace {

using Segment = CgalKernel::Segment_2;

/// Whether a segment goes back over the one before, whose end is its start.
bool folds_back(const Segment& first, const Segment& next) {
  return CGAL::collinear(first.source(), first.target(), next.target()) &&
         !CGAL::collinear_are_ordered_along_line(first.source(), first.target(), next.target());
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> meeting_segments(
    const std::vector<std::pair<double, double>>& vertices) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    segments.emplace_back(CgalKernel::Point_2(vertices[i].first, vertices[i].second),
                          CgalKernel::Point_2(vertices[i + 1].first, vertices[i + 1].second));
  }
  for (std::size_t j = 1; j < segments.size(); ++j) {
    if (folds_back(segments[j - 1], segments[j])) {
      return std::pair(j - 1, j);
    }
    const CGAL::Bbox_2 box = segments[j].bbox();
    for (std::size_t i = 0; i + 1 < j; ++i) {
      if (CGAL::do_overlap(box, segments[i].bbox()) && CGAL::do_intersect(segments[i], segments[j])) {
        return std::pair(i, j);
      }
    }
  }
  return std::nullopt;
}

std::optional<std::pair<std::size_t, std::size_t>> meeting_triangles(const Surface& sheet) {
  const std::optional<CgalMesh> mesh = to_mesh(sheet);
  if (!mesh) {
    throw std::logic_error("a sheet is searched for crossings before it is known to be 2-manifold");
  }
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(*mesh, std::back_inserter(pairs));
  if (pairs.empty()) {
    return std::nullopt;
  }
  return std::pair<std::size_t, std::size_t>(pairs[0].first.idx(), pairs[0].second.idx());
}

}  // namespace brainshift::solve
