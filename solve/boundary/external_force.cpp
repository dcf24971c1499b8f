// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/external_force.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace brainshift::solve {

namespace {

constexpr double micronewton = 1e6;  // N to µN

void spread(const Eigen::Vector3d& force, const ShapeRows& rows, std::size_t row, NodalVectors& total) {
  const ShapeRow shape = rows[row];
  for (std::size_t k = 0; k < shape.size(); ++k) {
    at(total, static_cast<std::size_t>(shape.node[k])).head<3>() += micronewton * shape.value[k] * force;
  }
}

/// Weights of two neighbouring entries of a table over (0, 1] in equal steps, whose entry before the first is nothing.
struct Between {
  std::size_t upper;  ///< entry; the lower is the one before it
  double share;       ///< of the upper; the lower has the rest

  Between(double fraction, std::size_t entries) {
    const double place = fraction * static_cast<double>(entries);
    upper = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(entries - 1)));
    share = place - static_cast<double>(upper);
  }
};

}  // namespace

ExternalForce::ExternalForce(NodalVectors full) {
  if (!full.empty()) {
    at_.push_back(std::move(full));
  }
}

ExternalForce::ExternalForce(std::vector<NodalVectors> at_fractions) : at_(std::move(at_fractions)) {}

void ExternalForce::subtract(double fraction, NodalVectors& force) const {
  if (empty()) {
    return;
  }
  const Between between(fraction, at_.size());
  const NodalVectors& upper = at_[between.upper];
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] -= between.share * upper[i];
  }
  if (between.upper > 0) {
    const NodalVectors& lower = at_[between.upper - 1];
    for (std::size_t i = 0; i < force.size(); ++i) {
      force[i] -= (1 - between.share) * lower[i];
    }
  }
}

double ExternalForce::work(double from, double to, const NodalVectors& start, const NodalVectors& end) const {
  const auto work_of = [&](std::size_t entry, double share) {
    const NodalVectors& force = at_[entry];
    return share *
           sum_over_nodes(force.size() / 4, [&](std::size_t a) { return at(force, a).dot(at(end, a) - at(start, a)); });
  };
  if (at_.size() < 2) {
    return empty() ? 0 : work_of(0, (from + to) / 2);
  }
  double work = 0;
  for (const double fraction : {from, to}) {
    const Between between(fraction, at_.size());
    work += work_of(between.upper, between.share / 2);
    work += between.upper > 0 ? work_of(between.upper - 1, (1 - between.share) / 2) : 0;
  }
  return work;
}

void add_point_forces(const Points& force, const ShapeRows& rows, NodalVectors& total) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    spread(force.row(static_cast<Eigen::Index>(i)).transpose(), rows, i, total);
  }
}

void add_body_force(const BodyForce& body_force, const IntegrationPoints& points, const ShapeRows& rows,
                    NodalVectors& total) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d position = points.positions.row(static_cast<Eigen::Index>(i));
    const Eigen::Vector3d force = body_force(position, points.label[i]);
    if (!force.allFinite()) {
      std::ostringstream text;
      text << "the body force at (" << position.transpose() << ") mm is not finite; N/mm³ are expected";
      throw std::invalid_argument(text.str());
    }
    spread(points.volume[i] * force, rows, i, total);
  }
}

}  // namespace brainshift::solve
