// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

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

constexpr std::int32_t pivots_at_once = 32, rows_at_once = 4;

/// What a block needs to sweep, bytes.
constexpr std::size_t room_to_sweep = (2 * pivots_at_once + rows_at_once) * pivots_at_once * sizeof(double);

/// Sweeps the square of some pivots, which each block does for itself: a[i][j], of which b is a second one. Returns
/// where the negative inverse lies. diagonal: of the whole matrix, from the first pivot on.
template <class Team>
BRAINSHIFT_ON_DEVICE double* sweep_pivots(const Team& team, std::int32_t pivots, const double* diagonal, double* a,
                                          double* b, Record& record) {
  constexpr double smallest_pivot = 1e-10;  // over the diagonal, as the host has it
  constexpr std::int32_t width = pivots_at_once;
  for (std::int32_t k = 0; k < pivots; ++k) {
    const double pivot = a[k * width + k];
    if (first_of_all(team) == 0 && !(pivot > smallest_pivot * diagonal[k])) {
      record.singular = 1;
    }
    for (std::int32_t e = team.thread(); e < pivots * pivots; e += team.threads()) {
      const std::int32_t i = e / pivots, j = e % pivots;
      const double of_row = a[i * width + k] / pivot, of_column = a[k * width + j];
      double entry = a[i * width + j] - of_row * of_column;
      if (i == k || j == k) {
        entry = i == j ? -1 / pivot : (i == k ? of_column / pivot : of_row);
      }
      b[i * width + j] = entry;
    }
    team.sync_block();
    double* const swept = b;
    b = a;
    a = swept;
  }
  return a;
}

/// Some rows of the matrix, from `first_row` on, when pivots have been swept: negative: of sweep_pivots(). panel: the
/// pivots' columns before, one after the other; next: those of the next pivots, to be kept.
template <class Team>
BRAINSHIFT_ON_DEVICE void sweep_rows(const Team& team, const Conditions& c, std::int32_t first_row,
                                     std::int32_t first_pivot, std::int32_t pivots, const double* negative,
                                     const double* panel, double* rows, double* next) {
  constexpr std::int32_t width = pivots_at_once;
  const std::int32_t n = c.count, count = n - first_row < rows_at_once ? n - first_row : rows_at_once;
  const auto is_pivot = [&](std::int32_t i) { return i >= first_pivot && i < first_pivot + pivots; };
  for (std::int32_t e = team.thread(); e < count * pivots; e += team.threads()) {
    const std::int32_t i = first_row + e / pivots, m = e % pivots;
    double sum = is_pivot(i) ? -negative[(i - first_pivot) * width + m] : 0;
    for (std::int32_t l = 0; l < pivots && !is_pivot(i); ++l) {
      sum -= panel[static_cast<std::int64_t>(l) * n + i] * negative[l * width + m];
    }
    rows[e / pivots * width + m] = sum;
  }
  team.sync_block();
  for (std::int32_t e = team.thread(); e < count * n; e += team.threads()) {
    const std::int32_t i = first_row + e / n, j = e % n;
    const double* row = rows + e / n * width;
    double& entry = c.inverse[static_cast<std::int64_t>(i) * n + j];
    if (is_pivot(j)) {
      entry = is_pivot(i) ? negative[(i - first_pivot) * width + j - first_pivot] : row[j - first_pivot];
    } else {
      double sum = 0;
      BRAINSHIFT_AHEAD
      for (std::int32_t m = 0; m < pivots; ++m) {
        sum += row[m] * panel[static_cast<std::int64_t>(m) * n + j];
      }
      entry = is_pivot(i) ? sum : entry - sum;
    }
    const std::int32_t of_next = j - first_pivot - pivots;
    if (of_next >= 0 && of_next < width) {
      next[static_cast<std::int64_t>(of_next) * n + i] = entry;
    }
  }
  team.sync_block();
}

/// The negative inverse by sweeps of the symmetric matrix (Goodnight 1979, Am. Stat. 33:149), some pivots at a time, so
/// that the blocks wait for each other less often.
template <class Team>
BRAINSHIFT_ON_DEVICE void invert(const Team& team, const Conditions& c, Record& record) {
  constexpr std::int32_t width = pivots_at_once;
  const std::int32_t n = c.count;
  const std::int64_t of_panel = static_cast<std::int64_t>(width) * n;
  double* const square = reinterpret_cast<double*>(team.room());
  double* const rows = square + 2 * width * width;
  for (std::int32_t first = 0, panels = 0; first < n; first += width, ++panels) {
    const std::int32_t pivots = n - first < width ? n - first : width;
    const double* panel = c.panel + panels % 2 * of_panel;
    double* next = c.panel + (1 - panels % 2) * of_panel;
    for (std::int32_t e = team.thread(); e < pivots * pivots; e += team.threads()) {
      square[e / pivots * width + e % pivots] = panel[static_cast<std::int64_t>(e % pivots) * n + first + e / pivots];
    }
    team.sync_block();
    const double* negative = sweep_pivots(team, pivots, c.diagonal + first, square, square + width * width, record);
    for (std::int32_t row = team.block() * rows_at_once; row < n; row += team.blocks() * rows_at_once) {
      sweep_rows(team, c, row, first, pivots, negative, panel, rows, next);
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
        if (j < pivots_at_once) {
          c.panel[static_cast<std::int64_t>(j) * c.count + i] = entry;
        }
        if (j == i) {
          c.diagonal[i] = entry;
        }
      }
    }
    team.sync_all();
    invert(team, c, *v.record);
  }
}

}  // namespace brainshift::solve::device
