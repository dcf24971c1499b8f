// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/relax_together.hpp"

#include <algorithm>
#include <array>

#include "solve/dynamics/load_pace.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/dynamics/soundness.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/dynamics/stiffening.hpp"
#include "solve/ensemble/each_conditions.hpp"
#include "solve/ensemble/each_contact.hpp"
#include "solve/ensemble/each_displacement.hpp"
#include "solve/ensemble/each_eigenvalue.hpp"
#include "solve/ensemble/each_force.hpp"
#include "solve/ensemble/each_motion.hpp"
#include "solve/ensemble/way.hpp"

namespace brainshift::solve {

namespace {

class Ensemble {
 public:
  Ensemble(const Body& body, std::span<const Member> loads, const LoadCurve& curve, const SolveOptions& options,
           bool patient, BoundOf bound)
      : body_(body),
        curve_(curve),
        options_(options),
        patient_(patient),
        bound_(bound),
        motion_(body, loads),
        pace_(steps_of_load(options.load_steps, loads.front().laws), false),
        results_(loads.size()) {
    std::fill_n(active_.begin(), loads.size(), true);
    motion_.find_force();
    mass_ = motion_.force_law.stiffness_bound(all_chosen());
    const Numbers tightness = bound_tightness_of_each(motion_.force_law, mass_);
    for (std::size_t m = 0; m < members; ++m) {
      way_[m].bound = ErrorBound(usual_window, margin_of(bound));
      way_[m].started = !loads.front().start.empty();
      way_[m].mass_scale = tightness[static_cast<Eigen::Index>(m)];
    }
    for (NumberOfEach<double>& of_node : mass_) {
      for (std::size_t m = 0; m < members; ++m) {
        of_node.of[m] *= mass_margin * way_[m].mass_scale;
      }
    }
    motion_.weigh(mass_, all_chosen());
    if (!loads.front().start.empty()) {
      motion_.start_from(loads);
      pace_.skip();
      follow_stiffness(active_);
      return;
    }
    const int steps = steps_of_load(options.load_steps, loads.front().laws);  // one pace is for all
    for (std::size_t m = 0; m < loads.size(); ++m) {
      if (steps_of_load(options.load_steps, loads[m].laws) != steps) {
        end(m, MemberResult::End::left);
      }
    }
  }

  std::vector<MemberResult> run(const Progress& progress) {
    while (any_active() && motion_.steps < options_.max_steps) {
      step();
      if (motion_.steps % usual_window == 0) {
        look();
        report(progress, 0.5 * motion_.time, "step " + std::to_string(motion_.steps) + " of an ensemble");
      }
    }
    for (std::size_t m = 0; m < results_.size(); ++m) {
      if (active_[m]) {
        end(m, MemberResult::End::not_converged);
      }
    }
    return std::move(results_);
  }

 private:
  static Chosen all_chosen() {
    Chosen all;
    all.fill(true);
    return all;
  }
  bool any_active() const { return std::find(active_.begin(), active_.end(), true) != active_.end(); }

  void step() {
    if (motion_.steps % usual_window == usual_window - 1) {
      std::swap(motion_.force, motion_.force_before);
    }
    const double time = pace_.go_on(false);
    NumberOfEach<double> beta;
    for (std::size_t m = 0; m < members; ++m) {
      beta.of[m] = way_[m].beta();
    }
    motion_.step(mass_, beta, time, curve_.at(time * curve_.duration()), active_);
    Chosen squeezed = {};
    const Numbers smallest = motion_.force_law.smallest_jacobian();
    for (std::size_t m = 0; m < members; ++m) {
      const double jacobian = smallest[static_cast<Eigen::Index>(m)];
      if (active_[m] && !(jacobian >= squeezed_share * way_[m].squeezed_to)) {
        way_[m].squeezed_to = jacobian;
        squeezed[m] = true;
      }
    }
    follow_stiffness(squeezed);
  }

  /// Once a window: as Relaxation does it.
  void look() {
    const EachVectors at_nodes = seen_of(motion_.now);
    const Numbers moved = longest_difference_of_each(at_nodes, seen_of(motion_.before));
    const Numbers smallest = motion_.force_law.smallest_jacobian();
    const Numbers farthest = motion_.farthest(), lowest = lowest_eigenvalue(moved, farthest);
    const Numbers too_lively = motion_.motion_over_work(mass_);
    const int windows = motion_.steps / usual_window;
    for (std::size_t m = 0; m < members; ++m) {
      const auto i = static_cast<Eigen::Index>(m);
      if (!active_[m]) {
        continue;
      }
      const SeenOfMember seen{.moved = moved[i],
                              .farthest = farthest[i],
                              .smallest_jacobian = smallest[i],
                              .lowest = lowest[i],
                              .motion_over_work = too_lively[i]};
      if (way_[m].look(seen, motion_.time >= 1, body_.points.precision())) {
        spans_[m].add(member_of(at_nodes, m));
      } else {
        end(m, MemberResult::End::left);
      }
    }
    if (windows % windows_to_stiffness(motion_.time >= 1) == 0) {
      follow_stiffness(active_);
    }
    for (std::size_t m = 0; m < members; ++m) {
      if (!active_[m]) {
        continue;
      }
      const bool loaded = motion_.time >= 1;
      if (const auto how = way_[m].end(options_.tolerance, loaded, patient_, body_.points.precision(), spans_[m])) {
        end(m, *how);
      }
    }
  }

  EachVectors seen_of(const EachVectors& parameters) const {
    return bound_ == BoundOf::parameters ? parameters : displacement_of_each(body_.nodal_rows, parameters);
  }

  /// A_0 of each member as Relaxation estimates it; not above 0: the increments do not tell.
  Numbers lowest_eigenvalue(const Numbers& moved, const Numbers& farthest) {
    Numbers lowest = motion_.eigenvalue_since(motion_.next, motion_.force_before, mass_);
    Chosen rounded = {};
    for (std::size_t m = 0; m < members && !place_at_look_.empty(); ++m) {
      const auto i = static_cast<Eigen::Index>(m);
      const double most = way_[m].farthest_with(farthest[i]);
      rounded[m] = active_[m] && feels_rounding(moved[i], most, body_.points.precision());
    }
    if (std::find(rounded.begin(), rounded.end(), true) != rounded.end()) {
      const Numbers of_window = motion_.eigenvalue_since(place_at_look_, force_at_look_, mass_);
      for (std::size_t m = 0; m < members; ++m) {
        const auto i = static_cast<Eigen::Index>(m);
        lowest[i] = rounded[m] ? std::min(lowest[i], of_window[i]) : lowest[i];
      }
    }
    if (motion_.time >= 1) {
      place_at_look_ = motion_.before;
      force_at_look_ = motion_.force;
    }
    return (lowest > 0).select(lowest + motion_.spring_stiffness(mass_), 0.0);
  }

  void end(std::size_t m, MemberResult::End how) {
    results_[m] = {.end = how,
                   .parameters = how == MemberResult::End::rest ? member_of(motion_.now, m) : NodalVectors(),
                   .error_bound = way_[m].bound.with_spans(spans_[m].value()),
                   .steps = motion_.steps};
    active_[m] = false;
    motion_.let_go(m);
  }

  /// Makes the masses of those members anew of which a node has become stiffer than they allow for.
  void follow_stiffness(const Chosen& asked) {
    if (std::find(asked.begin(), asked.end(), true) == asked.end()) {
      return;
    }
    const EachNumbers bound = motion_.force_law.stiffness_bound(asked);
    Chosen stiffer = {}, too_stiff = {};
    for (std::size_t a = 0; a < mass_.size(); ++a) {
      for (std::size_t m = 0; m < members; ++m) {
        const double times = way_[m].mass_scale * bound[a].of[m] / mass_[a].of[m];
        stiffer[m] = stiffer[m] || (asked[m] && times > 1);
        too_stiff[m] = too_stiff[m] || (asked[m] && stiffens_too_much(times));
      }
    }
    for (std::size_t m = 0; m < members; ++m) {
      if (too_stiff[m]) {
        stiffer[m] = false;
        end(m, MemberResult::End::left);
      }
    }
    if (std::find(stiffer.begin(), stiffer.end(), true) == stiffer.end()) {
      return;
    }
    for (std::size_t a = 0; a < mass_.size(); ++a) {
      for (std::size_t m = 0; m < members; ++m) {
        if (stiffer[m]) {
          mass_[a].of[m] = std::max(mass_[a].of[m], mass_margin * way_[m].mass_scale * bound[a].of[m]);
        }
      }
    }
    motion_.weigh(mass_, stiffer);
  }

  const Body& body_;
  const LoadCurve& curve_;
  const SolveOptions& options_;
  bool patient_;
  BoundOf bound_;
  EachMotion motion_;
  EachNumbers mass_;
  EachVectors place_at_look_, force_at_look_;  // `before` and its force of the last look under the whole load
  std::array<Way, members> way_;
  std::vector<SpanBound> spans_ = std::vector(members, SpanBound(usual_window));
  LoadPace pace_;
  Chosen active_ = {};
  std::vector<MemberResult> results_;
};

}  // namespace

bool may_go_together(const Body& body, std::span<const Member> loads, const SolveOptions& options) {
  const auto has_plain_laws = [](const Member& member) {
    const PointLaws& laws = member.laws;
    return laws.swelling.empty() && laws.prony.empty() && !laws.plane_stress && !laws.in_time;
  };
  return options.dynamics == Dynamics::relaxation && options.imposition == Imposition::exact && options.region == 0 &&
         options.snapshot_every == 0 && body.stiff_parts.empty() && body.cut.empty() && !body.face_contact &&
         !body.wall_contact && !body.septum_contact && std::all_of(loads.begin(), loads.end(), has_plain_laws);
}

std::vector<MemberResult> relax_together(const Body& body, std::span<const Member> loads, const LoadCurve& curve,
                                         const SolveOptions& options, const Progress& progress, bool patient,
                                         BoundOf bound) {
  return Ensemble(body, loads, curve, options, patient, bound).run(progress);
}

}  // namespace brainshift::solve
