// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/septum_contact.hpp"

#include <algorithm>
#include <iterator>

#include "segmentation/geometry/nearest_on_segment.hpp"
#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

/// The nodes that have a foot in front of them on the wall, and its panel for each.
std::vector<std::int32_t> facing(const SheetWalls& walls, const Points& positions, std::span<const std::int32_t> nodes,
                                 double reach, std::vector<std::int32_t>& panels) {
  std::vector<std::int32_t> kept;
  for (const std::int32_t node : nodes) {
    const Eigen::Vector3d x = positions.row(node);
    std::int32_t panel = walls.nearest_panel(x);
    const auto foot = walls.foot(x, panel);
    if (foot && foot->gap >= 0 && foot->gap <= reach) {
      kept.push_back(node);
      panels.push_back(panel);
    }
  }
  return kept;
}

}  // namespace

SeptumContact::SeptumContact(const Surface& sheet, const Points& positions, std::span<const std::int32_t> nodes,
                             double reach, const ShapeRows& rows)
    : walls_(sheet), nodes_(positions, facing(walls_, positions, nodes, reach, first_panel_), rows), fade_(reach / 8) {
  begin_anew();
  const double far = 3 * reach;
  const std::vector<Edge> rim = walls_.rim();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3d x = nodes_.positions().row(static_cast<Eigen::Index>(i));
    auto& near = near_rim_.emplace_back();
    std::ranges::copy_if(rim, std::back_inserter(near),
                         [&](const Edge& e) { return (nearest_on_segment(x, e[0], e[1]) - x).norm() < far; });
  }
}

/// Of a node behind the wall the gap counts the less the nearer it is to the rim, where nothing is left of it.
std::optional<SheetWalls::Foot> SeptumContact::faded_foot(std::size_t i, const NodalVectors& parameters,
                                                          std::int32_t& panel) const {
  std::optional<SheetWalls::Foot> foot = walls_.foot(nodes_.place(i, parameters), panel);
  if (!foot || foot->gap >= 0) {
    return foot;
  }
  double to_rim = fade_;
  for (const Edge& edge : near_rim_[i]) {
    to_rim = std::min(to_rim, (foot->place - nearest_on_segment(foot->place, edge[0], edge[1])).norm());
  }
  const double share = to_rim / fade_;
  foot->gap *= share * share;
  return foot;
}

void SeptumContact::apply(NodalVectors& parameters) {
  constexpr int sweeps = 3;  // one leaves several times as much behind the wall
  nodes_.begin();
  for (int i = 0; i < sweeps; ++i) {
    sweep(parameters);
  }
}

void SeptumContact::sweep(NodalVectors& parameters) {
  const auto nodes = static_cast<std::int64_t>(nodes_.size());
  share_work(nodes, places_a_part, [&](std::int64_t a) {
    const auto i = static_cast<std::size_t>(a);
    const auto foot = faded_foot(i, parameters, panel_[i]);
    const bool behind = foot && foot->gap < 0;
    nodes_.set_push(i, behind ? -foot->gap : 0, behind ? foot->normal : Eigen::Vector3d::Zero());
  });
  nodes_.apply(parameters);
}

SeptumContact::Measures SeptumContact::measure(const NodalVectors& parameters) const {
  constexpr double touch = 0.01;  // mm
  Measures measures;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    std::int32_t panel = panel_[i];
    if (const auto foot = faded_foot(i, parameters, panel)) {
      measures.touching += foot->gap < touch ? 1 : 0;
      measures.largest_penetration = std::max(measures.largest_penetration, -foot->gap);
    }
  }
  return measures;
}

}  // namespace brainshift::solve
