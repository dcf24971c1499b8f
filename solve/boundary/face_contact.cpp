// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/face_contact.hpp"

#include <algorithm>
#include <utility>

#include "solve/arrays/shared_work.hpp"
#include "solve/shape/shape_matrix.hpp"

namespace brainshift::solve {

namespace {

constexpr int sweeps = 3;  // more leave less overlap, but a corner that little holds may then never come to rest

/// Above and below of each pair.
std::vector<std::int32_t> face_nodes(std::span<const FacePair> pairs) {
  std::vector<std::int32_t> nodes;
  for (const FacePair& p : pairs) {
    nodes.push_back(p.above);
    nodes.push_back(p.below);
  }
  return nodes;
}

FaceGaps face_gaps(std::span<const FacePair> pairs, const Points& positions, std::span<const double> spacing) {
  std::vector<FacePlace> places;
  for (const FacePair& p : pairs) {
    places.push_back({p.place, p.normal, spacing[static_cast<std::size_t>(p.above)]});
  }
  return {std::move(places), positions(face_nodes(pairs), Eigen::all)};
}

std::vector<std::int32_t> wall_nodes(std::span<const WallNode> wall) {
  std::vector<std::int32_t> nodes;
  for (const WallNode& w : wall) {
    nodes.push_back(w.node);
  }
  return nodes;
}

FaceGaps wall_gaps(std::span<const WallNode> wall, const Points& positions, std::span<const double> spacing) {
  std::vector<FacePlace> places;
  for (const WallNode& w : wall) {
    places.push_back({positions.row(w.node), w.normal, spacing[static_cast<std::size_t>(w.node)]});
  }
  return {std::move(places), positions(wall_nodes(wall), Eigen::all), Faces::of_cavity};
}

}  // namespace

FaceContact::FaceContact(std::span<const FacePair> pairs, const Points& positions, std::span<const double> spacing,
                         const ShapeRows& rows)
    : FaceContact(face_nodes(pairs), face_gaps(pairs, positions, spacing), rows, positions.rows()) {}

FaceContact::FaceContact(std::span<const WallNode> wall, const Points& positions, std::span<const double> spacing,
                         const ShapeRows& rows)
    : FaceContact(wall_nodes(wall), wall_gaps(wall, positions, spacing), rows, positions.rows()) {}

FaceContact::FaceContact(std::span<const std::int32_t> nodes, FaceGaps gaps, const ShapeRows& rows, Eigen::Index all)
    : shape_(shape_matrix(rows, nodes, all)),
      gaps_(std::move(gaps)),
      row_sum_(gaps_.gaps().size()),
      push_(row_sum_.size()),
      force_(row_sum_.size(), 3),
      shift_(row_sum_.size(), 3) {}

void FaceContact::weigh(std::span<const double> mass) {
  inverse_mass_ = Eigen::Map<const Eigen::VectorXd>(mass.data(), static_cast<Eigen::Index>(mass.size())).cwiseInverse();
  const RowMatrix weighed = shape_ * inverse_mass_.asDiagonal();
  softness_ = weighed * RowMatrix(shape_.transpose());
}

Points FaceContact::places(const NodalVectors& parameters) const {
  Points now = gaps_.undeformed();
  share_work(shape_.rows(), places_a_part, [&](Eigen::Index f) {
    for (RowMatrix::InnerIterator entry(shape_, f); entry; ++entry) {
      now.row(f) += entry.value() * at(parameters, static_cast<std::size_t>(entry.col())).head<3>();
    }
  });
  return now;
}

void FaceContact::find_overlaps() {
  links_.clear();
  for (Eigen::Index f = 0; f < push_.size(); ++f) {
    if (gaps_.gaps()[f] < 0) {
      gaps_.append_links(f, links_);
    }
  }
}

void FaceContact::lump() {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(row_sum_.size());
  for (const FaceGaps::Link& l : links_) {
    shares[l.face] += l.share;
    shares[l.opposite] += l.share;
  }
  const Eigen::VectorXd per_face = softness_.cwiseAbs() * shares;
  row_sum_.setZero();
  for (const FaceGaps::Link& l : links_) {
    row_sum_[l.face] += l.share * (per_face[l.face] + per_face[l.opposite]);
  }
}

void FaceContact::sweep() {
  gap_ = gaps_.gaps();
  for (const FaceGaps::Link& l : links_) {
    gap_[l.face] += l.share * l.direction.dot(shift_.row(l.face) - shift_.row(l.opposite));
  }
  for (Eigen::Index f = 0; f < push_.size(); ++f) {
    push_[f] = row_sum_[f] > 0 ? std::max(0.0, push_[f] - gaps_.presence(f) * gap_[f] / row_sum_[f]) : 0;
  }
  force_.setZero();
  for (const FaceGaps::Link& l : links_) {
    const Eigen::RowVector3d push = push_[l.face] * l.share * l.direction;
    force_.row(l.face) += push;
    force_.row(l.opposite) -= push;
  }
  shift_ = softness_ * force_;
}

void FaceContact::shift(NodalVectors& parameters) const {
  for (Eigen::Index f = 0; f < shape_.rows(); ++f) {
    if (force_.row(f).isZero(0)) {
      continue;
    }
    for (RowMatrix::InnerIterator entry(shape_, f); entry; ++entry) {
      at(parameters, static_cast<std::size_t>(entry.col())).head<3>() +=
          inverse_mass_[entry.col()] * entry.value() * force_.row(f);
    }
  }
}

void FaceContact::apply(NodalVectors& parameters) {
  gaps_.move(places(parameters));
  find_overlaps();
  if (links_.empty()) {
    return;
  }
  lump();
  push_.setZero();
  shift_.setZero();
  for (int i = 0; i < sweeps; ++i) {
    sweep();
  }
  shift(parameters);
}

FaceMeasures FaceContact::measure(const NodalVectors& parameters) const {
  constexpr double touch = 0.01;  // of the spacing
  FaceGaps gaps = gaps_;
  gaps.move(places(parameters));
  FaceMeasures measures;
  for (Eigen::Index f = 0; f < push_.size(); ++f) {
    measures.touching_nodes += gaps.gaps()[f] < touch * gaps.spacing(f) ? 1 : 0;
    measures.largest_overlap = std::max(measures.largest_overlap, -gaps.presence(f) * gaps.gaps()[f]);
  }
  return measures;
}

}  // namespace brainshift::solve
