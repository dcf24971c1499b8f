// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/step.hpp"

namespace brainshift::solve::device {

/// An entry of V M⁻¹ Vᵀ: two rows whose nodes ascend.
BRAINSHIFT_ON_DEVICE inline double entry_of_system(const ConditionsOfEach& c, const double* inverse_mass,
                                                   std::int32_t i, std::int32_t j, int member) {
  std::int64_t k = c.begin[i], l = c.begin[j];
  double sum = 0;
  while (k < c.begin[i + 1] && l < c.begin[j + 1]) {
    if (c.node[k] == c.node[l]) {
      sum += c.shape[k] * c.shape[l] * inverse_mass[at_member(c.node[k], member)];
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

/// V M⁻¹ Vᵀ + C/(sα) in the place of its inverse. Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_system(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order,
                                      const ConditionsOfEach& c) {
  const std::int64_t n = c.count;
  for (std::int64_t e = first_of_each(team); e < n * n; e += all_of_each(team)) {
    const auto i = static_cast<std::int32_t>(e / n), j = static_cast<std::int32_t>(e % n);
    team.for_each(order.who, [&](int m) {
      const double entry =
          entry_of_system(c, v.inverse_mass, i, j, m) + (c.compliance == nullptr ? 0 : c.compliance[e] / order.alpha);
      c.inverse[at_member(e, m)] = entry;
      if (j == 0) {
        c.column[at_member(i, m)] = entry;
      }
      if (j == i) {
        c.column[at_member(2 * n + i, m)] = entry;
      }
    });
  }
  team.sync_all();
}

/// The negative inverse by sweeps as in ../weigh.hpp, of all members at once. Ends with all threads together.
template <class Team>
BRAINSHIFT_ON_DEVICE void invert(const Team& team, Members who, const ConditionsOfEach& c, RecordOfEach& record) {
  constexpr double smallest_pivot = 1e-10;  // over the diagonal, as the host has it
  const std::int64_t n = c.count;
  for (std::int64_t k = 0; k < n; ++k) {
    const double* column = c.column + at_member(k % 2 * n, 0);
    double* next = c.column + at_member((1 - k % 2) * n, 0);
    if (first_of_each(team) == 0) {
      team.for_each(who, [&](int m) {
        if (!(column[at_member(k, m)] > smallest_pivot * c.column[at_member(2 * n + k, m)])) {
          record.singular[m] = 1;
        }
      });
    }
    BRAINSHIFT_AHEAD
    for (std::int64_t e = first_of_each(team); e < n * n; e += all_of_each(team)) {
      const std::int64_t i = e / n, j = e % n;
      team.for_each(who, [&](int m) {
        const double pivot = column[at_member(k, m)];
        double entry;
        if (i == k || j == k) {
          entry = i == j ? -1 / pivot : column[at_member(i == k ? j : i, m)] / pivot;
        } else {
          entry = c.inverse[at_member(e, m)] - column[at_member(i, m)] / pivot * column[at_member(j, m)];
        }
        c.inverse[at_member(e, m)] = entry;
        if (j == k + 1) {
          next[at_member(i, m)] = entry;
        }
      });
    }
    team.sync_all();
  }
}

/// What depends on the masses, which `stiffer_mass` holds.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void weigh(const Team& team, const ViewOfEach<Scalar>& v, const OrderOfEach& order) {
  for (std::int32_t a = first_of_each(team); a < v.nodes; a += all_of_each(team)) {
    team.for_each(order.who, [&](int m) {
      const std::int64_t i = at_member(a, m);
      const double mass = v.stiffer_mass[i];
      v.mass[i] = mass;
      v.inverse_mass[i] = 1 / mass;
    });
  }
  if (first_of_each(team) == 0) {
    team.for_each(order.who, [&](int m) { v.record->singular[m] = 0; });
  }
  team.sync_all();
  const ContactOfEach& contact = v.contact;
  for (std::int32_t i = first_of_each(team); i < contact.count; i += all_of_each(team)) {
    team.for_each(order.who, [&](int m) {
      double sum = 0;
      BRAINSHIFT_AHEAD
      for (std::int64_t k = contact.begin[i]; k < contact.begin[i + 1]; ++k) {
        const std::int32_t node = contact.node[k];
        sum += std::abs(contact.shape[k]) * v.inverse_mass[at_member(node, m)] * contact.column_sum[node];
      }
      contact.inverse_row_sum[at_member(i, m)] = 1 / sum;
    });
  }
  for (const ConditionsOfEach& c : v.condition) {
    if (c.own) {
      find_system(team, v, order, c);
      invert(team, order.who, c, *v.record);
    }
  }
}

}  // namespace brainshift::solve::device
