// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/boundary/contact.hpp"
#include "solve/ensemble/each.hpp"

namespace brainshift::solve {

/// Contact of the members of an ensemble with one skull.
class EachContact {
 public:
  /// contact must outlive this.
  explicit EachContact(const Contact& contact);

  /// Contact::weigh() of the chosen members.
  void weigh(const EachNumbers& mass, const Chosen& chosen);

  /// Contact::apply() to the chosen members; the others are let through.
  void apply(const Chosen& chosen, EachVectors& parameters);

 private:
  /// chosen: 1, else 0.
  void find_push(std::size_t i, const Numbers& chosen, const EachVectors& parameters);
  void push(std::size_t first, EachVectors& parameters) const;

  const Contact& contact_;
  EachNumbers inverse_mass_;           // one a node of the cloud
  EachNumbers inverse_row_sum_;        // one a node that may touch
  EachVectors push_;                   // the same
  std::vector<std::uint8_t> touches_;  // whether the push of any member is not zero
};

}  // namespace brainshift::solve
