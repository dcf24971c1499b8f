// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/contradictions.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "solve/load/joined_points.hpp"

namespace brainshift::solve {

namespace {

constexpr double raised = 30;  // factor of a standard deviation, after which a point counts for a thousandth

using Groups = std::vector<std::vector<Eigen::Index>>;

/// The groups of more than one point, those of the cortex and those of points inside.
Groups groups_of(const CraniotomyLoad& load, const std::vector<Eigen::Index>& inner) {
  Groups groups;
  for (const std::vector<Eigen::Index>& kind : {rows_but(inner, load.positions.rows()), inner}) {
    for (std::vector<Eigen::Index>& group : joined_rows(load.positions(kind, Eigen::all), most_measured_points)) {
      if (group.size() > 1) {
        std::ranges::transform(group, group.begin(), [&](Eigen::Index i) { return kind[static_cast<std::size_t>(i)]; });
        groups.push_back(std::move(group));
      }
    }
  }
  return groups;
}

/// Of each point of a group the distance from the weighted mean of the others, in standard deviations of it.
Eigen::VectorXd off_from_others(const CraniotomyLoad& load, const std::vector<Eigen::Index>& group) {
  const Eigen::ArrayX3d u = load.displacement(group, Eigen::all).array();
  const Eigen::ArrayX3d variance = load.sigma(group, Eigen::all).array().square(), weight = variance.inverse();
  const Eigen::Array3d total = weight.colwise().sum(), sum = (weight * u).colwise().sum();
  Eigen::VectorXd off(u.rows());
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const Eigen::Array3d own = weight.row(i).transpose(), others = total - own;
    const Eigen::Array3d mean = (sum - own * u.row(i).transpose()) / others;
    off[i] = ((u.row(i).transpose() - mean).square() / (own.inverse() + others.inverse())).sum();
  }
  return off.cwiseSqrt();
}

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far points usually lie from the median of their group, which a wrong one hardly moves, over what is usual of a
/// Gaussian; at least 1.
double usual_of(const CraniotomyLoad& load, const Groups& groups) {
  std::vector<double> all;
  for (const std::vector<Eigen::Index>& group : groups) {
    const Points u = load.displacement(group, Eigen::all), sigma = load.sigma(group, Eigen::all);
    Eigen::RowVector3d median;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      median[axis] = middle_of({u.col(axis).begin(), u.col(axis).end()});
    }
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      all.push_back((u.row(i) - median).cwiseQuotient(sigma.row(i)).norm());
    }
  }
  return all.empty() ? 1 : std::max(1.0, middle_of(std::move(all)) / usual_surprise);
}

}  // namespace

std::optional<Outlier> worst_of_joined(const CraniotomyLoad& load, const std::vector<Eigen::Index>& inner) {
  const Groups groups = groups_of(load, inner);
  const double usual = usual_of(load, groups);
  std::optional<Outlier> worst;
  for (const std::vector<Eigen::Index>& group : groups) {
    Eigen::Index at = 0;
    const double off = off_from_others(load, group).maxCoeff(&at) / usual;
    if (off > std::max(surprising, worst ? worst->deviations : 0)) {
      worst = {load.positions.row(group[static_cast<std::size_t>(at)]), off};
    }
  }
  return worst;
}

LessenedPoints lessen_joined(CraniotomyLoad& load, const std::vector<Eigen::Index>& inner) {
  const Groups groups = groups_of(load, inner);
  const double usual = usual_of(load, groups);
  std::vector<Eigen::Index> lessened;
  for (const std::vector<Eigen::Index>& group : groups) {
    std::vector<bool> counts(group.size(), true);
    for (std::size_t left = group.size(); left > 1;) {
      Eigen::VectorXd off = off_from_others(load, group);
      for (std::size_t i = 0; i < group.size(); ++i) {
        off[static_cast<Eigen::Index>(i)] *= counts[i] ? 1 : 0;
      }
      const double farthest = off.maxCoeff();
      if (!(farthest > surprising * usual)) {
        break;
      }
      for (std::size_t i = 0; i < group.size(); ++i) {
        if (counts[i] && (left == 2 || off[static_cast<Eigen::Index>(i)] == farthest)) {
          counts[i] = false;
          load.sigma.row(group[i]) *= raised;
          lessened.push_back(group[i]);
        }
      }
      left = static_cast<std::size_t>(std::count(counts.begin(), counts.end(), true));
    }
  }
  return {load.positions(lessened, Eigen::all), load.positions.rows()};
}

}  // namespace brainshift::solve
