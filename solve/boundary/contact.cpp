// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/contact.hpp"

#include <algorithm>
#include <utility>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

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
  const auto nodes = static_cast<std::int64_t>(allowed_.size());
  share_work(nodes, places_a_part, [&](std::int64_t a) {
    const auto i = static_cast<std::size_t>(a);
    const Eigen::Vector3d x = nodes_.place(i, parameters);
    const double outside = skull_->value(x) - allowed_[i];
    const bool penetrates = outside > 0;
    nodes_.set_push(i, penetrates ? -outside : 0, penetrates ? skull_->gradient(x) : Eigen::Vector3d::Zero());
  });
  nodes_.apply(parameters);
}

Contact::Measures Contact::measure(const NodalVectors& parameters) const {
  constexpr double rounding = 1e-4;  // mm, of samples in single precision
  Measures measures;
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const double distance = skull_->value(nodes_.place(i, parameters)), outside = distance - allowed_[i];
    measures.lost = measures.lost || distance > skull_->horizon() - rounding;
    measures.touching += outside > -0.01 ? 1 : 0;
    measures.largest_penetration = std::max(measures.largest_penetration, outside);
  }
  return measures;
}

}  // namespace brainshift::solve
