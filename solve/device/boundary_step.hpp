// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/node_step.hpp"

namespace brainshift::solve::device {

/// Σ φ û of a row, for each of the group that has it.
template <class Team>
BRAINSHIFT_ON_DEVICE double along_row(const Team& team, const Conditions& c, std::int32_t row, const double* u,
                                      int axis) {
  double sum = 0;
  for (std::int64_t k = c.begin[row] + team.thread() % Team::wide; k < c.begin[row + 1]; k += Team::wide) {
    sum += c.shape[k] * u[4 * static_cast<std::int64_t>(c.node[k]) + axis];
  }
  return team.template sum<Team::wide>(sum);
}

/// Where a node that may touch is, mm; for each of the group that has it.
template <class Team>
BRAINSHIFT_ON_DEVICE Eigen::Vector3d place_of(const Team& team, const TouchingNodes& c, std::int32_t row,
                                              const double* u) {
  Eigen::Vector3d place(0, 0, 0);
  for (std::int64_t k = c.begin[row] + team.thread() % Team::wide; k < c.begin[row + 1]; k += Team::wide) {
    const double* of_node = u + 4 * static_cast<std::int64_t>(c.node[k]);
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] += c.shape[k] * of_node[axis];
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = c.position[3 * row + axis] + team.template sum<Team::wide>(place[axis]);
  }
  return place;
}

/// Σ φ x over the rows that a node is in, x one number a row, `stride` apart; for each of the lanes that have it.
template <class Team>
BRAINSHIFT_ON_DEVICE double along_column(const Team& team, std::int64_t begin, std::int64_t end,
                                         const std::int32_t* row, const double* shape, const double* x, int stride) {
  constexpr int lanes = Team::lanes;
  double sum = 0;
  for (std::int64_t k = begin + team.thread() % lanes; k < end; k += lanes) {
    sum += shape[k] * x[stride * row[k]];
  }
  return team.template sum<lanes>(sum);
}

/// As Contact::apply(): what is outside the skull is put back. Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void touch(const Team& team, const View<Scalar>& v, double* u) {
  const TouchingNodes& c = v.contact;
  for (std::int32_t i = first_group(team); i < c.count; i += all_groups(team)) {
    const Eigen::Vector3d place = place_of(team, c, i, u);
    if (team.thread() % Team::wide == 0) {
      const double outside = c.skull.value(place) - c.allowed[i];
      Eigen::Vector3d push(0, 0, 0);
      if (outside > 0) {
        push = -outside * c.inverse_row_sum[i] * c.skull.gradient(place);
      }
      for (int axis = 0; axis < 3; ++axis) {
        c.push[3 * i + axis] = push[axis];
      }
    }
  }
  team.sync_all();
  constexpr int lanes = Team::lanes;
  for (std::int32_t i = first_of_all(team) / lanes; i < 3 * c.moved; i += all_threads(team) / lanes) {
    const std::int32_t moved = i / 3, axis = i % 3, node = c.moved_node[moved];
    const double sum = along_column(team, c.moved_begin[moved], c.moved_begin[moved + 1], c.moved_row, c.moved_shape,
                                    c.push + axis, 3);
    if (team.thread() % lanes == 0) {
      u[4 * static_cast<std::int64_t>(node) + axis] += v.inverse_mass[node] * sum;
    }
  }
  team.sync_all();
}

/// The component and the row of it, of rows counted over all three; -1: there are no more.
template <class Scalar>
BRAINSHIFT_ON_DEVICE int component_of(const View<Scalar>& v, std::int32_t& row, std::int32_t Conditions::*count) {
  for (int axis = 0; axis < 3; ++axis) {
    if (row < v.condition[axis].*count) {
      return axis;
    }
    row -= v.condition[axis].*count;
  }
  return -1;
}

/// As EssentialConditions::apply(). Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void hold(const Team& team, const View<Scalar>& v, const Motion& m, double fraction) {
  constexpr int wide = Team::wide, lanes = Team::lanes;
  std::int32_t rows = 0, moved = 0;
  for (const Conditions& c : v.condition) {
    rows += c.count;
    moved += c.moved;
  }
  for (std::int32_t i = first_group(team); i < rows; i += all_groups(team)) {
    std::int32_t row = i;
    const int axis = component_of(v, row, &Conditions::count);
    const Conditions& c = v.condition[axis];
    const double place = along_row(team, c, row, m.next, axis);
    if (team.thread() % wide == 0) {
      c.residual[row] = fraction * c.prescribed[row] - place;
    }
  }
  team.sync_all();
  for (std::int32_t i = first_group(team); i < rows; i += all_groups(team)) {
    std::int32_t row = i;
    const int axis = component_of(v, row, &Conditions::count);
    const Conditions& c = v.condition[axis];
    const double* inverse = c.inverse + static_cast<std::int64_t>(row) * c.count;
    double sum = 0;
    BRAINSHIFT_AHEAD
    for (std::int32_t j = team.thread() % wide; j < c.count; j += wide) {
      sum -= inverse[j] * c.residual[j];
    }
    sum = team.template sum<wide>(sum);
    if (team.thread() % wide == 0) {
      m.multiplier_of[axis][row] = sum;
    }
  }
  team.sync_all();
  for (std::int32_t i = first_of_all(team) / lanes; i < moved; i += all_threads(team) / lanes) {
    std::int32_t column = i;
    const int axis = component_of(v, column, &Conditions::moved);
    const Conditions& c = v.condition[axis];
    const double sum = along_column(team, c.moved_begin[column], c.moved_begin[column + 1], c.moved_row, c.moved_shape,
                                    m.multiplier_of[axis], 1);
    if (team.thread() % lanes == 0) {
      const std::int32_t node = c.moved_node[column];
      m.next[4 * static_cast<std::int64_t>(node) + axis] += v.inverse_mass[node] * sum;
    }
  }
  team.sync_all();
}

}  // namespace brainshift::solve::device
