// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/septa/septa.hpp"

#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/files/vtk_bridge.hpp"
#include "segmentation/geometry/joined_nodes.hpp"
#include "segmentation/geometry/loose_vertices.hpp"
#include "segmentation/image/mask.hpp"
#include "segmentation/image/voxels.hpp"
#include "segmentation/interface/options.hpp"
#include "segmentation/labels/label_table.hpp"

namespace brainshift::segmentation {

namespace {

constexpr double grid_step = 2.0;            // mm
constexpr int growth = 5;                    // steps that the parts are grown into what surrounds them
constexpr double smallest_piece = 500;       // mm²
constexpr double smallest_commissure = 100;  // mm²: less is a fissure that the grid does not resolve

/// What a voxel is for the septa. Joining: tissue or ventricle at which no septum ends between two parts.
enum Part : std::uint8_t { nothing, left_cortex, left_white, right_cortex, right_white, cerebellum, joining };

using Parts = Image<std::uint8_t>;

bool is_within(int number, int first, int last) {
  return number >= first && number <= last;
}

/// FreeSurfer's numbers; cortex and white matter by region in those of its atlases, too.
Part part_of(std::uint16_t number) {
  const auto is = [number](int one, int first, int last) { return number == one || is_within(number, first, last); };
  if (is(3, 1000, 1999) || is_within(number, 11100, 11199)) {
    return left_cortex;
  }
  if (is(42, 2000, 2999) || is_within(number, 12100, 12199)) {
    return right_cortex;
  }
  if (is(2, 3000, 3999) || number == 5001) {
    return left_white;
  }
  if (is(41, 4000, 4999) || number == 5002) {
    return right_white;
  }
  if (is(7, 8, 8) || is_within(number, 46, 47)) {
    return cerebellum;
  }
  const auto& classes = freesurfer_table().classes;
  const auto found = classes.find(number);
  const bool inside = found != classes.end() &&
                      (found->second == default_label::parenchyma || found->second == default_label::ventricles);
  return inside ? joining : nothing;
}

bool is_left(std::uint8_t part) {
  return part == left_cortex || part == left_white;
}
bool is_right(std::uint8_t part) {
  return part == right_cortex || part == right_white;
}

Parts parts_of(const LabelMap& labels) {
  ImageGeometry grid = labels.geometry;
  grid.spacing.setConstant(grid_step);
  grid.size = (labels.geometry.size.cast<double>() * labels.geometry.spacing.array() / grid_step).ceil().cast<int>();
  const LabelMap coarse = on_grid(labels, grid);
  Parts parts{grid, std::vector<std::uint8_t>(coarse.voxels.size())};
  std::transform(coarse.voxels.begin(), coarse.voxels.end(), parts.voxels.begin(), part_of);
  return parts;
}

void check_sides(const Parts& parts) {
  const bool left = std::any_of(parts.voxels.begin(), parts.voxels.end(), is_left);
  const bool right = std::any_of(parts.voxels.begin(), parts.voxels.end(), is_right);
  if (!left || !right) {
    const std::string lacking = !left && !right ? "neither hemisphere"
                                : left          ? "the left hemisphere only"
                                                : "the right hemisphere only";
    throw std::invalid_argument("the label map has " + lacking +
                                " by FreeSurfer's numbers (left 2 and 3, right 41 and 42): septa lie between the two; "
                                "give the septum as a surface, or leave it out");
  }
}

/// Calls back with each pair of voxels that share a face, and the axis from the first to the second.
template <class Use>
void for_each_face(const ImageGeometry& grid, const Use& use) {
  for_each_voxel(grid.size, [&](int i, int j, int k) {
    const std::array<int, 3> here = {i, j, k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<int, 3> there = here;
      if (++there[axis] < grid.size[static_cast<Eigen::Index>(axis)]) {
        use(here, grid.offset(i, j, k), grid.offset(there[0], there[1], there[2]), axis);
      }
    }
  });
}

/// Gives what surrounds the parts to the nearest, step by step.
void grow(Parts& parts) {
  for (int step = 0; step < growth; ++step) {
    const Parts before = parts;
    for_each_face(parts.geometry, [&](const auto&, std::size_t a, std::size_t b, std::size_t) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        if (before.voxels[from] != nothing && parts.voxels[to] == nothing) {
          parts.voxels[to] = before.voxels[from];
        }
      }
    });
  }
}

/// Voxels of white matter that meet that of the other hemisphere over a large area: a commissure.
Mask commissures(const Parts& parts) {
  Mask white{parts.geometry, std::vector<std::uint8_t>(parts.voxels.size(), 0)};
  for_each_face(parts.geometry, [&](const auto&, std::size_t a, std::size_t b, std::size_t) {
    const auto [low, high] = std::minmax(parts.voxels[a], parts.voxels[b]);
    if (low == left_white && high == right_white) {
      white.voxels[a] = white.voxels[b] = 1;
    }
  });
  const Components found = components(white);
  const double face = grid_step * grid_step;
  for (std::size_t v = 0; v < white.voxels.size(); ++v) {
    const std::int32_t number = found.number[v];
    if (number > 0 &&
        face * static_cast<double>(found.sizes[static_cast<std::size_t>(number) - 1]) / 2 < smallest_commissure) {
      white.voxels[v] = 0;
    }
  }
  return white;
}

/// Whether a septum lies between two voxels.
bool parted(std::uint8_t a, std::uint8_t b) {
  const bool cerebrum_a = is_left(a) || is_right(a), cerebrum_b = is_left(b) || is_right(b);
  return (is_left(a) && is_right(b)) || (is_right(a) && is_left(b)) || (cerebrum_a && b == cerebellum) ||
         (cerebrum_b && a == cerebellum);
}

/// The faces of voxels that part, two triangles each, with the normal towards the higher part.
Surface faces_between(const Parts& parts, const Mask& joined) {
  std::map<std::array<int, 3>, std::int32_t> number;
  std::vector<Eigen::RowVector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto corner = [&](std::array<int, 3> at) {
    const auto [place, fresh] = number.emplace(at, static_cast<std::int32_t>(vertices.size()));
    if (fresh) {
      const Eigen::Vector3d index(at[0] - 0.5, at[1] - 0.5, at[2] - 0.5);
      vertices.emplace_back(parts.geometry.to_world(index).transpose());
    }
    return place->second;
  };
  for_each_face(parts.geometry, [&](std::array<int, 3> at, std::size_t a, std::size_t b, std::size_t axis) {
    if (!parted(parts.voxels[a], parts.voxels[b]) || joined.voxels[a] != 0 || joined.voxels[b] != 0) {
      return;
    }
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    ++at[axis];
    std::array<std::array<int, 3>, 4> around = {at, at, at, at};
    ++around[1][u];
    ++around[2][u];
    ++around[2][v];
    ++around[3][v];
    if (parts.voxels[a] > parts.voxels[b]) {
      std::swap(around[1], around[3]);
    }
    const std::array<std::int32_t, 4> c = {corner(around[0]), corner(around[1]), corner(around[2]), corner(around[3])};
    triangles.push_back({c[0], c[1], c[2]});
    triangles.push_back({c[0], c[2], c[3]});
  });
  Surface sheet{as_points(vertices), Triangles(static_cast<Eigen::Index>(triangles.size()), 3)};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    sheet.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return sheet;
}

/// The sheet without its small pieces, and without vertices that no triangle names.
Surface large_pieces(const Surface& sheet) {
  JoinedNodes pieces(static_cast<std::size_t>(sheet.vertices.rows()));
  for (const auto& t : sheet.triangles.rowwise()) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  std::map<std::int32_t, double> areas;  // of a piece, by the vertex that stands for it
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    areas[pieces.root(sheet.triangles(t, 0))] += triangle(sheet, t).area_vector().norm();
  }
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    if (areas[pieces.root(sheet.triangles(t, 0))] >= smallest_piece) {
      kept.push_back(t);
    }
  }
  return without_loose_vertices({sheet.vertices, sheet.triangles(kept, Eigen::all)});
}

/// Without the steps of the voxels; the rim stays a line, and three sheets that meet keep meeting.
Surface smoothed(const Surface& sheet) {
  vtkNew<vtkWindowedSincPolyDataFilter> filter;
  const auto rough = to_vtk(sheet);
  filter->SetInputData(rough);
  filter->SetNumberOfIterations(60);
  filter->SetPassBand(0.01);
  filter->BoundarySmoothingOn();
  filter->NonManifoldSmoothingOn();
  filter->FeatureEdgeSmoothingOff();
  filter->NormalizeCoordinatesOn();
  filter->Update();
  return from_vtk(*filter->GetOutput());
}

}  // namespace

Surface septa_of(const LabelMap& labels) {
  Parts parts = parts_of(labels);
  check_sides(parts);
  const Mask joined = commissures(parts);
  grow(parts);
  const Surface sheet = large_pieces(faces_between(parts, joined));
  if (sheet.triangles.rows() == 0) {
    throw std::invalid_argument(
        "the hemispheres of the label map nowhere face each other over 5 cm²: no septum lies between them; give it as "
        "a surface, or leave it out");
  }
  return smoothed(sheet);
}

}  // namespace brainshift::segmentation
