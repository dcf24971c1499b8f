// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/device/each/step.hpp"

namespace brainshift::solve::device {

/// Σ φ u of a row, u one component of a vector at the nodes.
BRAINSHIFT_ON_DEVICE inline double along_row(const SparseRows& rows, std::int32_t row, const double* u, int axis,
                                             int member) {
  double sum = 0;
  BRAINSHIFT_AHEAD
  for (std::int64_t k = rows.begin[row]; k < rows.begin[row + 1]; ++k) {
    sum += rows.shape[k] * u[at_member(3 * static_cast<std::int64_t>(rows.node[k]) + axis, member)];
  }
  return sum;
}

/// Where a node that may touch is, mm.
BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d place_of(const ContactOfEach& c, std::int32_t row, const double* u,
                                                     int member) {
  Eigen::Vector3d place(c.position[3 * row], c.position[3 * row + 1], c.position[3 * row + 2]);
  BRAINSHIFT_AHEAD
  for (std::int64_t k = c.begin[row]; k < c.begin[row + 1]; ++k) {
    const double* of_node = u + at_member(3 * static_cast<std::int64_t>(c.node[k]), member);
    BRAINSHIFT_UNROLLED
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] += c.shape[k] * of_node[axis * most_members];
    }
  }
  return place;
}

/// As Contact::apply(): what is outside the skull is put back. Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void touch(const Team& team, const ViewOfEach<Scalar>& v, Members who, double* u) {
  const ContactOfEach& c = v.contact;
  for (std::int32_t i = first_of_each(team); i < c.count; i += all_of_each(team)) {
    const Members touching = team.which(who, [&](int m) {
      const Eigen::Vector3d place = place_of(c, i, u, m);
      const double outside = c.skull.value(place) - c.allowed[i];
      if (!(outside > 0)) {
        return false;
      }
      const Eigen::Vector3d push = -outside * c.inverse_row_sum[at_member(i, m)] * c.skull.gradient(place);
      for (int axis = 0; axis < 3; ++axis) {
        c.push[at_member(3 * static_cast<std::int64_t>(i) + axis, m)] = push[axis];
      }
      return true;
    });
    if (team.leads()) {
      c.touching[i] = touching;
    }
  }
  team.sync_all();
  for (std::int32_t i = first_of_each(team); i < 3 * c.moved; i += all_of_each(team)) {
    const std::int32_t moved = i / 3, axis = i % 3, node = c.moved_node[moved];
    team.for_each(who, [&](int m) {
      double sum = 0;
      BRAINSHIFT_AHEAD
      for (std::int64_t k = c.moved_begin[moved]; k < c.moved_begin[moved + 1]; ++k) {
        const std::int32_t row = c.moved_row[k];
        if ((c.touching[row] >> m & 1) != 0) {
          sum += c.moved_shape[k] * c.push[at_member(3 * static_cast<std::int64_t>(row) + axis, m)];
        }
      }
      u[at_member(3 * static_cast<std::int64_t>(node) + axis, m)] += v.inverse_mass[at_member(node, m)] * sum;
    });
  }
  team.sync_all();
}

/// Components that share an inverse: those of [first, end).
struct SharedInverse {
  int first, end;

  template <class Scalar>
  BRAINSHIFT_ON_DEVICE SharedInverse(const ViewOfEach<Scalar>& v, int axis) : first(axis), end(axis + 1) {
    while (end < 3 && !v.condition[end].own) {
      ++end;
    }
  }
};

/// μ of all conditions from their residuals, a row by a block.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void find_multipliers(const Team& team, const ViewOfEach<Scalar>& v, Members who,
                                           const MotionOfEach& motion) {
  for (int axis = 0; axis < 3;) {
    const SharedInverse shared(v, axis);
    const ConditionsOfEach& c = v.condition[axis];
    for (std::int32_t row = team.block(); row < c.count; row += team.blocks()) {
      Gathered<Team, 3> sum;
      team.for_each(who, [&](int m) {
        BRAINSHIFT_AHEAD
        for (std::int32_t j = team.group(); j < c.count; j += team.groups()) {
          const double inverse = c.inverse[at_member(static_cast<std::int64_t>(row) * c.count + j, m)];
          BRAINSHIFT_UNROLLED
          for (int k = 0; k < 3; ++k) {
            if (shared.first + k < shared.end) {
              sum.at(k, m) -= inverse * v.condition[shared.first + k].residual[at_member(j, m)];
            }
          }
        }
      });
      team.template combine<3>(sum.of, [&](int k, int m, double x) {
        if (shared.first + k < shared.end) {
          motion.multiplier[shared.first + k][at_member(row, m)] = x;
        }
      });
    }
    axis = shared.end;
  }
}

/// As EssentialConditions::apply(), to `next`. Ends with all threads together.
template <class Team, class Scalar>
BRAINSHIFT_ON_DEVICE void hold(const Team& team, const ViewOfEach<Scalar>& v, Members who, const MotionOfEach& motion,
                               const double* fraction) {
  const AllComponents rows(v, &SparseRows::count), moved(v, &SparseRows::moved);
  for (std::int32_t i = first_of_each(team); i < rows.begin[3]; i += all_of_each(team)) {
    const int axis = rows.axis_of(i);
    const ConditionsOfEach& c = v.condition[axis];
    const std::int32_t row = i - rows.begin[axis];
    team.for_each(who, [&](int m) {
      const std::int64_t at = at_member(row, m);
      c.residual[at] = fraction[m] * c.prescribed[at] - along_row(c, row, motion.next, axis, m);
    });
  }
  team.sync_all();
  find_multipliers(team, v, who, motion);
  team.sync_all();
  for (std::int32_t i = first_of_each(team); i < moved.begin[3]; i += all_of_each(team)) {
    const int axis = moved.axis_of(i);
    const ConditionsOfEach& c = v.condition[axis];
    const std::int32_t column = i - moved.begin[axis], node = c.moved_node[column];
    team.for_each(who, [&](int m) {
      double sum = 0;
      BRAINSHIFT_AHEAD
      for (std::int64_t k = c.moved_begin[column]; k < c.moved_begin[column + 1]; ++k) {
        sum += c.moved_shape[k] * motion.multiplier[axis][at_member(c.moved_row[k], m)];
      }
      motion.next[at_member(3 * static_cast<std::int64_t>(node) + axis, m)] += v.inverse_mass[at_member(node, m)] * sum;
    });
  }
  team.sync_all();
}

}  // namespace brainshift::solve::device
