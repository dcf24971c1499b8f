// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cells/cut_cell.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace brainshift::discretise {
namespace {

/// Lines a side of a cell.
constexpr int lines_a_side = 16;
/// Where in its strip a line lies, in sixteenths: another place in each row, so that a face along the grid is met at
/// 256 heights, not at sixteen.
constexpr std::array<int, lines_a_side> line_shift = {0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};
/// An octant with less of its volume inside joins the cell's largest.
constexpr double negligible_octant = 0.01;

/// A stretch of a line inside the body.
struct Stretch {
  int octant;
  double length;
  Eigen::Vector3d middle;
};

/// The inside stretches of all lines through the cell, split where the octants meet.
void find_stretches(const Scanlines& body, const Eigen::Vector3d& low, double edge, std::vector<Stretch>& stretches) {
  thread_local std::vector<double> x;
  stretches.clear();
  for (int k = 0; k < lines_a_side; ++k) {
    for (int j = 0; j < lines_a_side; ++j) {
      const double y =
          low.y() + (j + (line_shift[static_cast<std::size_t>(k)] + 0.5) / lines_a_side) / lines_a_side * edge;
      const double z =
          low.z() + (k + (line_shift[static_cast<std::size_t>(j)] + 0.5) / lines_a_side) / lines_a_side * edge;
      body.crossings(y, z, x);
      for (std::size_t pair = 0; pair + 1 < x.size(); pair += 2) {
        for (int half = 0; half < 2; ++half) {
          const double from = std::max(x[pair], low.x() + 0.5 * edge * half);
          const double to = std::min(x[pair + 1], low.x() + 0.5 * edge * (half + 1));
          if (to > from) {
            const int octant = half + 2 * (2 * j / lines_a_side) + 4 * (2 * k / lines_a_side);
            stretches.push_back({octant, to - from, {0.5 * (from + to), y, z}});
          }
        }
      }
    }
  }
}

/// The middle of the stretch nearest to x; of one octant, or of any (-1).
Eigen::Vector3d nearest_middle(const std::vector<Stretch>& stretches, const Eigen::Vector3d& x, int octant) {
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nearest = x;
  for (const Stretch& stretch : stretches) {
    const double distance = (stretch.middle - x).squaredNorm();
    if ((octant < 0 || stretch.octant == octant) && distance < least) {
      least = distance;
      nearest = stretch.middle;
    }
  }
  return nearest;
}

void join_negligible(InsideOctants& octants, double octant_volume) {
  double* const largest = std::max_element(octants.volume, octants.volume + 8);
  for (double& volume : octants.volume) {
    if (&volume != largest && volume < negligible_octant * octant_volume) {
      *largest += volume;
      volume = 0;
    }
  }
}

}  // namespace

InsidePart inside_part(const Scanlines& body, const Eigen::Vector3d& low, double edge) {
  thread_local std::vector<Stretch> stretches;
  find_stretches(body, low, edge, stretches);
  InsidePart part;
  Eigen::Matrix<double, 3, 8> moment = Eigen::Matrix<double, 3, 8>::Zero();
  const double area = edge * edge / (lines_a_side * lines_a_side);
  for (const Stretch& stretch : stretches) {
    part.octants.volume[stretch.octant] += stretch.length * area;
    moment.col(stretch.octant) += stretch.length * area * stretch.middle;
  }
  for (int octant = 0; octant < 8; ++octant) {
    const double volume = part.octants.volume[octant];
    if (volume > 0) {
      part.volume += volume;
      part.centroid += moment.col(octant);
      Eigen::Vector3d centroid = moment.col(octant) / volume;
      if (!body.inside(centroid)) {
        centroid = nearest_middle(stretches, centroid, octant);
      }
      Eigen::Map<Eigen::Vector3d>(part.octants.centroid[octant]) = centroid;
    }
  }
  if (part.volume > 0) {
    part.centroid /= part.volume;
    if (!body.inside(part.centroid)) {
      part.centroid = nearest_middle(stretches, part.centroid, -1);
    }
    join_negligible(part.octants, edge * edge * edge / 8);
  }
  return part;
}

}  // namespace brainshift::discretise
