// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_contact.hpp"

#include <algorithm>

#include "solve/arrays/lanes.hpp"

namespace brainshift::solve {

namespace {

/// x += Σφû.
BRAINSHIFT_LANES
void add_displacement(const std::int32_t* node, const double* shape, std::size_t pairs,
                      const VectorOfEach<double>* parameters, VectorOfEach<double>& x) {
  for (std::size_t k = 0; k < pairs; ++k) {
    const VectorOfEach<double>& u = parameters[node[k]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t m = 0; m < members; ++m) {
        x.of[axis][m] += shape[k] * u.of[axis][m];
      }
    }
  }
}

}  // namespace

EachContact::EachContact(const Contact& contact)
    : contact_(contact),
      inverse_row_sum_(contact.nodes().size(), NumberOfEach<double>{}),
      push_(contact.nodes().size(), VectorOfEach<double>{}),
      touches_(contact.nodes().size(), 0) {}

void EachContact::weigh(const EachNumbers& mass, const Chosen& chosen) {
  inverse_mass_.resize(mass.size(), {});
  PushedNodes weighed = contact_.nodes();
  std::vector<double> of_member(mass.size());
  for (std::size_t m = 0; m < members; ++m) {
    if (!chosen[m]) {
      continue;
    }
    for (std::size_t a = 0; a < mass.size(); ++a) {
      of_member[a] = mass[a].of[m];
      inverse_mass_[a].of[m] = 1 / of_member[a];
    }
    weighed.weigh(of_member);
    for (std::size_t i = 0; i < inverse_row_sum_.size(); ++i) {
      inverse_row_sum_[i].of[m] = weighed.inverse_row_sum()[i];
    }
  }
}

void EachContact::find_push(std::size_t i, const Chosen& chosen, const EachVectors& parameters) {
  const auto [node, shape] = contact_.nodes().row(i);
  const Eigen::RowVector3d start = contact_.nodes().positions().row(static_cast<Eigen::Index>(i));
  VectorOfEach<double> x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    numbers(x.of[axis]) = start[static_cast<Eigen::Index>(axis)];
  }
  add_displacement(node.data(), shape.data(), node.size(), parameters.data(), x);
  push_[i] = {};
  touches_[i] = 0;
  for (std::size_t m = 0; m < members; ++m) {
    if (!chosen[m]) {
      continue;
    }
    const Eigen::Vector3d place(x.of[0][m], x.of[1][m], x.of[2][m]);
    const double outside = contact_.skull()->value(place) - contact_.allowed()[i];
    if (outside > 0) {
      const Eigen::Vector3d push = -outside * inverse_row_sum_[i].of[m] * contact_.skull()->gradient(place);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        push_[i].of[axis][m] = push[static_cast<Eigen::Index>(axis)];
      }
      touches_[i] = 1;
    }
  }
}

void EachContact::push(std::size_t axis, std::size_t first, EachVectors& parameters) const {
  for (std::size_t i = 0; i < push_.size(); ++i) {
    if (touches_[i] == 0) {
      continue;
    }
    const double* push = push_[i].of[axis] + first;
    const auto [node, shape] = contact_.nodes().row(i);
    for (std::size_t k = 0; k < node.size(); ++k) {
      const auto a = static_cast<std::size_t>(node[k]);
      double* u = parameters[a].of[axis] + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        u[m] += inverse_mass_[a].of[first + m] * shape[k] * push[m];
      }
    }
  }
}

void EachContact::apply(const Chosen& chosen, EachVectors& parameters) {
  const auto nodes = static_cast<std::int64_t>(push_.size());
  constexpr std::size_t parts = members / members_at_once;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::int64_t i = 0; i < nodes; ++i) {
      find_push(static_cast<std::size_t>(i), chosen, parameters);
    }
#pragma omp for schedule(static, 1)
    for (std::size_t task = 0; task < 3 * parts; ++task) {
      push(task / parts, task % parts * members_at_once, parameters);
    }
  }
}

}  // namespace brainshift::solve
