// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_contact.hpp"

#include <algorithm>
#include <span>

#include "solve/arrays/shared_work.hpp"
#include "solve/ensemble/each_distance.hpp"

namespace brainshift::solve {

namespace {

/// x += Σφû.
BRAINSHIFT_CLONES
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

/// û += M⁻¹ φ push, of as many members as a Lane has, from the first on.
BRAINSHIFT_CLONES
void add_push(const std::int32_t* node, const double* shape, std::size_t pairs,
              const NumberOfEach<double>* inverse_mass, const VectorOfEach<double>& push, std::size_t first,
              VectorOfEach<double>* parameters) {
  for (std::size_t k = 0; k < pairs; ++k) {
    double share[members_at_once];
    for (std::size_t m = 0; m < members_at_once; ++m) {
      share[m] = inverse_mass[node[k]].of[first + m] * shape[k];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double* u = parameters[node[k]].of[axis] + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        u[m] += share[m] * push.of[axis][first + m];
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
  PushedNodes weighed = contact_.nodes();
  invert_masses(mass, chosen, inverse_mass_, [&](std::size_t m, std::span<const double> of_member) {
    weighed.weigh(of_member);
    for (std::size_t i = 0; i < inverse_row_sum_.size(); ++i) {
      inverse_row_sum_[i].of[m] = weighed.inverse_row_sum()[i];
    }
  });
}

void EachContact::find_push(std::size_t i, const Numbers& chosen, const EachVectors& parameters) {
  const auto [node, shape] = contact_.nodes().row(i);
  const Eigen::RowVector3d start = contact_.nodes().positions().row(static_cast<Eigen::Index>(i));
  VectorOfEach<double> x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    numbers(x.of[axis]) = start[static_cast<Eigen::Index>(axis)];
  }
  add_displacement(node.data(), shape.data(), node.size(), parameters.data(), x);
  const Numbers outside = numbers(distance_of_each(*contact_.skull(), x).of) - contact_.allowed()[i];
  const Numbers length = (outside > 0).select(-outside * numbers(inverse_row_sum_[i].of), 0.0) * chosen;
  touches_[i] = (length < 0).any() ? 1 : 0;
  if (touches_[i] != 0) {
    push_[i] = gradient_of_each(*contact_.skull(), x);
    for (auto& axis : push_[i].of) {
      numbers(axis) *= length;
    }
  }
}

void EachContact::push(std::size_t first, EachVectors& parameters) const {
  for (std::size_t i = 0; i < push_.size(); ++i) {
    if (touches_[i] != 0) {
      const auto [node, shape] = contact_.nodes().row(i);
      add_push(node.data(), shape.data(), node.size(), inverse_mass_.data(), push_[i], first, parameters.data());
    }
  }
}

void EachContact::apply(const Chosen& chosen, EachVectors& parameters) {
  const auto nodes = static_cast<std::int64_t>(push_.size());
  Numbers one_where_chosen;
  std::copy(chosen.begin(), chosen.end(), one_where_chosen.begin());
  share_work(nodes, places_a_part,
             [&](std::int64_t i) { find_push(static_cast<std::size_t>(i), one_where_chosen, parameters); });
  share_work(members / members_at_once, 1,
             [&](std::int64_t i) { push(static_cast<std::size_t>(i) * members_at_once, parameters); });
}

}  // namespace brainshift::solve
