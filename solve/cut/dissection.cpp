// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/dissection.hpp"

#include <algorithm>
#include <cmath>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/cut/cut_patches.hpp"
#include "solve/cut/matching.hpp"
#include "solve/cut/touched_rows.hpp"
#include "solve/shape/consistent_derivatives.hpp"
#include "solve/shape/node_supports.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/too_few_nodes.hpp"

namespace brainshift::solve {

namespace {

/// At the rim of the touched points derivatives that stay as they are leave less than that only where others change far
/// more (measured: verification, cut_path, cut while stretched).
constexpr double defect_of_part = 0.01;

// of the spacing: how far a cut goes on at a time
constexpr double cut_stride = 0.5;
constexpr double tear_stride = 0.75;

/// A copy of a node of the cut body as an ordered one, appended where it is new there.
void copy_node(const CutBody& from, std::int32_t node, OrderedCloud& to, std::size_t as) {
  const auto a = static_cast<std::size_t>(node);
  Conditions& conditions = to.conditions;
  if (as == to.size()) {
    const auto rows = static_cast<Eigen::Index>(as) + 1;
    to.positions.conservativeResize(rows, 3);
    conditions.displacement.conservativeResize(rows, 3);
    to.spacing.push_back(0);
    to.on_surface.push_back(0);
    if (conditions.force.rows() > 0) {
      conditions.force.conservativeResize(rows, 3);
    }
  }
  const auto row = static_cast<Eigen::Index>(as);
  to.positions.row(row) = from.cloud.positions.row(node);
  to.spacing[as] = from.cloud.spacing[a];
  to.on_surface[as] = from.cloud.on_surface[a];
  if (from.conditions.displacement.rows() > 0) {
    conditions.displacement.row(row) = from.conditions.displacement.row(node);
  } else {
    conditions.displacement.row(row).setConstant(std::nan(""));
  }
  if (conditions.force.rows() > 0) {
    conditions.force.row(row) = from.conditions.force.row(node);
  }
}

Points rows_of(const Points& points, std::span<const std::int32_t> rows) {
  return points(std::vector<Eigen::Index>(rows.begin(), rows.end()), Eigen::all);
}

std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
  }
  return place;
}

/// Nodes that were split or added since there were so many pairs, by the solver's numbers; the ordered cloud follows.
std::vector<std::int32_t> take_over_nodes(const CutBody& body, std::size_t first_pair, OrderedCloud& cloud) {
  std::vector<std::int32_t> ordered = inverse(cloud.original), changed;
  for (std::size_t i = first_pair; i < body.pairs.size(); ++i) {
    for (const std::int32_t node : {body.pairs[i].above, body.pairs[i].below}) {
      if (static_cast<std::size_t>(node) == ordered.size()) {
        ordered.push_back(node);
        cloud.original.push_back(node);
      }
      changed.push_back(ordered[static_cast<std::size_t>(node)]);
      copy_node(body, node, cloud, static_cast<std::size_t>(changed.back()));
    }
  }
  return changed;
}

}  // namespace

Dissection::Dissection(const Model& model, const SolveOptions& options, CutBody cut, BodyParts parts)
    : model_(model),
      options_(options),
      now_{std::move(cut), std::move(parts)},
      spacing_(mean_spacing(model.cloud)),
      times_(times_of_advance(model.cuts, cut_stride * spacing_)),
      cuts_(model.cuts) {
  if (model.rupture) {
    const OrderedCloud& cloud = now_.parts.cloud;
    tearing_.emplace(*model.rupture, now_.parts.points, rows_of(cloud.positions, prescribed_nodes(cloud.conditions)),
                     spacing_, tear_stride * spacing_);
  }
}

BodyChange Dissection::change() {
  return {.is_due = [this](double time) { return is_due(time); },
          .next = [this](const Moment& moment) { return next(moment); },
          .is_done = [this] { return next_ == times_.size(); },
          .by_state = tearing_.has_value()};
}

/// First as far as the cuts have come, then one tear after another.
std::optional<ChangedBody> Dissection::next(const Moment& moment) {
  if (moment.first) {
    pending_.reset();
    if (is_due(moment.time)) {
      return cut(moment.time, moment.body);
    }
  }
  if (!pending_) {
    pending_ = tears_at(moment);
  }
  while (!pending_->empty()) {
    const Tear next = pending_->front();
    pending_->erase(pending_->begin());
    if (std::optional<ChangedBody> torn = tear(next, moment.body)) {
      return torn;
    }
  }
  return std::nullopt;
}

ChangedBody Dissection::cut(double time, const Body& body) {
  const double after = until_;
  while (is_due(time)) {
    until_ = times_[next_++];
  }
  return advance(facets_between(model_.cuts, after, until_), body);
}

std::vector<Tear> Dissection::tears_at(const Moment& moment) const {
  if (!tearing_ || !moment.moves) {
    return {};
  }
  const std::vector<PointStrain> strains = point_strains(moment.body.points, moment.body.laws, moment.scratch);
  std::vector<PointStrain> ordered(strains.size());
  for (std::size_t i = 0; i < strains.size(); ++i) {
    ordered[static_cast<std::size_t>(now_.parts.patches.order[i])] = strains[i];
  }
  return tearing_->next(now_.cut.facets(), ordered, moment.may_begin);
}

/// Nothing where it would leave too few nodes together: there the tear stops.
std::optional<ChangedBody> Dissection::tear(const Tear& tear, const Body& body) {
  cuts_.push_back(tear.segment);
  if (tear.meets) {
    closed_.push_back(tear.segment.vertices.row(1));
  }
  try {
    return advance(facets_between(std::span(cuts_).last(1), from_the_start, until_), body);
  } catch (const TooFewNodes&) {
    cuts_.pop_back();
    if (tear.meets) {
      closed_.pop_back();
    }
    tearing_->arrest(tear.segment.vertices.row(0));
    return std::nullopt;
  }
}

CutFacets Dissection::facets_now() const {
  CutFacets facets = facets_at(cuts_, until_, now_.cut.inside, spacing_);
  std::erase_if(facets.front, [&](const auto& edge) {
    return std::any_of(closed_.begin(), closed_.end(),
                       [&](const Eigen::Vector3d& end) { return facets.vertices.row(edge[0]) == end.transpose(); });
  });
  return facets;
}

/// Makes the body anew beside the one that is there, and puts it in its place when it is whole.
ChangedBody Dissection::advance(const CutFacets& fresh, const Body& body) {
  const Stopwatch stopwatch;
  State after = now_;
  BodyParts& parts = after.parts;
  cut_further(facets_now(), after.cut);
  const std::vector<std::int32_t> nodes = take_over_nodes(after.cut, now_.cut.pairs.size(), parts.cloud);
  const ShapeFunctions shape(parts.cloud.positions, parts.cloud.spacing, options_.shape, after.cut.visibility);
  const Visibility newly_cut(fresh);
  const std::vector<double> radius = support_radii(parts.cloud.spacing, options_.shape);
  const Advance advance{newly_cut, nodes, parts.cloud.positions, radius};
  const std::vector<std::int32_t> touched = touched_nodes(advance, parts);
  const auto match = std::make_shared<Matching>(touched, parts.cloud.size());
  update_nodes(touched, shape, *match, parts);
  const std::size_t touched_points = update_points(advance, shape, *match, parts);
  if (parts.wall_load) {
    parts.wall_load->rows = shape.evaluate(parts.wall_load->forces.places, false);
  }
  match->factorise();
  const std::vector<std::int32_t> place = inverse(parts.patches.order);
  if (parts.patches.size() < parts.points.size()) {
    parts.patches = part_patches(*after.cut.visibility, parts.points.positions, parts.patches);
  }
  std::vector<std::int32_t> point_from;
  for (const std::int32_t point : parts.patches.order) {
    point_from.push_back(place[static_cast<std::size_t>(point)]);
  }
  std::shared_ptr<const SignedDistance> skull;
  if (body.contact) {
    skull = body.contact->skull();
  }
  Body cut =
      lay_out(model_, options_, parts,
              {.cut = after.cut.facets(), .faces = after.cut.cut_pairs(), .held = {}, .skull = std::move(skull)});
  cut.essential.factorise(std::vector<double>(parts.cloud.size(), 1.0));  // throws where it could not be held
  now_ = std::move(after);
  measures_.touched_supports += touched_points;
  ++measures_.advances;
  measures_.seconds += stopwatch.seconds();
  return {.body = std::move(cut),
          .parameters = [match](const NodalVectors& v) { return (*match)(v); },
          .point_from = std::move(point_from)};
}

/// Those whose supports may change, and the new ones.
std::vector<std::int32_t> Dissection::touched_nodes(const Advance& advance, const BodyParts& parts) const {
  const std::size_t old_nodes = parts.nodal_rows.size();
  std::vector<std::int32_t> touched =
      touched_rows(parts.nodal_rows, parts.cloud.positions.topRows(static_cast<Eigen::Index>(old_nodes)), advance);
  for (std::size_t a = old_nodes; a < parts.cloud.size(); ++a) {
    touched.push_back(static_cast<std::int32_t>(a));
  }
  return touched;
}

/// Shape functions at the touched nodes.
void Dissection::update_nodes(std::span<const std::int32_t> touched, const ShapeFunctions& shape, Matching& match,
                              BodyParts& parts) const {
  const OrderedCloud& before = now_.parts.cloud;
  const ShapeFunctions shape_before(before.positions, before.spacing, options_.shape, now_.cut.visibility);
  const Points places = rows_of(parts.cloud.positions, touched);
  const ShapeRows rows = shape.evaluate(places, false);
  parts.nodal_rows = with_rows(parts.nodal_rows, touched, rows);
  match.agree_in_value(shape_before.evaluate(places, false), rows);
}

/// Shape functions at the touched integration points; how many there are.
std::size_t Dissection::update_points(const Advance& advance, const ShapeFunctions& shape, Matching& match,
                                      BodyParts& parts) const {
  const std::vector<std::int32_t> touched = touched_rows(parts.point_rows, parts.points.positions, advance);
  const ShapeRows before = rows_at(parts.point_rows, touched);
  parts.point_rows =
      with_rows(parts.point_rows, touched, shape.evaluate(rows_of(parts.points.positions, touched), true));
  if (options_.integration == Integration::consistent) {
    make_derivatives_consistent(parts.cloud.positions, surface_nodes(parts.cloud), parts.nodal_rows,
                                parts.points.volume, std::max(options_.consistency_defect, defect_of_part),
                                parts.point_rows, touched);
  }
  match.agree_in_gradient(before, rows_at(parts.point_rows, touched), spacing_);
  return touched.size();
}

}  // namespace brainshift::solve
