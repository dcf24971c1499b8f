// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/boundary/face_gaps.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solve/arrays/shared_work.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

// in spacings
constexpr double neighbourhood = 2.2;    // of a place on its cut
constexpr double opposite_within = 1.2;  // of a node to the opposite face: more than half the widest hole between nodes

constexpr double look_ahead = 0.5;  // beyond that, for nodes of a cavity's wall: how far they come before the next look

double bell(double squared) {
  return squared < 1 ? (1 - squared) * (1 - squared) : 0;
}

double radius(const FacePlace& p, const FacePlace& q) {
  return neighbourhood * std::max(p.spacing, q.spacing);
}

/// Near, and not of another cut that crosses or runs beside.
bool are_neighbours(const FacePlace& p, const FacePlace& q) {
  constexpr double least_aligned = 0.5, most_off = 0.5;  // cosine; of their distance
  const Eigen::Vector3d apart = q.place - p.place;
  const double distance = apart.norm();
  return distance > 0 && distance < radius(p, q) && p.normal.dot(q.normal) > least_aligned &&
         std::abs(p.normal.dot(apart)) < most_off * distance;
}

}  // namespace

FaceGaps::FaceGaps(std::vector<FacePlace> places, Points undeformed, Faces kind)
    : kind_(kind),
      sides_(kind == Faces::of_cuts ? 2 : 1),
      places_(std::move(places)),
      begin_{0},
      undeformed_(std::move(undeformed)),
      normal_(undeformed_.rows(), 3),
      undeformed_gap_(Eigen::VectorXd::Zero(undeformed_.rows())),
      gap_(undeformed_.rows()),
      presence_(undeformed_.rows()) {
  Points where(static_cast<Eigen::Index>(places_.size()), 3);
  std::vector<double> reach;
  for (const FacePlace& p : places_) {
    where.row(static_cast<Eigen::Index>(reach.size())) = p.place;
    reach.push_back(neighbourhood * p.spacing);
  }
  const SupportSearch search(where, reach);
  std::vector<std::int32_t> near;
  for (const FacePlace& p : places_) {
    search.find(p.place, 1, near, neighbourhood * p.spacing);
    append_neighbours(p, near);
  }
  move(undeformed_);
  undeformed_gap_.swap(gap_);  // which was 0
  if (kind_ == Faces::of_cavity) {
    undeformed_gap_ = undeformed_gap_.cwiseMin(0);
  }
}

/// The weights are those of least squares. Along a direction in which there are no neighbours the face does not turn.
void FaceGaps::append_neighbours(const FacePlace& place, std::span<const std::int32_t> near) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const std::int32_t j : near) {
    const FacePlace& other = places_[static_cast<std::size_t>(j)];
    if (are_neighbours(place, other)) {
      const Eigen::Vector3d apart = other.place - place.place;
      const double w = bell(apart.squaredNorm() / (radius(place, other) * radius(place, other)));
      neighbours_.push_back({j, w * apart});
      moment += w * apart * apart.transpose();
    }
  }
  constexpr double small = 1e-6;
  moment.diagonal().array() += small * moment.trace();
  const Eigen::Matrix3d inverse = moment.inverse();
  for (std::size_t i = begin_.back(); i < neighbours_.size(); ++i) {
    neighbours_[i].weight = inverse * neighbours_[i].weight;
  }
  begin_.push_back(neighbours_.size());
}

std::span<const FaceGaps::Neighbour> FaceGaps::neighbours(Eigen::Index place) const {
  const auto i = static_cast<std::size_t>(place);
  return std::span(neighbours_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
}

/// Nanson's: cof(F) N, with the gradient F along the face, no longer than 1. Where a face folds it passes through 0:
/// what takes its direction alone would jump.
Eigen::Vector3d FaceGaps::outward_normal(Eigen::Index face) const {
  const Eigen::Index side = face % sides_;
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (const Neighbour& n : neighbours(face / sides_)) {
    const Eigen::Index other = sides_ * n.place + side;
    f += (now_.row(other) - undeformed_.row(other) - now_.row(face) + undeformed_.row(face)).transpose() *
         n.weight.transpose();
  }
  const Eigen::Vector3d& n = at(face / sides_).normal;
  const Eigen::Vector3d turned =
      n[0] * f.col(1).cross(f.col(2)) + n[1] * f.col(2).cross(f.col(0)) + n[2] * f.col(0).cross(f.col(1));
  return (side == 0 ? -1 : 1) * turned / std::max(1.0, turned.norm());
}

/// On the opposite face, from neighbour to neighbour, from where the two were together.
Eigen::Index FaceGaps::nearest_place(Eigen::Index face) const {
  const auto distance = [&](Eigen::Index place) {
    return (now_.row(2 * place + 1 - face % 2) - now_.row(face)).squaredNorm();
  };
  Eigen::Index nearest = face / 2, from = -1;
  double least = distance(nearest);
  while (nearest != from) {
    from = nearest;
    for (const Neighbour& n : neighbours(from)) {
      if (const double d = distance(n.place); d < least) {
        least = d;
        nearest = n.place;
      }
    }
  }
  return nearest;
}

/// Undeformed, each in front of the other's face. Two walls with a sheet of tissue between them are not.
bool FaceGaps::met_through_cavity(Eigen::Index face, Eigen::Index other) const {
  const Eigen::Vector3d apart = undeformed_.row(other) - undeformed_.row(face);
  return apart.dot(at(face).normal) < 0 && apart.dot(at(other).normal) > 0;
}

/// Two nodes that come towards each other each go half the way.
bool FaceGaps::has_come_near() const {
  for (Eigen::Index f = 0; f < now_.rows(); ++f) {
    if ((now_.row(f) - looked_at_.row(f)).norm() > look_ahead / 2 * spacing(f)) {
      return true;
    }
  }
  return false;
}

void FaceGaps::look_for_opposite() {
  looked_at_ = now_;
  opposite_.assign(static_cast<std::size_t>(now_.rows()), {});
  std::vector<double> reach(opposite_.size());
  for (std::size_t f = 0; f < reach.size(); ++f) {
    reach[f] = (opposite_within + look_ahead) * spacing(static_cast<Eigen::Index>(f));
  }
  const SupportSearch search(looked_at_, std::move(reach));
  share_work(now_.rows(), places_a_part, [&](Eigen::Index f) {
    std::vector<std::int32_t>& opposite = opposite_[static_cast<std::size_t>(f)];
    search.find(looked_at_.row(f), 1, opposite);
    std::erase_if(opposite, [&](std::int32_t other) { return !met_through_cavity(f, other); });
  });
}

/// Calls visit(opposite, weight, direction) for the nodes within opposite_within.
template <class Visit>
void FaceGaps::visit_opposite(Eigen::Index face, const Visit& visit) const {
  const Eigen::Vector3d inward = -normal_.row(face);
  const auto look = [&](Eigen::Index other) {
    const Eigen::Vector3d outward = normal_.row(other);
    const double r = opposite_within * spacing(other);
    const double aligned = std::max(0.0, outward.dot(inward));
    const double w = aligned * bell((now_.row(face) - now_.row(other)).squaredNorm() / (r * r));
    if (w > 0) {
      visit(other, w, (outward.normalized() + inward.normalized()).normalized());
    }
  };
  if (kind_ == Faces::of_cavity) {
    for (const Eigen::Index other : opposite_[static_cast<std::size_t>(face)]) {
      look(other);
    }
    return;
  }
  const Eigen::Index nearest = nearest_place(face), side = 1 - face % 2;
  look(2 * nearest + side);
  for (const Neighbour& n : neighbours(nearest)) {
    look(2 * n.place + side);
  }
}

double FaceGaps::mean_gap(Eigen::Index face) {
  double sum = 0, weight = 0;
  visit_opposite(face, [&](Eigen::Index other, double w, const Eigen::Vector3d& direction) {
    weight += w;
    sum += w * direction.dot(now_.row(face) - now_.row(other));
  });
  constexpr double full = 0.1;  // of the weight of a node at the same place
  presence_[face] = std::min(1.0, weight / full);
  return weight > 0 ? sum / weight - undeformed_gap_[face] : std::numeric_limits<double>::infinity();
}

void FaceGaps::move(Points now) {
  now_ = std::move(now);
  if (kind_ == Faces::of_cavity && (looked_at_.rows() == 0 || has_come_near())) {
    look_for_opposite();
  }
  share_work(gap_.size(), places_a_part, [&](Eigen::Index f) { normal_.row(f) = outward_normal(f); });
  share_work(gap_.size(), places_a_part, [&](Eigen::Index f) { gap_[f] = mean_gap(f); });
}

void FaceGaps::append_links(Eigen::Index face, std::vector<Link>& links) const {
  const std::size_t first = links.size();
  double weight = 0;
  visit_opposite(face, [&](Eigen::Index other, double w, const Eigen::Vector3d& direction) {
    weight += w;
    links.push_back({.face = face, .opposite = other, .share = w, .direction = direction});
  });
  for (std::size_t i = first; i < links.size(); ++i) {
    links[i].share /= weight;
  }
}

}  // namespace brainshift::solve
