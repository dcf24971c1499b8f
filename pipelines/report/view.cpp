// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "pipelines/report/slice_figures.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/quantile.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector3d;

constexpr double margin = 14;  // mm, shown around the brain
constexpr double pixels_per_mm = 2.5;
constexpr double headroom = 1.15;  // white matter is not to be shown as white as paper

Vector3d nearest_vertex(const Surface& surface, const Vector3d& point) {
  Eigen::Index nearest = 0;
  (surface.vertices.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return surface.vertices.row(nearest);
}

// Against the mean normal of the surface's triangles that lie in the opening.
Vector3d inward_at(const Surface& surface, const Vector3d& centre, double radius) {
  Vector3d normal = Vector3d::Zero();
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    const Triangle facet = triangle(surface, t);
    if ((facet.a - centre).norm() < radius) {
      normal += facet.area_vector();
    }
  }
  return -normal.normalized();
}

// The brain's brightness sets the scale: fat, vessels and bone would otherwise darken it.
std::pair<double, double> grey_window(const std::array<Slice, 3>& slices) {
  std::vector<float> sample;
  for (const Slice& slice : slices) {
    for (const std::size_t pixel : slice.inside) {
      if (!slice.t1.empty() && std::isfinite(slice.t1[pixel])) {
        sample.push_back(slice.t1[pixel]);
      }
    }
  }
  if (sample.empty()) {
    return {0, 1};
  }
  const double low = std::min(0.0, static_cast<double>(std::ranges::min(sample)));
  const double high = quantile(std::move(sample), 0.995);
  return {low, high > low ? low + headroom * (high - low) : low + 1};
}

// Where most of the surface is loaded, as by a whole field, nothing is open.
bool is_all_around(const Points& loaded, const Surface& brain, double reach) {
  const PointTree tree(loaded);
  Eigen::Index near = 0;
  for (const Vector3d vertex : brain.vertices.rowwise()) {
    near += tree.nearest(vertex.data()).second < reach * reach ? 1 : 0;
  }
  return 2 * near > brain.vertices.rows();
}

void find_opening(const RunData& run, View& view) {
  const Surface& brain = *run.brain;
  view.opening = loaded_positions(*run.solution);
  const auto& spacing = run.solution->spacing;
  view.opening_reach = spacing.empty()
                           ? 5.0
                           : std::accumulate(spacing.begin(), spacing.end(), 0.0) / static_cast<double>(spacing.size());
  if (view.opening.rows() > 0 && is_all_around(view.opening, brain, view.opening_reach)) {
    view.opening.resize(0, 3);
  }
  if (view.opening.rows() == 0) {
    view.opening_centre = brain.vertices.colwise().mean().transpose();
    view.inward = -Vector3d::UnitZ();
    return;
  }
  view.opening_centre = nearest_vertex(brain, view.opening.colwise().mean().transpose());
  view.inward = inward_at(brain, view.opening_centre, 4 * view.opening_reach);
}

}  // namespace

View make_view(const RunData& run) {
  View view{};
  find_opening(run, view);
  const Points& vertices = run.brain->vertices;
  const Vector3d low = vertices.colwise().minCoeff().transpose().array() - margin;
  const Vector3d high = vertices.colwise().maxCoeff().transpose().array() + margin;
  const double depth = view.opening.rows() == 0 ? 0 : depth_of_planes;
  view.focus = view.opening_centre + depth * view.inward;
  const discretise::Scanlines body(*run.brain);
  const std::vector<std::uint16_t> resected = run.labels ? resected_labels(run.record) : std::vector<std::uint16_t>();
  const auto is_taken_out = [&](const Vector3d& place) {
    return !resected.empty() && std::ranges::find(resected, label_at(*run.labels, place)) != resected.end();
  };
  std::ranges::transform(anatomical_planes(view.focus, low, high, pixels_per_mm), view.slices.begin(),
                         [&](const SlicePlane& plane) {
                           std::vector<std::size_t> tissue = pixels_inside(plane, body);
                           std::erase_if(tissue, [&](auto pixel) { return is_taken_out(centre_of(plane, pixel)); });
                           return Slice{.plane = plane,
                                        .outline = cut_surface(plane, *run.brain),
                                        .inside = std::move(tissue),
                                        .t1 = run.t1 ? sample_slice(plane, *run.t1) : std::vector<float>{}};
                         });
  std::tie(view.darkest, view.brightest) = grey_window(view.slices);
  const Points shift = displacement_at(run, vertices);
  view.deformed = {vertices + shift, run.brain->triangles};
  for (const auto& u : shift.rowwise()) {
    view.surface_shift.push_back(u.norm());
  }
  const double largest = run.solution->displacement.rowwise().norm().maxCoeff();
  view.shift = {.map = ColourMap::sequential, .low = 0, .high = round_up(largest), .title = "shift, mm"};
  return view;
}

}  // namespace brainshift::pipelines
