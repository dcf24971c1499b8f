// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "solve/boundary/essential_conditions.hpp"
#include "solve/ensemble/each.hpp"

namespace brainshift::solve {

/// EssentialConditions, imposed exactly, of the members of an ensemble: the same nodes and the same noise, each member
/// with masses of its own and, where they are given, prescribed displacements of its own. All members' systems have one
/// pattern, so one order of elimination serves them all, and a column of L is read once.
class EachConditions {
 public:
  /// prescribed: one a member, (n × 3) mm as `essential` was made from, NaN at the same components; none, or of a
  /// member no rows: those of `essential`.
  EachConditions(const EssentialConditions& essential, std::span<const Points> prescribed);

  /// EssentialConditions::factorise() of the chosen members. Throws as that does.
  void factorise(const EachNumbers& mass, double alpha, const Chosen& chosen);

  /// EssentialConditions::apply() to all members.
  void apply(double fraction, EachVectors& parameters);

  /// From now on nothing but zero is prescribed to a member.
  void let_go(std::size_t member);

  /// As those of EssentialConditions.
  Numbers multiplier_work() const;
  Numbers spring_work(const EachVectors& before, const EachVectors& now) const;

 private:
  /// L D Lᵀ of each member.
  struct Factor {
    std::vector<std::size_t> place;      ///< of each condition in the order of elimination
    std::vector<int> column_begin, row;  ///< of L, without its diagonal
    EachNumbers lower, pivot;

    void set(const EssentialConditions::Factor& of_member, std::size_t member);
    /// Of the members from `first` on, as many as a register has. scratch: as long as x.
    void solve(std::size_t first, EachNumbers& x, EachNumbers& scratch) const;
  };
  struct Component {
    EachNumbers prescribed, multiplier, scratch;
    EachNumbers multiplier_before;  ///< empty: held exactly
    std::shared_ptr<Factor> factor;
  };
  const EssentialConditions::Component& of_all(std::size_t axis) const { return essential_.components()[axis]; }
  void apply_to(std::size_t axis, std::size_t first, double fraction, EachVectors& parameters);

  EssentialConditions essential_;  // factorised for one member after another
  std::array<Component, 3> component_;
  EachNumbers inverse_mass_;
  std::array<double, 2> fraction_{0, 0};  // of the last two steps
};

}  // namespace brainshift::solve
