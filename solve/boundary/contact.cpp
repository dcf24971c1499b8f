// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/contact.hpp"

#include <algorithm>
#include <utility>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t fetched_together = 8;  // places, about as many as a processor waits for at once

}  // namespace

Contact::Contact(SignedDistance skull, const Points& positions, std::span<const std::int32_t> nodes,
                 const ShapeRows& rows)
    : Contact(std::make_shared<const SignedDistance>(std::move(skull)), positions, nodes, rows) {}

Contact::Contact(std::shared_ptr<const SignedDistance> skull, const Points& positions,
                 std::span<const std::int32_t> nodes, const ShapeRows& rows)
    : skull_(std::move(skull)), nodes_(positions, nodes, rows) {
  for (const std::int32_t node : nodes) {
    allowed_.push_back(std::max(0.0, skull_->value(positions.row(node))));
  }
}

void Contact::apply(NodalVectors& parameters) {
  nodes_.begin();
  const std::size_t nodes = allowed_.size(), groups = (nodes + fetched_together - 1) / fetched_together;
  share_work(static_cast<std::int64_t>(groups), places_a_part / fetched_together, [&](std::int64_t group) {
    const std::size_t first = static_cast<std::size_t>(group) * fetched_together;
    const std::size_t last = std::min(first + fetched_together, nodes);
    Eigen::Vector3d place[fetched_together];
    for (std::size_t i = first; i < last; ++i) {
      place[i - first] = nodes_.place(i, parameters);
      skull_->fetch(place[i - first]);
    }
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3d& x = place[i - first];
      const double outside = skull_->value(x) - allowed_[i];
      const bool penetrates = outside > 0;
      nodes_.set_push(i, penetrates ? -outside : 0, penetrates ? skull_->gradient(x) : Eigen::Vector3d::Zero());
    }
  });
  nodes_.apply(parameters);
}

Contact::Measures Contact::measure(const NodalVectors& parameters) const {
  constexpr double rounding = 1e-4;  // mm, of samples in single precision
  std::vector<double> distance(allowed_.size());
  share_work(static_cast<std::int64_t>(distance.size()), places_a_part, [&](std::int64_t i) {
    const auto node = static_cast<std::size_t>(i);
    distance[node] = skull_->value(nodes_.place(node, parameters));
  });
  Measures measures;
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const double outside = distance[i] - allowed_[i];
    measures.lost = measures.lost || distance[i] > skull_->horizon() - rounding;
    measures.touching += outside > -0.01 ? 1 : 0;
    measures.largest_penetration = std::max(measures.largest_penetration, outside);
  }
  return measures;
}

}  // namespace brainshift::solve
