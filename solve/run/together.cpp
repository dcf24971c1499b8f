// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/together.hpp"

#include <omp.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "solve/arrays/shared_work.hpp"
#include "solve/body/forces.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/device/device_fault.hpp"
#include "solve/device/each/relax_together_if_asked.hpp"
#include "solve/ensemble/each.hpp"
#include "solve/ensemble/relax_together.hpp"
#include "solve/run/attempt.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/pressed_body.hpp"
#include "solve/run/whole_body.hpp"
#include "solve/shape/nodal_displacement.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::solve {

namespace {

using Displacements = std::vector<std::optional<Points>>;

/// Whether what acts on the body differs.
bool forces_differ(const Model& model, std::span<const Constants> constants) {
  return model.fluid || !model.gravity.isZero() ||
         std::any_of(constants.begin(), constants.end(),
                     [](const Constants& c) { return c.fluid || !c.gravity.isZero(); });
}

/// The members by their constants. model: what was prepared; its constants are used up.
std::vector<Member> members_of(Model& model, const Prepared& prepared, std::span<const Constants> constants) {
  std::vector<Member> loads;
  for (const Constants& c : constants) {
    model = with_constants(std::move(model), c);
    loads.push_back({.laws = laws_with(prepared.body, model.materials),
                     .external = prepared.parts ? external_force(model, *prepared.parts, Dynamics::relaxation)
                                                : prepared.body.external});
  }
  return loads;
}

/// relax_together() of any number of members.
std::vector<MemberResult> relax_all(const Body& body, std::span<const Member> loads, const LoadCurve& curve,
                                    const SolveOptions& options, const Progress& progress) {
  if (auto on_device = device::relax_together_if_asked(body, loads, curve, options, progress)) {
    return *std::move(on_device);
  }
  std::vector<MemberResult> results;
  for (std::size_t first = 0; first < loads.size(); first += members) {
    const std::span<const Member> some = loads.subspan(first, std::min(members, loads.size() - first));
    for (MemberResult& result : relax_together(body, some, curve, options, progress)) {
      results.push_back(std::move(result));
    }
  }
  return results;
}

/// Nothing that stepping has not seen is wrong with a member that has come to rest.
bool holds(const MemberResult& result, const Body& body) {
  return result.end == MemberResult::End::rest && !(body.contact && body.contact->measure(result.parameters).lost);
}

/// Whether tissue creases there: attempt() then takes the way from rest.
bool is_creased(const MemberResult& result, const Body& body, const PointLaws& laws) {
  ForceScratch scratch(body.points, laws);
  scratch.swell(laws, 1);
  NodalVectors force(result.parameters.size());
  internal_force(body.points, laws, result.parameters, scratch, force);
  return point_state(body.points, laws, scratch).compressed_share >= much_compressed;
}

/// What together(options, constants) finds of those constants that single precision serves, and of those that want
/// double.
template <class Together>
Displacements by_precision(const Model& model, const SolveOptions& options, std::span<const Constants> constants,
                           const Together& together) {
  Displacements displacements(constants.size());
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    std::vector<std::size_t> places;
    std::vector<Constants> some;
    Model with = model;
    for (std::size_t m = 0; m < constants.size(); ++m) {
      with = with_constants(std::move(with), constants[m]);
      if (completed(options, with).precision == precision) {
        places.push_back(m);
        some.push_back(constants[m]);
      }
    }
    SolveOptions in_precision = options;
    in_precision.precision = precision;
    Displacements found = some.empty() ? Displacements() : together(in_precision, some);
    for (std::size_t i = 0; i < places.size(); ++i) {
      displacements[places[i]] = std::move(found[i]);
    }
  }
  return displacements;
}

/// While it lives, OpenMP's loops of the thread, as Eigen's are, are the thread's own: others do other members.
class OnThisThread {
 public:
  OnThisThread() { omp_set_num_threads(1); }
  OnThisThread(const OnThisThread&) = delete;
  OnThisThread& operator=(const OnThisThread&) = delete;
  ~OnThisThread() { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

Displacements alone(const Model& model, std::span<const Constants> constants,
                    const std::function<std::optional<Points>(const Model&)>& solve) {
  Displacements displacements;
  for (const Constants& c : constants) {
    displacements.push_back(solve(with_constants(model, c)));
  }
  return displacements;
}

std::optional<Points> whole_displacement(const Model& model, const SolveOptions& options, const Progress& progress) {
  SolveResult result = solve_whole_body(model, options, progress);
  return result.failure.empty() ? std::optional(std::move(result.solution.displacement)) : std::nullopt;
}

Displacements coarse_together(const Model& model, const SolveOptions& options, std::span<const Constants> constants,
                              const Progress& progress) {
  const auto one = [&](const Model& with) { return coarse_displacement(with, options, {}); };
  const std::vector<std::int32_t> nodes = coarse_nodes(model.cloud, model.conditions);
  if (nodes.size() < fewest_coarse_nodes) {
    return alone(model, constants, one);
  }
  try {
    CoarseBody coarse = coarse_body(nodes, model, options, progress, forces_differ(model, constants));
    const Body& body = coarse.prepared.body;
    const std::vector<Member> loads = members_of(coarse.model, coarse.prepared, constants);
    if (!may_go_together(body, loads, coarse.options)) {
      return alone(model, constants, one);
    }
    const std::vector<MemberResult> results = relax_all(body, loads, model.curve, coarse.options, progress);
    const ShapeFunctions shape(coarse.model.cloud.positions, coarse.model.cloud.spacing, coarse.options.shape);
    const FromCoarse at_all(shape, coarse.model.cloud, model);
    Displacements displacements(constants.size());
    share_work(std::ssize(results), 1, [&](std::int64_t i) {
      const OnThisThread own;
      const auto m = static_cast<std::size_t>(i);
      if (holds(results[m], body)) {
        displacements[m] = at_all(nodal_displacement(body.nodal_rows, results[m].parameters, body.original));
      }
    });
    for (std::size_t m = 0; m < results.size(); ++m) {
      if (results[m].end == MemberResult::End::left) {
        displacements[m] = one(with_constants(model, constants[m]));
      }
    }
    return displacements;
  } catch (const device::DeviceFault&) {
    throw;  // nothing of the coarse cloud, nor is the following
  } catch (const device::NotOnDevice&) {
    throw;
  } catch (const std::logic_error&) {
    return alone(model, constants, one);  // which says of each that it cannot be solved
  } catch (const std::runtime_error&) {
    return alone(model, constants, one);
  }
}

Displacements whole_together(const Model& model, const SolveOptions& given, std::span<const Constants> constants,
                             const Progress& progress) {
  const SolveOptions options = completed(given, model);
  const auto one = [&](const Model& with) { return whole_displacement(with, given, progress); };
  const bool parts = !model.cuts.empty() || model.rupture;
  if (parts || is_confined(model)) {
    return alone(model, constants, one);
  }
  Displacements starts(constants.size());
  if (starts_coarse(model, options)) {
    starts = coarse_together(model, of_coarse_start(options), constants, progress);
  }
  SolveMeasures measures;
  const Prepared prepared = prepare(model, options, {}, measures, progress, forces_differ(model, constants));
  Model with = model;
  std::vector<Member> loads = members_of(with, prepared, constants);
  if (!may_go_together(prepared.body, loads, options) || too_thin_for_quadratic(options, measures)) {
    return alone(model, constants, one);
  }
  std::vector<std::size_t> from_start, from_rest;
  for (std::size_t m = 0; m < loads.size(); ++m) {
    (starts[m] ? from_start : from_rest).push_back(m);
    if (starts[m]) {
      loads[m].start = in_body_order(*starts[m], prepared.body.original);
    }
  }
  Displacements displacements(constants.size());
  for (const std::vector<std::size_t>& some : {from_start, from_rest}) {
    std::vector<Member> chosen;
    for (const std::size_t m : some) {
      chosen.push_back(std::move(loads[m]));
    }
    const std::vector<MemberResult> results = relax_all(prepared.body, chosen, model.curve, options, progress);
    for (std::size_t i = 0; i < some.size(); ++i) {
      const bool held = holds(results[i], prepared.body);
      const bool creased = held && !chosen[i].start.empty() && is_creased(results[i], prepared.body, chosen[i].laws);
      if (held && !creased) {
        displacements[some[i]] =
            nodal_displacement(prepared.body.nodal_rows, results[i].parameters, prepared.body.original);
      } else if (creased || results[i].end == MemberResult::End::left) {
        displacements[some[i]] = one(with_constants(model, constants[some[i]]));
      }
    }
  }
  return displacements;
}

}  // namespace

Displacements coarse_displacements(const Model& model, const SolveOptions& options,
                                   std::span<const Constants> constants, const Progress& progress) {
  return by_precision(model, options, constants, [&](const SolveOptions& with, std::span<const Constants> some) {
    return coarse_together(model, with, some, progress);
  });
}

Displacements whole_displacements(const Model& model, const SolveOptions& options, std::span<const Constants> constants,
                                  const Progress& progress) {
  return by_precision(model, options, constants, [&](const SolveOptions& with, std::span<const Constants> some) {
    return whole_together(model, with, some, progress);
  });
}

}  // namespace brainshift::solve
