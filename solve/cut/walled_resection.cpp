// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/walled_resection.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "discretise/body/scanlines.hpp"
#include "segmentation/geometry/finer.hpp"
#include "segmentation/geometry/joined.hpp"
#include "segmentation/geometry/surface_tree.hpp"
#include "solve/body/contact_nodes.hpp"
#include "solve/body/ordered_cloud.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/quadrature/taken_cells.hpp"

namespace brainshift::solve {

namespace {

using discretise::Scanlines;

/// A place in the part that a cell has in the body.
Eigen::Vector3d place_in(const BackgroundCells& cells, std::size_t cell) {
  if (!cells.cut_index.empty() && cells.cut_index[cell] >= 0) {
    const InsideOctants& part = cells.cut_parts[static_cast<std::size_t>(cells.cut_index[cell])];
    const auto largest = std::max_element(std::begin(part.volume), std::end(part.volume)) - std::begin(part.volume);
    return Eigen::Map<const Eigen::Vector3d>(part.centroid[largest]);
  }
  return corners_of(cells, cell).colwise().mean();
}

/// One a cell: 1 where it goes.
std::vector<std::uint8_t> cells_within(const BackgroundCells& cells, const Scanlines& wall) {
  std::vector<std::uint8_t> within;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    within.push_back(wall.inside(place_in(cells, cell)) ? 1 : 0);
  }
  if (std::ranges::count(within, 1) == 0) {
    throw std::invalid_argument(
        "the wall of the resection encloses no background cell; are body and wall in one frame?");
  }
  if (std::ranges::count(within, 0) == 0) {
    throw std::invalid_argument("the resection takes out the whole body; leave a tissue");
  }
  return within;
}

/// What becomes of the nodes.
struct KeptNodes {
  std::vector<std::int32_t> stay;
  std::vector<std::uint8_t> at_wall;  ///< one each that stays
  std::vector<std::int32_t> gone;
};

KeptNodes kept_nodes(const NodeCloud& cloud, const Surface& surface, const Scanlines& wall) {
  const SurfaceTree tree(surface);
  KeptNodes nodes;
  for (std::size_t a = 0; a < cloud.size(); ++a) {
    const Eigen::Vector3d x = cloud.positions.row(static_cast<Eigen::Index>(a));
    const bool at_wall = is_on_wall(tree.nearest(x), x, cloud.spacing[a]);
    if (at_wall || !wall.inside(x)) {
      nodes.stay.push_back(static_cast<std::int32_t>(a));
      nodes.at_wall.push_back(at_wall ? 1 : 0);
    } else {
      nodes.gone.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

/// The triangles with their middle inside, or outside.
Surface triangles_where(const Surface& surface, const Scanlines& body, bool inside) {
  Surface part{surface.vertices, Triangles(surface.triangles.rows(), 3)};
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    if (body.inside(triangle(surface, t).centroid()) == inside) {
      part.triangles.row(kept++) = surface.triangles.row(t);
    }
  }
  part.triangles.conservativeResize(kept, 3);
  return part;
}

double volume_of(const BackgroundCells& cells) {
  const IntegrationPoints points = integration_points(cells, 1, nullptr, {});
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}

}  // namespace

void check_free(const Model& model, std::span<const std::int32_t> gone) {
  for (const std::int32_t a : gone) {
    const bool prescribed = model.conditions.is_prescribed(a);
    if (prescribed || model.conditions.is_pushed(a)) {
      std::ostringstream text;
      text << "node " << a << " at (" << model.cloud.positions.row(a).format({4, Eigen::DontAlignCols, ", ", ", "})
           << ") mm has a " << (prescribed ? "prescribed displacement" : "force")
           << ", but lies in the tissue that is taken out; leave it free";
      throw std::invalid_argument(text.str());
    }
  }
}

Resected resect_within_wall(const Model& model) {
  const Surface& surface = *model.resection->wall;
  const Scanlines wall(surface);
  const std::vector<std::uint8_t> within = cells_within(model.cells, wall);
  const KeptNodes nodes = kept_nodes(model.cloud, surface, wall);
  std::vector<std::int32_t> inner;  // the load on a cortex that is taken out goes with it
  std::ranges::copy_if(nodes.gone, std::back_inserter(inner),
                       [&](std::int32_t a) { return model.cloud.on_surface[static_cast<std::size_t>(a)] == 0; });
  check_free(model, inner);
  if (nodes.stay.empty()) {
    throw std::invalid_argument("the resection leaves no node of the body; leave more of it, or take more nodes");
  }
  Resected result{model, {}};
  result.measures.removed_nodes = nodes.gone.size();
  result.measures.removed_volume = volume_of(taken_cells(model.cells, within, 1));
  Model& rest = result.rest;
  rest.cells = taken_cells(model.cells, within, 0);
  rest.cloud = subset(model.cloud, nodes.stay);
  rest.conditions = subset(model.conditions, nodes.stay);
  for (std::size_t i = 0; i < nodes.stay.size(); ++i) {
    rest.cloud.on_surface[i] |= nodes.at_wall[i];
  }
  result.measures.wall_nodes = static_cast<std::size_t>(std::ranges::count(nodes.at_wall, 1));
  const Surface pieces = finer(surface, mean_spacing(model.cloud));
  if (model.boundary) {
    const Scanlines body(*model.boundary);
    rest.resection->wall = triangles_where(pieces, body, true);
    rest.boundary = joined(triangles_where(*model.boundary, wall, false), turned_over(*rest.resection->wall));
  }
  if (rest.resection->wall->triangles.rows() == pieces.triangles.rows() || !model.boundary) {
    result.measures.volume = volume(surface);
  }
  result.measures.wall_area = area(*rest.resection->wall);
  return result;
}

}  // namespace brainshift::solve
