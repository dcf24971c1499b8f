// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_motion.hpp"

#include <algorithm>
#include <utility>

#include "solve/arrays/lanes.hpp"
#include "solve/arrays/shared_work.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/soundness.hpp"

namespace brainshift::solve {

namespace {

std::vector<PointLaws> laws_of(std::span<const Member> loads) {
  std::vector<PointLaws> laws;
  for (const Member& load : loads) {
    laws.push_back(load.laws);
  }
  return laws;
}

std::vector<Points> prescribed_of(std::span<const Member> loads) {
  std::vector<Points> prescribed;
  for (const Member& load : loads) {
    prescribed.push_back(load.prescribed);
  }
  return prescribed;
}

EachVectors external_of(const Body& body, std::span<const Member> loads) {
  EachVectors external;
  for (std::size_t m = 0; m < loads.size(); ++m) {
    if (!loads[m].external.empty()) {
      external.resize(body.nodes(), {});
      set_member(loads[m].external.full(), m, external);
    }
  }
  return external;
}

/// û⁺ = û + β(û − û⁻) − α M⁻¹ (f − fraction f_ext), of the nodes [first, last); f ← f − fraction f_ext.
BRAINSHIFT_CLONES
void move_nodes(std::size_t first, std::size_t last, const VectorOfEach<double>* now,
                const VectorOfEach<double>* before, const VectorOfEach<double>* external, double fraction,
                const NumberOfEach<double>* mass, const NumberOfEach<double>& beta, VectorOfEach<double>* force,
                VectorOfEach<double>* next) {
  for (std::size_t a = first; a < last; ++a) {
    double push[members];
    for (std::size_t m = 0; m < members; ++m) {
      push[m] = relaxation_alpha / mass[a].of[m];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double* f = force[a].of[axis];
      if (external != nullptr) {
        for (std::size_t m = 0; m < members; ++m) {
          f[m] -= fraction * external[a].of[axis][m];
        }
      }
      const double *x = now[a].of[axis], *y = before[a].of[axis];
      for (std::size_t m = 0; m < members; ++m) {
        next[a].of[axis][m] = x[m] + beta.of[m] * (x[m] - y[m]) - push[m] * f[m];
      }
    }
  }
}

}  // namespace

EachMotion::EachMotion(const Body& body, std::span<const Member> loads)
    : force_law(body.points, laws_of(loads)),
      now(body.nodes(), VectorOfEach<double>{}),
      before(now),
      next(now),
      force(now),
      force_before(now),
      essential_(body.essential, prescribed_of(loads)),
      external_(external_of(body, loads)),
      rounding_energy_(Numbers::Zero()) {
  if (body.contact) {
    contact_.emplace(*body.contact);
  }
  for (std::size_t m = loads.size(); m < members; ++m) {
    let_go(m);
  }
  const std::vector<double> volume = volumes_of_materials(body);
  for (std::size_t m = 0; m < loads.size(); ++m) {
    rounding_energy_[static_cast<Eigen::Index>(m)] = rounding_energy(volume, loads[m].laws);
  }
}

void EachMotion::weigh(const EachNumbers& mass, const Chosen& chosen) {
  essential_.factorise(mass, relaxation_alpha, chosen);
  if (contact_) {
    contact_->weigh(mass, chosen);
  }
}

void EachMotion::start_from(std::span<const Member> loads) {
  for (std::size_t m = 0; m < loads.size(); ++m) {
    set_member(loads[m].start, m, now);
  }
  fraction_ = fraction_before_ = 1;
  time = 1;
  essential_.apply(fraction_, now);
  before = next = now;
  find_force();
  external_work_ = force_law.strain_energy();
}

/// Of the forces over the step at hand, at a share of the load.
Numbers EachMotion::force_work(double share) const {
  if (external_.empty()) {
    return Numbers::Zero();
  }
  return share * sum_of_each(now.size(), [&](std::size_t a) { return dot(external_[a], difference(next[a], now[a])); });
}

void EachMotion::step(const EachNumbers& mass, const NumberOfEach<double>& beta, double end, double fraction,
                      const Chosen& active) {
  find_force();
  constexpr std::size_t chunks = 64;
  const VectorOfEach<double>* external = external_.empty() ? nullptr : external_.data();
  share_work(chunks, 1, [&](std::int64_t i) {
    const auto c = static_cast<std::size_t>(i);
    move_nodes(c * now.size() / chunks, (c + 1) * now.size() / chunks, now.data(), before.data(), external, fraction_,
               mass.data(), beta, force.data(), next.data());
  });
  if (contact_) {
    contact_->apply(active, next);
  }
  essential_.apply(fraction, next);
  const Numbers rate = essential_.multiplier_work() / relaxation_alpha;
  external_work_ += (fraction_ - fraction_before_) * (rate + work_rate_) / 2 + force_work_;
  work_rate_ = rate;
  force_work_ = force_work((fraction_ + fraction) / 2);
  fraction_before_ = fraction_;
  fraction_ = fraction;
  std::swap(before, now);
  std::swap(now, next);
  beta_ = beta;
  time = end;
  ++steps;
}

Numbers EachMotion::farthest() const {
  Numbers largest = Numbers::Zero();
  for (const VectorOfEach<double>& node : now) {
    for (const auto& component : node.of) {
      largest = -lesser_of_each(-largest, -numbers(component).abs());
    }
  }
  return largest;
}

Numbers EachMotion::eigenvalue_since(const EachVectors& place, const EachVectors& force_there,
                                     const EachNumbers& mass) const {
  const Numbers stiffness = sum_of_each(now.size(), [&](std::size_t a) {
    return dot(difference(before[a], place[a]), difference(force[a], force_there[a]));
  });
  const Numbers weight = inertia(mass, before, place);
  return (weight > 0).select(stiffness / weight, 0.0);
}

Numbers EachMotion::spring_stiffness(const EachNumbers& mass) const {
  const Numbers springs = essential_.spring_work(before, now) / relaxation_alpha;
  return (springs > 0).any() ? Numbers((springs > 0).select(springs / inertia(mass, now, before), 0.0))
                             : Numbers(Numbers::Zero());
}

Numbers EachMotion::inertia(const EachNumbers& mass, const EachVectors& x, const EachVectors& y) const {
  return sum_of_each(now.size(), [&](std::size_t a) -> Numbers {
    const VectorOfEach<double> moved = difference(x[a], y[a]);
    return numbers(mass[a].of) * dot(moved, moved);
  });
}

Numbers EachMotion::motion_over_work(const EachNumbers& mass) {
  const Numbers doubled = inertia(mass, now, next);
  const Numbers kinetic = doubled * (1 + numbers(beta_.of)) / (16 * relaxation_alpha);
  largest_work_ = largest_work_.max(external_work_.abs());
  return kinetic / (most_motion * largest_work_.max(rounding_energy_));
}

void EachMotion::let_go(std::size_t member) {
  essential_.let_go(member);
  for (EachVectors* v : {&now, &before, &next, &external_}) {
    for (VectorOfEach<double>& of_node : *v) {
      for (auto& axis : of_node.of) {
        axis[member] = 0;
      }
    }
  }
}

}  // namespace brainshift::solve
