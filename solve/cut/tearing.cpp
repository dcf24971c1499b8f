// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/tearing.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

namespace brainshift::solve {

namespace {

constexpr double sharpest_turn = 70.0 / 180 * std::numbers::pi;
constexpr double apart = 3;  // distances between a new tear and what is cut

constexpr double overshoot = 1.25;  // a tear that so nearly reaches another cut runs into it

Cut segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Cut cut;
  cut.name = "a tear";
  cut.vertices.resize(2, 3);
  cut.vertices << from.transpose(), to.transpose();
  return cut;
}

Tear tear_from(const Visibility& cut, const Eigen::Vector3d& tip, const Eigen::Vector3d& step) {
  const bool meets = cut.detour(tip + 0.01 * step, tip + overshoot * step).has_value();
  return {segment(tip, tip + (meets ? overshoot : 1) * step), meets};
}

/// Across the largest stretch; C's lesser eigenvector.
Eigen::Vector3d across(const Eigen::Matrix2d& right_cauchy_green) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(right_cauchy_green);
  return {eigen.eigenvectors()(0, 0), eigen.eigenvectors()(1, 0), 0};
}

Eigen::Vector3d turned(const Eigen::Vector3d& ahead, Eigen::Vector3d to) {
  to *= to.dot(ahead) < 0 ? -1 : 1;
  const double angle = std::atan2(ahead.x() * to.y() - ahead.y() * to.x(), ahead.dot(to));
  const double turn = std::clamp(angle, -sharpest_turn, sharpest_turn);
  return {std::cos(turn) * ahead.x() - std::sin(turn) * ahead.y(),
          std::sin(turn) * ahead.x() + std::cos(turn) * ahead.y(), 0};
}

/// The direction in which a cut runs into its tip.
Eigen::Vector3d direction_at(const CutFacets& cut, std::int32_t tip) {
  for (const auto& f : cut.facets.rowwise()) {
    if (f[0] == tip || f[1] == tip) {
      return (cut.vertices.row(tip) - cut.vertices.row(f[0] == tip ? f[1] : f[0])).normalized();
    }
  }
  return Eigen::Vector3d::UnitX();
}

}  // namespace

Tearing::Tearing(const Rupture& rupture, const IntegrationPoints& points, const Points& held, double spacing,
                 double stride)
    : rupture_(rupture),
      points_(points),
      distance_(rupture.distance > 0 ? rupture.distance : 2 * spacing),
      stride_(stride),
      share_(points.size(), 1) {
  std::mt19937 random(rupture.seed);
  for (std::size_t p = 0; p < share_.size(); ++p) {
    const double uniform = static_cast<double>(random()) / 0x1p31 - 1;
    share_[p] *= 1 + rupture.scatter * uniform;
    const Eigen::RowVector3d place = points.positions.row(static_cast<Eigen::Index>(p));
    const bool clamped = held.rows() > 0 && (held.rowwise() - place).rowwise().norm().minCoeff() < 2 * spacing;
    share_[p] = clamped ? std::numeric_limits<double>::infinity() : share_[p];
    const Eigen::Vector2d x = place.head<2>();
    for (const WeakSpot& spot : rupture.weak_spots) {
      share_[p] *= (x - spot.place).norm() < spot.radius ? spot.factor : 1;
    }
  }
}

double Tearing::load(std::size_t point, std::span<const PointStrain> strains) const {
  const PointStrain& strain = strains[point];
  const double load = rupture_.criterion == Rupture::Criterion::stretch
                          ? (strain.largest_stretch - 1) / (rupture_.strength - 1)
                          : strain.largest_stress / rupture_.strength;
  return load / share_[point];
}

/// ahead: only points before the place, seen in this direction; zero: all about it.
Tearing::Mean Tearing::mean_about(const Eigen::Vector3d& place, const Eigen::Vector3d& ahead,
                                  std::span<const PointStrain> strains) const {
  Mean mean;
  double volume = 0;
  for (std::size_t p = 0; p < strains.size(); ++p) {
    const Eigen::Vector3d away = points_.positions.row(static_cast<Eigen::Index>(p)).transpose() - place;
    const bool counts = away.squaredNorm() < distance_ * distance_ && away.dot(ahead) >= 0;
    if (counts && std::isfinite(share_[p])) {
      const double w = points_.volume[p];
      mean.load += w * load(p, strains);
      mean.right_cauchy_green += w * strains[p].right_cauchy_green;
      volume += w;
    }
  }
  if (volume > 0) {
    mean.load /= volume;
    mean.right_cauchy_green /= volume;
  }
  return mean;
}

std::vector<Tear> Tearing::next(const CutFacets& cut, std::span<const PointStrain> strains, bool may_begin) const {
  std::vector<Tear> tears;
  for (const auto& [tip, same] : cut.front) {
    const Eigen::Vector3d place = cut.vertices.row(tip), ahead = direction_at(cut, tip);
    const bool arrested = std::any_of(arrested_.begin(), arrested_.end(),
                                      [&](const Eigen::Vector3d& a) { return (a - place).norm() < 1e-9 * stride_; });
    const Mean mean = mean_about(place, ahead, strains);
    if (!arrested && mean.load >= 1) {
      tears.push_back(tear_from(Visibility(cut), place, stride_ * turned(ahead, across(mean.right_cauchy_green))));
    }
  }
  if (may_begin && tears.empty()) {
    begin(cut, strains, tears);
  }
  return tears;
}

void Tearing::begin(const CutFacets& cut, std::span<const PointStrain> strains, std::vector<Tear>& tears) const {
  std::optional<Visibility> there;
  if (!cut.empty()) {
    there.emplace(cut);
  }
  std::vector<std::pair<double, std::size_t>> overloaded;
  for (std::size_t p = 0; p < strains.size(); ++p) {
    if (const double at = load(p, strains); at > 1) {
      overloaded.emplace_back(at, p);
    }
  }
  std::sort(overloaded.rbegin(), overloaded.rend());
  for (const auto& [at, p] : overloaded) {
    const Eigen::Vector3d place = points_.positions.row(static_cast<Eigen::Index>(p));
    if (there && there->near(place, apart * distance_)) {
      continue;
    }
    const Mean mean = mean_about(place, Eigen::Vector3d::Zero(), strains);
    if (mean.load >= 1) {
      const Eigen::Vector3d half = stride_ * across(mean.right_cauchy_green);
      tears.push_back({segment(place - half, place + half), false});
      return;
    }
  }
}

}  // namespace brainshift::solve
