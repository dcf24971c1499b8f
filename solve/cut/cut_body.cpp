// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/cut_body.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "solve/cut/cut_fronts.hpp"
#include "solve/cut/quarters.hpp"
#include "solve/cut/septum.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

namespace {

/// Mean length of the cells along the axes, mm.
Eigen::Array3d lengths_of(const BackgroundCells& cells) {
  const auto corners = static_cast<Eigen::Index>(cells.corners());
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const Eigen::Map<const Eigen::MatrixX<std::int32_t>> corner(cells.connectivity.data(), corners,
                                                              static_cast<Eigen::Index>(cells.size()));
  for (const auto& cell : corner.colwise()) {
    const Points places = cells.vertices(cell, Eigen::all);
    sum += (places.colwise().maxCoeff() - places.colwise().minCoeff()).transpose().array();
  }
  return sum / static_cast<double>(cells.size());
}

/// Whether a triangle, or a segment whose last two corners are one, comes into the body. Parts are looked at until they
/// are small against what the body's integration points are apart.
bool meets(const Triangle& facet, const InsideBody& inside, double smallest) {
  const double reach = reach_of(facet);
  if (inside(facet.centroid())) {
    return true;
  }
  return reach >= smallest && inside.is_within(facet.centroid(), reach) &&
         std::ranges::any_of(quarters(facet), [&](const Triangle& part) { return meets(part, inside, smallest); });
}

bool meets(const Cut& cut, const InsideBody& inside, double spacing) {
  const Eigen::Index facets = cut.is_path() ? cut.vertices.rows() - 1 : cut.triangles.rows();
  for (Eigen::Index f = 0; f < facets; ++f) {
    const Eigen::Vector3d a = cut.vertices.row(cut.is_path() ? f : cut.triangles(f, 0));
    const Eigen::Vector3d b = cut.vertices.row(cut.is_path() ? f + 1 : cut.triangles(f, 1));
    const Eigen::Vector3d c = cut.vertices.row(cut.is_path() ? f + 1 : cut.triangles(f, 2));
    if (meets(Triangle{a, b, c}, inside, spacing / 4)) {
      return true;
    }
  }
  return false;
}

void add_septum(const Septum& septum, double spacing, CutBody& body) {
  const Cut sheet{septum.name, septum.sheet.vertices, septum.sheet.triangles, {}};
  if (!meets(sheet, body.inside, spacing)) {
    throw std::invalid_argument(septum.name +
                                ": the septum does not meet the body; are its coordinates in mm and in the body's "
                                "frame?");
  }
  body.septum = facets_of(septum);
  find_fronts(body.inside, spacing, body.septum);
  body.split += add_septum_nodes(body.septum, body.inside, body.cloud, body.conditions, body.pairs);
  body.septum_pairs = body.pairs.size();
  body.visibility = std::make_shared<const Visibility>(body.septum);
}

void check(const Cut& cut, bool planar, const InsideBody& inside, double spacing) {
  if (cut.is_path() != planar) {
    throw std::invalid_argument(cut.name + (planar ? ": a sheet cuts a body in space; in a plane problem give a path"
                                                   : ": a path cuts a plane body; in space give a sheet of triangles"));
  }
  if (!meets(cut, inside, spacing)) {
    throw std::invalid_argument(cut.name +
                                ": the cut does not meet the body; are its coordinates in mm and in the body's frame?");
  }
}

}  // namespace

CutBody cut_body(const Model& model) {
  if (last_time(model.cuts) > model.curve.duration() * (1 + 1e-9)) {
    std::ostringstream text;
    text << "a cut goes on until " << last_time(model.cuts) << ", but the load's curve ends at "
         << model.curve.duration() << "; give a longer curve or an earlier cut";
    throw std::invalid_argument(text.str());
  }
  const bool planar = model.plane != Plane::none;
  if (model.septum) {
    check_septum(*model.septum, planar);
  }
  const IntegrationPoints points = integration_points(model.cells, most_points_per_cell(model.cells.kind), nullptr, {});
  CutBody body{.inside = InsideBody(points.positions, points.volume, planar, lengths_of(model.cells)),
               .cloud = model.cloud,
               .conditions = model.conditions,
               .pairs = {},
               .septum_pairs = 0,
               .septum = {},
               .split = 0,
               .visibility = nullptr};
  for (const Cut& cut : model.cuts) {
    check(cut, planar, body.inside, mean_spacing(model.cloud));
  }
  if (model.septum) {
    add_septum(*model.septum, mean_spacing(model.cloud), body);
  }
  cut_further(facets_at(model.cuts, 0, body.inside, mean_spacing(model.cloud)), body);
  return body;
}

void cut_further(CutFacets facets, CutBody& body) {
  if (facets.empty()) {
    return;
  }
  body.split += add_face_nodes(facets, body.inside, body.cloud, body.conditions, body.pairs);
  body.visibility = std::make_shared<const Visibility>(joined(body.septum, std::move(facets)));
}

}  // namespace brainshift::solve
