// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_conditions.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "solve/arrays/lanes.hpp"
#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

/// x ← (L D Lᵀ)⁻¹ x, of as many members as a Lane has, from the first on.
BRAINSHIFT_CLONES
void eliminate(const int* begin, const int* row, std::size_t size, const NumberOfEach<double>* lower,
               const NumberOfEach<double>* pivot, std::size_t first, NumberOfEach<double>* x) {
  for (std::size_t j = 0; j < size; ++j) {
    const double* of_column = x[j].of + first;
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      double* to = x[row[k]].of + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        to[m] -= lower[k].of[first + m] * of_column[m];
      }
    }
  }
  for (std::size_t j = size; j-- > 0;) {
    double* to = x[j].of + first;
    for (std::size_t m = 0; m < members_at_once; ++m) {
      to[m] /= pivot[j].of[first + m];
    }
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      const double* from = x[row[k]].of + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        to[m] -= lower[k].of[first + m] * from[m];
      }
    }
  }
}

}  // namespace

EachConditions::EachConditions(const EssentialConditions& essential, std::span<const Points> prescribed)
    : essential_(essential) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& all = of_all(axis);
    const auto size = static_cast<std::size_t>(all.prescribed.size());
    Component& c = component_[axis];
    c.multiplier.assign(size, {});
    c.scratch.assign(size, {});
    c.multiplier_before.assign(static_cast<std::size_t>(all.multiplier_before.size()), {});
    c.prescribed.assign(size, {});
    for (std::size_t i = 0; i < size; ++i) {
      numbers(c.prescribed[i].of) = all.prescribed[static_cast<Eigen::Index>(i)];
    }
    for (std::size_t m = 0; m < prescribed.size(); ++m) {
      if (prescribed[m].rows() > 0) {
        const Eigen::VectorXd of_member = all.extension * prescribed[m].col(static_cast<Eigen::Index>(axis));
        for (std::size_t i = 0; i < all.node.size(); ++i) {
          c.prescribed[i].of[m] = of_member[static_cast<Eigen::Index>(i)];
        }
      }
    }
  }
}

void EachConditions::Factor::set(const EssentialConditions::Factor& of_member, std::size_t member) {
  const auto& l = of_member.ldlt.matrixL().nestedExpression();
  const auto entries = static_cast<std::size_t>(l.outerIndexPtr()[l.outerSize()]);
  if (place.empty()) {  // the first: conditions that nothing couples have no entry below the diagonal
    const auto& order = of_member.ldlt.permutationP().indices();
    place.assign(order.begin(), order.end());
    column_begin.assign(l.outerIndexPtr(), l.outerIndexPtr() + l.outerSize() + 1);
    row.assign(l.innerIndexPtr(), l.innerIndexPtr() + entries);
    lower.assign(entries, {});
    pivot.assign(place.size(), {});
  }
  for (std::size_t k = 0; k < entries; ++k) {
    lower[k].of[member] = l.valuePtr()[k];
  }
  for (std::size_t i = 0; i < pivot.size(); ++i) {
    pivot[i].of[member] = of_member.pivot[static_cast<Eigen::Index>(i)];
  }
}

void EachConditions::Factor::solve(std::size_t first, EachNumbers& x, EachNumbers& scratch) const {
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::copy_n(x[i].of + first, members_at_once, scratch[place[i]].of + first);
  }
  eliminate(column_begin.data(), row.data(), place.size(), lower.data(), pivot.data(), first, scratch.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::copy_n(scratch[place[i]].of + first, members_at_once, x[i].of + first);
  }
}

void EachConditions::factorise(const EachNumbers& mass, double alpha, const Chosen& chosen) {
  invert_masses(mass, chosen, inverse_mass_, [&](std::size_t m, std::span<const double> of_member) {
    essential_.factorise(of_member, alpha);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (of_all(axis).factor == nullptr) {
        continue;
      }
      std::shared_ptr<Factor>& factor = component_[axis].factor;
      if (axis > 0 && of_all(axis).factor == of_all(axis - 1).factor) {
        factor = component_[axis - 1].factor;
        continue;
      }
      factor = factor ? factor : std::make_shared<Factor>();
      factor->set(*of_all(axis).factor, m);
    }
  });
}

void EachConditions::apply_to(std::size_t axis, std::size_t first, double fraction, EachVectors& parameters) {
  using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  Component& c = component_[axis];
  const auto& shape = of_all(axis).shape;
  for (std::size_t i = 0; i < c.multiplier.size(); ++i) {
    double* multiplier = c.multiplier[i].of + first;
    for (std::size_t m = 0; m < members_at_once; ++m) {
      multiplier[m] = fraction * c.prescribed[i].of[first + m];
    }
    for (Row entry(shape, static_cast<Eigen::Index>(i)); entry; ++entry) {
      const double* u = parameters[static_cast<std::size_t>(entry.col())].of[axis] + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        multiplier[m] -= entry.value() * u[m];
      }
    }
  }
  c.factor->solve(first, c.multiplier, c.scratch);
  for (std::size_t i = 0; i < c.multiplier.size(); ++i) {
    const double* multiplier = c.multiplier[i].of + first;
    for (Row entry(shape, static_cast<Eigen::Index>(i)); entry; ++entry) {
      const auto node = static_cast<std::size_t>(entry.col());
      double* u = parameters[node].of[axis] + first;
      for (std::size_t m = 0; m < members_at_once; ++m) {
        u[m] += inverse_mass_[node].of[first + m] * entry.value() * multiplier[m];
      }
    }
  }
}

void EachConditions::apply(double fraction, EachVectors& parameters) {
  fraction_ = {fraction_[1], fraction};
  for (Component& c : component_) {
    if (!c.multiplier_before.empty()) {
      std::swap(c.multiplier, c.multiplier_before);
    }
  }
  constexpr std::size_t parts = members / members_at_once;
  share_work(3 * parts, 1, [&](std::int64_t i) {
    const auto task = static_cast<std::size_t>(i);
    if (component_[task / parts].factor) {
      apply_to(task / parts, task % parts * members_at_once, fraction, parameters);
    }
  });
}

void EachConditions::let_go(std::size_t member) {
  for (Component& c : component_) {
    for (EachNumbers* values : {&c.prescribed, &c.multiplier, &c.multiplier_before}) {
      for (NumberOfEach<double>& value : *values) {
        value.of[member] = 0;
      }
    }
  }
}

Numbers EachConditions::multiplier_work() const {
  Numbers work = Numbers::Zero();
  for (const Component& c : component_) {
    for (std::size_t i = 0; i < c.multiplier.size(); ++i) {
      work += numbers(c.multiplier[i].of) * numbers(c.prescribed[i].of);
    }
  }
  return work;
}

Numbers EachConditions::spring_work(const EachVectors& before, const EachVectors& now) const {
  Numbers work = Numbers::Zero();
  for (std::size_t axis = 0; axis < 3 && fraction_[0] == fraction_[1]; ++axis) {
    const Component& c = component_[axis];
    for (std::size_t i = 0; i < c.multiplier_before.size(); ++i) {
      Numbers moved = Numbers::Zero();
      using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
      for (Row entry(of_all(axis).shape, static_cast<Eigen::Index>(i)); entry; ++entry) {
        const auto node = static_cast<std::size_t>(entry.col());
        moved += entry.value() * (numbers(now[node].of[axis]) - numbers(before[node].of[axis]));
      }
      work -= moved * (numbers(c.multiplier[i].of) - numbers(c.multiplier_before[i].of));
    }
  }
  return work;
}

}  // namespace brainshift::solve
