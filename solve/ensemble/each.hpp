// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "solve/arrays/lanes.hpp"
#include "solve/arrays/nodal_vectors.hpp"

namespace brainshift::solve {

// Several loads of one body are its members. What a step reads of the body is read once for all of them; what differs
// lies member by member in registers.

/// Members that are stepped together: single precision fills one register of 512 bits with them.
inline constexpr std::size_t members = 16;

/// Of them as many as a Lane has: double precision fills a register with them.
inline constexpr std::size_t members_at_once = lanes;

/// A number of each member.
template <class Scalar>
struct alignas(64) NumberOfEach {
  Scalar of[members];
};

/// A vector of each member, component by component.
template <class Scalar>
struct alignas(64) VectorOfEach {
  Scalar of[3][members];
};

/// A tensor of 3 × 3 of each member, column-major.
template <class Scalar>
struct alignas(64) TensorOfEach {
  Scalar entry[9][members];
};

/// Vectors at the nodes.
using EachVectors = std::vector<VectorOfEach<double>>;

/// Values at the nodes.
using EachNumbers = std::vector<NumberOfEach<double>>;

/// A number of each member, to calculate with.
using Numbers = Eigen::Array<double, static_cast<int>(members), 1>;

/// Which members.
using Chosen = std::array<bool, members>;

inline Eigen::Map<const Numbers> numbers(const double (&of)[members]) {
  return Eigen::Map<const Numbers>(of);
}
inline Eigen::Map<Numbers> numbers(double (&of)[members]) {
  return Eigen::Map<Numbers>(of);
}

/// NaN where one is.
inline Numbers lesser_of_each(const Numbers& a, const Numbers& b) {
  return (a <= b).select(a, (b <= a).select(b, Numbers::Constant(std::numeric_limits<double>::quiet_NaN())));
}

/// Σ a·b over the components.
inline Numbers dot(const VectorOfEach<double>& a, const VectorOfEach<double>& b) {
  return numbers(a.of[0]) * numbers(b.of[0]) + numbers(a.of[1]) * numbers(b.of[1]) +
         numbers(a.of[2]) * numbers(b.of[2]);
}

inline VectorOfEach<double> difference(const VectorOfEach<double>& a, const VectorOfEach<double>& b) {
  VectorOfEach<double> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    numbers(result.of[axis]) = numbers(a.of[axis]) - numbers(b.of[axis]);
  }
  return result;
}

/// sum_over_nodes() of each member.
template <class Term>
Numbers sum_of_each(std::size_t nodes, const Term& term) {
  const Numbers none = Numbers::Zero();
  return sum_over_nodes(nodes, term, none);
}

/// Sets the inverse masses of the members that are chosen, and calls visit(m, masses of member m) for each of them.
template <class Visit>
void invert_masses(const EachNumbers& mass, const Chosen& chosen, EachNumbers& inverse_mass, const Visit& visit) {
  inverse_mass.resize(mass.size(), {});
  std::vector<double> of_member(mass.size());
  for (std::size_t m = 0; m < members; ++m) {
    if (!chosen[m]) {
      continue;
    }
    for (std::size_t a = 0; a < mass.size(); ++a) {
      of_member[a] = mass[a].of[m];
      inverse_mass[a].of[m] = 1 / of_member[a];
    }
    visit(m, of_member);
  }
}

/// One member's vectors.
inline NodalVectors member_of(const EachVectors& vectors, std::size_t member) {
  NodalVectors result(4 * vectors.size(), 0.0);
  for (std::size_t a = 0; a < vectors.size(); ++a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result[4 * a + axis] = vectors[a].of[axis][member];
    }
  }
  return result;
}

/// Sets one member's vectors.
inline void set_member(const NodalVectors& values, std::size_t member, EachVectors& vectors) {
  for (std::size_t a = 0; a < vectors.size(); ++a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vectors[a].of[axis][member] = values[4 * a + axis];
    }
  }
}

}  // namespace brainshift::solve
