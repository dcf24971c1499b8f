// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/other_load.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "solve/body/ordered_cloud.hpp"
#include "solve/body/soft_nodes.hpp"
#include "solve/boundary/patch_rim.hpp"
#include "solve/device/kept_on_device.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/run/prepare.hpp"

namespace brainshift::solve {

namespace {

/// Surface nodes of the whole cloud that nothing prescribes.
std::vector<std::int32_t> free_nodes(const std::vector<std::uint8_t>& on_surface, const Points& prescribed) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < on_surface.size(); ++a) {
    if (on_surface[a] != 0 && !is_loaded(prescribed, static_cast<Eigen::Index>(a))) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

/// As a run from the beginning holds it. ordered: at the body's nodes.
void hold(const Conditions& ordered, KeptRun& run) {
  Body& body = run.fine.body;
  const NodeCloud given{.positions = body.positions, .spacing = body.spacing, .on_surface = run.on_surface};
  const NodeCloud cloud = subset(given, body.original);
  PatchRim rim = patch_rim(cloud, ordered.displacement, {});
  rim.rows = rows_at_rim({cloud.positions, cloud.spacing, run.options.shape, {}, body.node_modulus}, rim);
  if (ordered.measured) {
    ShapeRows inner;
    if (ordered.measured->inner.rows() > 0) {
      inner = inner_rows({cloud.positions, cloud.spacing, run.options.shape}, ordered.measured->inner);
    }
    body.essential = {ordered.displacement, body.nodal_rows, body.original, *ordered.measured, inner, rim};
  } else {
    body.essential = {ordered.displacement, body.nodal_rows, body.original, Imposition::exact, rim};
  }
}

/// The nodes that nothing prescribes may touch.
void free_to_touch(const Points& prescribed, KeptRun& run) {
  Body& body = run.fine.body;
  std::vector<std::int32_t> ordinal(body.original.size());
  for (std::size_t a = 0; a < ordinal.size(); ++a) {
    ordinal[static_cast<std::size_t>(body.original[a])] = static_cast<std::int32_t>(a);
  }
  std::vector<std::int32_t> nodes = free_nodes(run.on_surface, prescribed);
  for (std::int32_t& node : nodes) {
    node = ordinal[static_cast<std::size_t>(node)];
  }
  std::sort(nodes.begin(), nodes.end());
  const Points ordered = body.positions(body.original, Eigen::all);
  body.contact.emplace(std::shared_ptr(body.contact->skull()), ordered, nodes, body.nodal_rows);
}

/// Nodes of the surface, one a row, that are held in all directions.
std::vector<std::uint8_t> bonded_nodes(const std::vector<std::uint8_t>& on_surface, const Points& prescribed) {
  std::vector<std::uint8_t> bonded = on_surface;
  for (std::size_t a = 0; a < bonded.size(); ++a) {
    if (prescribed.row(static_cast<Eigen::Index>(a)).array().isNaN().any()) {
      bonded[a] = 0;
    }
  }
  return bonded;
}

bool same_bonded(const std::vector<std::uint8_t>& on_surface, const Points& a, const Points& b) {
  return bonded_nodes(on_surface, a) == bonded_nodes(on_surface, b);
}

bool hold_the_same(const Points& a, const Points& b) {
  return (a.array().isNaN() == b.array().isNaN()).all();
}

/// What the run was made from, under another load.
Model model_under(const Conditions& load, const KeptRun& run) {
  Model model = run.made_from();
  const Points& positions = run.fine.body.positions;
  if (model.cloud.positions.rows() != positions.rows() || model.cloud.positions != positions) {
    throw std::invalid_argument("it loads other nodes than the run did, and the run's cloud has changed since");
  }
  model.conditions.displacement = load.displacement;
  model.conditions.measured = load.measured;
  return model;
}

/// What was made of the body that `fine` had.
void forget_body(KeptRun& run) {
  run.ready = false;
  if (run.on_device) {
    run.on_device->forget_body();
  }
}

}  // namespace

void set_load(const Conditions& load, KeptRun& run) {
  Body& body = run.fine.body;
  const Conditions ordered = subset(load, body.original);
  if (run.ready && !ordered.measured && body.essential.prescribe(ordered.displacement)) {
    return;  // at the nodes of the last load: all else depends on these alone
  }
  run.ready = false;
  hold(ordered, run);
  body.essential.factorise(run.fine.settled.mass, relaxation_alpha);  // throws while the body is still here
  if (body.contact) {
    free_to_touch(load.displacement, run);
  }
  run.ready = true;
}

bool is_prepared_for(const Points& prescribed, const KeptRun& run) {
  return run.options.integration != Integration::consistent ||
         (run.prepared_for.rows() > 0 && same_bonded(run.on_surface, prescribed, run.prepared_for));
}

void prepare_for(const Conditions& load, KeptRun& run, const Progress& progress) {
  if (run.own && same_bonded(run.on_surface, load.displacement, run.origin.prescribed)) {
    run.fine.body = std::move(run.own->body);
    run.fine.settled = std::move(run.own->settled);
    run.own.reset();
    run.prepared_for = run.origin.prescribed;
    forget_body(run);
    return;
  }
  if (!run.made_from) {
    throw std::invalid_argument("it loads other nodes than the run did, and what the run was made from is not known");
  }
  const Model model = model_under(load, run);
  SolveMeasures measures;
  Body body = prepare(model, run.options, {}, measures, progress).body;
  if (!run.own) {
    run.own = KeptBody{std::move(run.fine.body), {}, run.fine.settled};
  }
  run.fine.body = std::move(body);
  run.prepared_for = Points(0, 3);
  forget_body(run);
}

void thin_for(const Conditions& load, KeptRun& run) {
  if (run.made_from && !hold_the_same(load.displacement, run.thinned_for.value_or(run.origin.prescribed))) {
    run.thinned = thinned_body(model_under(load, run), run.options.shape);
    run.thinned_for = load.displacement;
  }
}

}  // namespace brainshift::solve
