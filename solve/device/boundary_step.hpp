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

/// How far a node that may touch has moved, mm; for each of the group of `half` that has it.
template <class Team>
BRAINSHIFT_ON_DEVICE Eigen::Vector3d moved_by(const Team& team, const TouchingNodes& c, std::int32_t row,
                                              const double* u) {
  constexpr int half = Team::half;
  double moved[3] = {};
  BRAINSHIFT_AHEAD
  for (std::int64_t k = c.begin[row] + team.thread() % half; k < c.begin[row + 1]; k += half) {
    const double* of_node = u + 4 * static_cast<std::int64_t>(c.node[k]);
    const double shape = c.shape[k];
    for (int axis = 0; axis < 3; ++axis) {
      moved[axis] += shape * of_node[axis];
    }
  }
  return {team.template sum<half>(moved[0]), team.template sum<half>(moved[1]), team.template sum<half>(moved[2])};
}

/// Σ φ x over the rows that a node is in, x one number a row; for each of the lanes that have it.
template <class Team>
BRAINSHIFT_ON_DEVICE double along_column(const Team& team, std::int64_t begin, std::int64_t end,
                                         const std::int32_t* row, const double* shape, const double* x) {
  constexpr int lanes = Team::lanes;
  double sum = 0;
  BRAINSHIFT_AHEAD
  for (std::int64_t k = begin + team.thread() % lanes; k < end; k += lanes) {
    sum += shape[k] * x[row[k]];
  }
  return team.template sum<lanes>(sum);
}

/// As Contact::apply(): what is outside the skull is put back. Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void touch(const Team& team, const View<Scalar>& v, double* u) {
  const TouchingNodes& c = v.contact;
  for (std::int32_t i = first_group<Team, Team::half>(team); i < c.count; i += all_groups<Team, Team::half>(team)) {
    const Eigen::Vector3d position(c.position[3 * i], c.position[3 * i + 1], c.position[3 * i + 2]);
    const double allowed = c.allowed[i], inverse_row_sum = c.inverse_row_sum[i];
    const Eigen::Vector3d place = position + moved_by(team, c, i, u);
    if (team.thread() % Team::half == 0) {
      const double outside = c.skull.value(place) - allowed;
      Eigen::Vector3d push(0, 0, 0);
      if (outside > 0) {
        push = -outside * inverse_row_sum * c.skull.gradient(place);
      }
      for (int axis = 0; axis < 3; ++axis) {
        c.push[3 * i + axis] = push[axis];
      }
    }
  }
  team.sync_all();
  constexpr int lanes = Team::lanes;
  for (std::int32_t i = first_of_all(team) / lanes; i < c.moved; i += all_threads(team) / lanes) {
    const std::int32_t node = c.moved_node[i];
    const double inverse_mass = v.inverse_mass[node];
    double pushed[3] = {};
    BRAINSHIFT_AHEAD
    for (std::int64_t k = c.moved_begin[i] + team.thread() % lanes; k < c.moved_begin[i + 1]; k += lanes) {
      const double* push = c.push + 3 * static_cast<std::int64_t>(c.moved_row[k]);
      for (int axis = 0; axis < 3; ++axis) {
        pushed[axis] += c.moved_shape[k] * push[axis];
      }
    }
    BRAINSHIFT_UNROLLED
    for (int axis = 0; axis < 3; ++axis) {
      const double sum = team.template sum<lanes>(pushed[axis]);
      if (team.thread() % lanes == axis % lanes) {
        u[4 * static_cast<std::int64_t>(node) + axis] += inverse_mass * sum;
        c.pushed[4 * static_cast<std::int64_t>(node) + axis] = sum;
      }
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

/// As EssentialConditions::apply(). Ends with all threads together. Returns what the thread has of the rate of the
/// reactions' work by the fraction.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE double hold(const Team& team, const View<Scalar>& v, const Motion& m, double fraction) {
  constexpr int wide = Team::wide, lanes = Team::lanes;
  std::int32_t rows = 0, moved = 0;
  double rate = 0;
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
      rate += sum * c.prescribed[row];
    }
  }
  team.sync_all();
  for (std::int32_t i = first_of_all(team) / lanes; i < moved; i += all_threads(team) / lanes) {
    std::int32_t column = i;
    const int axis = component_of(v, column, &Conditions::moved);
    const Conditions& c = v.condition[axis];
    const double sum = along_column(team, c.moved_begin[column], c.moved_begin[column + 1], c.moved_row, c.moved_shape,
                                    m.multiplier_of[axis]);
    if (team.thread() % lanes == 0) {
      const std::int32_t node = c.moved_node[column];
      m.next[4 * static_cast<std::int64_t>(node) + axis] += v.inverse_mass[node] * sum;
    }
  }
  team.sync_all();
  return rate;
}

}  // namespace brainshift::solve::device
