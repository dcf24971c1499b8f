// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private to .cpp files: our surfaces as CGAL's and back.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <optional>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using CgalMesh = CGAL::Surface_mesh<CgalPoint>;

struct CgalSoup {
  std::vector<CgalPoint> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

inline CgalSoup to_soup(const Surface& surface) {
  CgalSoup soup;
  for (const auto& point : surface.vertices.rowwise()) {
    soup.points.emplace_back(point[0], point[1], point[2]);
  }
  for (const auto& triangle : surface.triangles.rowwise()) {
    soup.triangles.push_back({static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[1]),
                              static_cast<std::size_t>(triangle[2])});
  }
  return soup;
}

/// The surface as a mesh, vertices and triangles numbered alike; nothing if it is not 2-manifold and oriented alike
/// throughout.
std::optional<CgalMesh> to_mesh(const Surface& surface);

/// The surface as a mesh whatever it takes: repeated points merged, triangles turned to agree, vertices doubled where
/// it is not 2-manifold. It may be open.
CgalMesh to_repaired_mesh(const Surface& surface);

Surface from_mesh(CgalMesh mesh);

}  // namespace brainshift
