// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/node_step.hpp"

namespace brainshift::solve::device {

/// An entry of V M⁻¹ Vᵀ: two rows whose nodes ascend.
BRAINSHIFT_ON_DEVICE inline double entry_of_system(const Conditions& c, const double* inverse_mass, std::int32_t i,
                                                   std::int32_t j) {
  std::int64_t k = c.begin[i], l = c.begin[j];
  double sum = 0;
  while (k < c.begin[i + 1] && l < c.begin[j + 1]) {
    if (c.node[k] == c.node[l]) {
      sum += c.shape[k] * c.shape[l] * inverse_mass[c.node[k]];
      ++k;
      ++l;
    } else if (c.node[k] < c.node[l]) {
      ++k;
    } else {
      ++l;
    }
  }
  return sum;
}

/// The negative inverse by sweeps of the symmetric matrix, one row after the other (Goodnight 1979, Am. Stat. 33:149):
/// no thread waits for another but between rows. The row at hand lies apart, in one of two.
template <class Team>
BRAINSHIFT_ON_DEVICE void invert(const Team& team, const Conditions& c, Record& record) {
  constexpr double smallest_pivot = 1e-10;  // over the diagonal, as the host has it
  constexpr int wide = Team::wide;
  const std::int32_t n = c.count;
  const double* diagonal = c.column + 2 * static_cast<std::int64_t>(n);
  for (std::int32_t k = 0; k < n; ++k) {
    const double* column = c.column + (k % 2) * static_cast<std::int64_t>(n);
    double* next = c.column + (1 - k % 2) * static_cast<std::int64_t>(n);
    const double pivot = column[k];
    if (first_of_all(team) == 0 && !(pivot > smallest_pivot * diagonal[k])) {
      record.singular = 1;
    }
    for (std::int32_t i = first_group(team); i < n; i += all_groups(team)) {
      const double of_row = column[i] / pivot;
      double* row = c.inverse + static_cast<std::int64_t>(i) * n;
      for (std::int32_t j = team.thread() % wide; j < n; j += wide) {
        double entry = row[j] - of_row * column[j];
        if (i == k || j == k) {
          entry = i == j ? -1 / pivot : column[i == k ? j : i] / pivot;
        }
        row[j] = entry;
        if (j == k + 1) {
          next[i] = entry;
        }
      }
    }
    team.sync_all();
  }
}

/// What depends on the masses, which `stiffer_mass` holds.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void weigh(const Team& team, const View<Scalar>& v, const Order& order) {
  for (std::int32_t a = first_of_all(team); a < v.nodes; a += all_threads(team)) {
    v.mass[a] = v.stiffer_mass[a];
    v.inverse_mass[a] = 1 / v.stiffer_mass[a];
  }
  if (first_of_all(team) == 0) {
    v.record->singular = 0;
  }
  team.sync_all();
  const TouchingNodes& contact = v.contact;
  constexpr int wide = Team::wide;
  for (std::int32_t i = first_group(team); i < contact.count; i += all_groups(team)) {
    double sum = 0;
    for (std::int64_t k = contact.begin[i] + team.thread() % wide; k < contact.begin[i + 1]; k += wide) {
      const std::int32_t node = contact.node[k];
      sum += std::abs(contact.shape[k]) * v.inverse_mass[node] * contact.column_sum[node];
    }
    contact.inverse_row_sum[i] = 1 / team.template sum<wide>(sum);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Conditions& c = v.condition[axis];
    if (!c.own) {
      continue;
    }
    for (std::int32_t i = first_group(team); i < c.count; i += all_groups(team)) {
      const std::int64_t row = static_cast<std::int64_t>(i) * c.count;
      for (std::int32_t j = team.thread() % wide; j < c.count; j += wide) {
        const double entry = entry_of_system(c, v.inverse_mass, i, j) +
                             (c.compliance == nullptr ? 0 : c.compliance[row + j] / order.alpha);
        c.inverse[row + j] = entry;
        if (j == 0) {
          c.column[i] = entry;
        }
        if (j == i) {
          c.column[2 * static_cast<std::int64_t>(c.count) + i] = entry;
        }
      }
    }
    team.sync_all();
    invert(team, c, *v.record);
  }
}

}  // namespace brainshift::solve::device
