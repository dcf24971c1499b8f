// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <stdexcept>

#include "segmentation/surface/checked_surface.hpp"
#include "segmentation/surface/one_body.hpp"
#include "segmentation/surface/remesh.hpp"

namespace brainshift::segmentation {
namespace {

constexpr double widest_hole = 8;  // edge lengths

// A wrap that slips in through a hole, or lies around an open sheet, is a shell as thin as the wrap's offset.
bool is_body(const Surface& surface, double opening) {
  return 2.0 * volume(surface) > 0.5 * opening * area(surface);
}

// The wider the opening, the larger the holes that are bridged, and the more of the folds that are lost.
CheckedSurface wrapped_body(const Surface& surface, double edge_length) {
  CheckedSurface result;
  for (double opening = edge_length; opening <= widest_hole * edge_length; opening *= 2) {
    const Surface wrap = wrapped(surface, opening);
    if (!is_body(wrap, opening)) {
      continue;
    }
    result.surface = remeshed(wrap, edge_length);
    result.measures = measure(result.surface);
    if (result.measures.is_sound()) {
      break;
    }
  }
  result.measures.repaired = true;
  return result;
}

}  // namespace

CheckedSurface checked_surface(const Surface& surface, double edge_length) {
  if (surface.triangles.rows() == 0) {
    throw std::invalid_argument("the surface holds no triangle; a closed, triangulated surface is needed");
  }
  if (is_flat(surface)) {
    throw std::invalid_argument(
        "the surface's triangles lie in one point, line or plane; a closed surface around a brain is needed");
  }
  SurfaceMeasures given = measure(surface);
  ClosedHoles whole{surface};
  if (!given.closed) {
    whole = with_holes_closed(surface, std::min(widest_hole * edge_length, extent(surface) / 4));
    given = measure(whole.surface);
  }
  const bool inside_out = given.closed && !given.self_intersecting && given.volume < 0;
  CheckedSurface result;
  if (inside_out || given.is_sound()) {
    result.surface = remeshed(inside_out ? turned_over(whole.surface) : whole.surface, edge_length);
    result.measures = measure(result.surface);
    result.closed_holes = whole.count;
  }
  if (!result.measures.is_sound()) {
    result = wrapped_body(surface, edge_length);
  }
  result.measures.edge_length_target = edge_length;
  if (!result.measures.is_sound()) {
    throw std::invalid_argument(
        "the surface is open or cuts itself, and could not be wrapped into a closed one; close its holes first");
  }
  OneBody body = one_body(result.surface);
  if (body.loose_pieces > 0) {
    SurfaceMeasures measures = measure(body.surface);
    measures.repaired = result.measures.repaired;
    measures.edge_length_target = edge_length;
    result = {std::move(body.surface), measures, body.loose_volume, body.loose_pieces, result.closed_holes};
  }
  return result;
}

}  // namespace brainshift::segmentation
