// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/dissection.hpp"

#include <chrono>
#include <numeric>
#include <stdexcept>

#include "solve/cut/cut_patches.hpp"
#include "solve/cut/matching.hpp"
#include "solve/cut/touched_rows.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/shape/consistent_derivatives.hpp"

namespace brainshift::solve {

namespace {

// of the spacing: how far a cut goes on at a time
constexpr double stride = 0.5;
constexpr double tear_stride = 0.75;

/// A copy of a node of one cloud as that of another, appended where it is new there.
void copy_node(const NodeCloud& from, std::int32_t node, NodeCloud& to, std::size_t as) {
  const auto a = static_cast<std::size_t>(node);
  if (as == to.size()) {
    const auto rows = static_cast<Eigen::Index>(as) + 1;
    to.positions.conservativeResize(rows, 3);
    to.prescribed_displacement.conservativeResize(rows, 3);
    to.spacing.push_back(0);
    to.on_surface.push_back(0);
    if (to.force.rows() > 0) {
      to.force.conservativeResize(rows, 3);
    }
  }
  const auto row = static_cast<Eigen::Index>(as);
  to.positions.row(row) = from.positions.row(node);
  to.spacing[as] = from.spacing[a];
  to.on_surface[as] = from.on_surface[a];
  if (from.prescribed_displacement.rows() > 0) {
    to.prescribed_displacement.row(row) = from.prescribed_displacement.row(node);
  } else {
    to.prescribed_displacement.row(row).setConstant(std::nan(""));
  }
  if (to.force.rows() > 0) {
    to.force.row(row) = from.force.row(node);
  }
}

std::vector<double> support_radii(const NodeCloud& cloud, const ShapeOptions& options) {
  std::vector<double> radius = cloud.spacing;
  for (double& r : radius) {
    r *= dilatation(options);
  }
  return radius;
}

Points rows_of(const Points& points, std::span<const std::int32_t> rows) {
  return points(std::vector<Eigen::Index>(rows.begin(), rows.end()), Eigen::all);
}

Points held_places(const NodeCloud& cloud) {
  std::vector<std::int32_t> held;
  for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
    if (!cloud.prescribed_displacement.row(a).array().isNaN().all()) {
      held.push_back(static_cast<std::int32_t>(a));
    }
  }
  return rows_of(cloud.positions, held);
}

std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
  }
  return place;
}

}  // namespace

Dissection::Dissection(const Model& model, const SolveOptions& options, Prepared& prepared)
    : model_(model),
      options_(options),
      prepared_(prepared),
      spacing_(mean_spacing(model.cloud)),
      times_(times_of_advance(model.cuts, stride * spacing_)),
      cuts_(model.cuts) {
  if (model.rupture) {
    tearing_.emplace(*model.rupture, prepared.pieces->points, held_places(prepared.pieces->cloud), spacing_,
                     tear_stride * spacing_);
  }
}

/// Nodes that were split or added, by the solver's numbers; the pieces' cloud follows the body's.
std::vector<std::int32_t> Dissection::take_over_nodes(std::size_t first_pair) {
  const CutBody& body = *prepared_.cut;
  OrderedCloud& cloud = prepared_.pieces->cloud;
  std::vector<std::int32_t> ordered = inverse(cloud.original), changed;
  for (std::size_t i = first_pair; i < body.pairs.size(); ++i) {
    for (const std::int32_t node : {body.pairs[i].above, body.pairs[i].below}) {
      if (static_cast<std::size_t>(node) == ordered.size()) {
        ordered.push_back(node);
        cloud.original.push_back(node);
      }
      changed.push_back(ordered[static_cast<std::size_t>(node)]);
      copy_node(body.cloud, node, cloud, static_cast<std::size_t>(changed.back()));
    }
  }
  return changed;
}

std::vector<std::int32_t> Dissection::update_points(const Advance& advance, const ShapeFunctions& shape,
                                                    Matching& match) {
  Pieces& pieces = *prepared_.pieces;
  const std::vector<std::int32_t> touched = touched_rows(pieces.point_rows, pieces.points.positions, advance);
  const ShapeRows before = rows_at(pieces.point_rows, touched);
  pieces.point_rows =
      with_rows(pieces.point_rows, touched, shape.evaluate(rows_of(pieces.points.positions, touched), true));
  if (options_.integration == Integration::consistent) {
    make_derivatives_consistent(pieces.cloud.positions, surface_nodes(pieces.cloud), pieces.nodal_rows,
                                pieces.points.volume, options_.consistency_defect, pieces.point_rows, touched);
  }
  match.agree_in_gradient(before, rows_at(pieces.point_rows, touched), spacing_);
  measures_.touched_supports += touched.size();
  const std::vector<std::int32_t> place = inverse(pieces.patches.order);
  if (pieces.patches.size() < pieces.points.size()) {
    pieces.patches = part_patches(*prepared_.cut->visibility, pieces.points.positions, pieces.patches);
  }
  std::vector<std::int32_t> from;
  for (const std::int32_t point : pieces.patches.order) {
    from.push_back(place[static_cast<std::size_t>(point)]);
  }
  return from;
}

Prepared Dissection::laid_out_again() {
  std::optional<SignedDistance> skull;
  if (prepared_.contact) {
    skull = prepared_.contact->skull();
  }
  return lay_out(model_, options_, *prepared_.pieces, prepared_.cut->pairs, {}, std::move(skull));
}

/// Goes on, or leaves all as it was.
void Dissection::advance(const CutFacets& fresh, const PointLaws& laws, Motion& motion) {
  const auto start = std::chrono::steady_clock::now();
  const CutBody body = *prepared_.cut;
  const Pieces pieces = *prepared_.pieces;
  try {
    go_on(fresh, laws, motion);
  } catch (...) {
    prepared_.cut = body;
    prepared_.pieces = pieces;
    throw;
  }
  ++measures_.advances;
  measures_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Dissection::go_on(const CutFacets& cut_now, const PointLaws& laws, Motion& motion) {
  CutBody& body = *prepared_.cut;
  Pieces& pieces = *prepared_.pieces;
  const ShapeFunctions before(pieces.cloud.positions, pieces.cloud.spacing, options_.shape, body.visibility);
  const std::size_t pairs = body.pairs.size();
  CutFacets facets = facets_at(cuts_, until_, body.inside, spacing_);
  std::erase_if(facets.front, [&](const auto& edge) {
    return std::any_of(closed_.begin(), closed_.end(),
                       [&](const Eigen::Vector3d& end) { return facets.vertices.row(edge[0]) == end.transpose(); });
  });
  cut_further(std::move(facets), body);
  const std::vector<std::int32_t> nodes = take_over_nodes(pairs);
  const ShapeFunctions shape(pieces.cloud.positions, pieces.cloud.spacing, options_.shape, body.visibility);
  const Visibility fresh(cut_now);
  const std::vector<double> radius = support_radii(pieces.cloud, options_.shape);
  const Advance advance{fresh, nodes, pieces.cloud.positions, radius};

  const std::size_t old_nodes = pieces.nodal_rows.size();
  std::vector<std::int32_t> touched =
      touched_rows(pieces.nodal_rows, pieces.cloud.positions.topRows(static_cast<Eigen::Index>(old_nodes)), advance);
  for (std::size_t a = old_nodes; a < pieces.cloud.size(); ++a) {
    touched.push_back(static_cast<std::int32_t>(a));
  }
  const Points places = rows_of(pieces.cloud.positions, touched);
  const ShapeRows nodal = shape.evaluate(places, false);
  pieces.nodal_rows = with_rows(pieces.nodal_rows, touched, nodal);
  Matching match(touched, pieces.cloud.size());
  match.agree_in_value(before.evaluate(places, false), nodal);
  const std::vector<std::int32_t> point_from = update_points(advance, shape, match);
  match.factorise();
  Prepared fresh_layout = laid_out_again();
  fresh_layout.essential.factorise(std::vector<double>(pieces.cloud.size(), 1.0));  // throws where it could not be held
  fresh_layout.cut = std::move(prepared_.cut);
  fresh_layout.pieces = std::move(prepared_.pieces);
  prepared_ = std::move(fresh_layout);
  motion.carry_over(
      laws, [&match](const NodalVectors& v) { return match(v); }, point_from);
}

void Dissection::cut(double time, const PointLaws& laws, Motion& motion) {
  const double after = until_;
  while (is_due(time)) {
    until_ = times_[next_++];
  }
  advance(facets_between(model_.cuts, after, until_), laws, motion);
}

bool Dissection::tear(const PointLaws& laws, Motion& motion, bool may_begin) {
  const std::vector<PointStrain> strains = point_strains(prepared_.points, prepared_.laws, motion.scratch);
  std::vector<PointStrain> ordered(strains.size());
  for (std::size_t i = 0; i < strains.size(); ++i) {
    ordered[static_cast<std::size_t>(prepared_.pieces->patches.order[i])] = strains[i];
  }
  const std::shared_ptr<const Visibility> now = prepared_.cut->visibility;
  bool torn = false;
  for (const Tear& next : tearing_->next(now ? now->facets() : CutFacets(), ordered, may_begin)) {
    torn = tear(next, laws, motion) || torn;
  }
  return torn;
}

bool Dissection::tear(const Tear& tear, const PointLaws& laws, Motion& motion) {
  cuts_.push_back(tear.segment);
  const Eigen::Vector3d end = tear.segment.vertices.row(1);
  if (tear.meets) {
    closed_.push_back(end);
  }
  try {
    advance(facets_between(std::span(cuts_).last(1), from_the_start, until_), laws, motion);
    return true;
  } catch (const std::exception&) {  // it would leave too few nodes together
    cuts_.pop_back();
    tearing_->arrest(tear.segment.vertices.row(0));
    return false;
  }
}

}  // namespace brainshift::solve
