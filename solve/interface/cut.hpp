// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/geometry/surface.hpp"

namespace brainshift::solve {

/// A cut of the undeformed body. In a plane problem a path: segments from vertex to vertex, z = 0. In space a sheet of
/// triangles. It may begin and end inside the body, at its surface or outside.
struct Cut {
  std::string name;                       ///< for messages: the file or the scene's line
  Points vertices = Points(0, 3);         ///< mm, LPS
  Triangles triangles = Triangles(0, 3);  ///< of a sheet; no rows: a path
  /// One a vertex: when the cut gets there, in the time of the load's curve (of its duration in a transient run, s);
  /// of a path never falling. Empty: the body is cut from the start.
  std::vector<double> time;

  bool is_path() const { return triangles.rows() == 0; }
};

/// A cut as far as it has come, undeformed: segments in the plane z = 0, or triangles.
struct CutFacets {
  bool planar = false;
  Points vertices = Points(0, 3);      ///< mm
  Triangles facets = Triangles(0, 3);  ///< vertices of each; of a segment the third is -1
  /// Where it ends inside the body: edges by their two vertices; of a path a tip, twice the same vertex.
  std::vector<std::array<std::int32_t, 2>> front;

  bool empty() const { return facets.rows() == 0; }
};

/// A place that tears before its surroundings.
struct WeakSpot {
  Eigen::Vector2d place;  ///< undeformed, mm
  double radius = 0;      ///< mm
  double factor = 1;      ///< of the strength there, of a stretch of what it is above 1; in (0, 1)
};

/// When a plane body tears: at tips of cuts, and where it is weakest anywhere.
struct Rupture {
  enum class Criterion : std::uint8_t {
    stretch,  ///< largest principal stretch
    stress,   ///< largest principal Cauchy stress, Pa
  };
  Criterion criterion = Criterion::stretch;
  double strength = 0;  ///< stretch, 1 or Pa: above it a tear goes on, or begins
  double distance = 0;  ///< mm: the criterion is a mean over so far; 0: twice the spacing of the nodes
  double scatter = 0;   ///< of the strength from place to place: uniform in 1 ± scatter; 0: even
  unsigned seed = 1;    ///< of the scatter
  std::vector<WeakSpot> weak_spots;
};

/// Tissue that is taken out; the rest relaxes.
struct Resection {
  std::vector<std::int32_t> labels;
  double pressure = 0;  ///< in the cavity, on its undeformed wall, Pa
  /// mm along gravity: the cavity's own fluid fills it from there down; absent: it is open to the fluid about the
  /// brain, if there is one.
  std::optional<double> fluid_level = {};
  /// Closed, outward from the tissue that goes, mm; it may reach out of the body. The cells are parted by it and nodes
  /// lie on it. Absent: the wall is where the labels of integration points change, a staircase.
  std::optional<Surface> wall = {};
};

}  // namespace brainshift::solve
