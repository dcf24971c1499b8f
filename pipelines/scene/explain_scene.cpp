// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/explain_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "pipelines/scene/run_size.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "pipelines/scene/stage_memory.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "solve/shape/node_supports.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::pipelines {
namespace {

std::string round_number(double value) {
  const double digits = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 1));
  return write_number(static_cast<long>(std::round(value / digits) * digits));
}

std::string stage_work(StageId stage, const RunSize& size) {
  switch (stage) {
    case StageId::segment:
    case StageId::registration:
      return round_number(size.voxels) + " voxels";
    case StageId::discretise:
      return round_number(size.solve.nodes) + " nodes";
    case StageId::solve:
      return round_number(size.solve.points) + " integration points, " + round_number(size.solve.pairs) + " pairs";
    case StageId::report:
      return "pictures";
  }
  return {};
}

std::string stage_cost(StageId stage, const Scene& scene, const RunSize& size) {
  const std::optional<double> memory = stage_memory(stage, scene, size);
  return stage_work(stage, size) + (memory ? ", about " + write_number(static_cast<long>(std::ceil(*memory))) + " MB"
                                           : ", and more of both, and memory, for adaptive integration");
}

/// Why a part is there: the line that names it.
std::string reason(const Scene& scene, const std::string& path) {
  if (path.empty()) {
    return "always there";
  }
  return scene.source.lines.contains(path) ? "named in " + place(scene.source, path) : "the default";
}

void explain_parts(const Scene& scene, std::ostringstream& text) {
  for (const Element& element : scene_elements()) {
    if (element.optional && element.path != "load") {
      const bool active = element.present(scene);
      text << "  " << element.path << ": " << (active ? "active, " + reason(scene, element.path) : "not built") << "\n";
    }
  }
}

void explain_material(const Tissue& tissue, bool in_time, std::ostringstream& text) {
  const solve::Material& material = tissue.material;
  text << "  tissue " << tissue.label << (tissue.name.empty() ? "" : " (" + tissue.name + ")") << ": "
       << find_option(tissue_options(), "law")->get(tissue);
  if (material.law == solve::Law::ogden) {
    text << ", mu, alpha " << find_option(tissue_options(), "ogden")->get(tissue);
  } else {
    text << ", E " << write_number(material.youngs_modulus) << " Pa";
  }
  text << ", nu " << write_number(material.poisson_ratio);
  if (material.swelling != 0) {
    text << ", grows by " << 100 * material.swelling << " % of its volume";
  }
  if (!material.prony.empty()) {
    text << ", relaxes to mu " << solve::shear_modulus(solve::long_term(material)) << " Pa"
         << (in_time ? "" : ", with which the steady state is found");
  }
  text << "\n";
}

void explain_cuts(const Scene& scene, std::ostringstream& text) {
  for (const CutFile& cut : scene.cuts->files) {
    const auto said = [&](const char* name) { return find_option(cut_options(), name)->get(cut); };
    text << "  cut " << cut.file.string() << ": ";
    if (!cut.timing.start && !cut.timing.speed) {
      text << "from the start, or as its file says\n";
      continue;
    }
    text << (cut.timing.speed ? "from time " : "at time ") << write_number(cut.timing.start.value_or(0))
         << (cut.timing.speed ? " on, " + said("speed") + " mm in a unit of it along " + said("direction") : "")
         << "\n";
  }
  text << "  faces of cuts: " << (scene.cuts->contact ? "in contact" : "may pass through each other") << "\n";
}

std::string explained_gravity(const Scene& scene) {
  const auto said = [&](const char* element, const char* name) {
    return find_option(find_element(element)->options, name)->get(scene);
  };
  if (!scene.gravity) {
    return scene.loading.gravity.isZero() ? "not active" : said("solve", "gravity") + " m/s2, the whole weight";
  }
  std::string text =
      "along " + said("gravity", "direction") + ", fluid of " + said("gravity", "fluid_density") + " kg/m3 ";
  if (scene.gravity->drained) {
    return text + "drained by " + said("gravity", "drained") + " % of the brain's height";
  }
  return text + "down to " +
         (scene.gravity->fluid_point ? "the point " + said("gravity", "fluid_point")
                                     : said("gravity", "fluid_level") + " mm along it");
}

void explain_physics(const Scene& scene, std::ostringstream& text) {
  const auto said = [&](const char* name) { return find_option(find_element("solve")->options, name)->get(scene); };
  const bool in_time = scene.solve.dynamics == solve::Dynamics::transient;
  for (const Tissue& tissue : scene.tissues) {
    explain_material(tissue, in_time, text);
  }
  text << "  shape functions: " << said("basis") << ", " << said("derivatives") << " derivatives, dilatation "
       << solve::dilatation(scene.solve.shape) << "\n  volumetric: " << said("volumetric");
  if (scene.solve.volumetric == solve::Volumetric::mean_dilatation) {
    text << ", " << said("nodes_per_patch") << " nodes a patch";
  }
  text << "\n  integration: " << said("integration");
  if (scene.solve.integration_tolerance > 0) {
    text << ", adaptive to " << said("integration_tolerance") << ", cells split " << said("integration_depth")
         << " times at most";
  }
  text << "\n  imposition: " << said("imposition") << "\n  dynamics: " << said("dynamics");
  if (in_time) {
    text << " over " << load_curve(scene.loading).duration() << " s, time step "
         << (scene.solve.time_step > 0 ? said("time_step") + " s" : "automatic") << ", damping " << said("damping")
         << " 1/s";
  } else {
    text << " to " << said("tolerance") << " mm";
  }
  text << "\n  load's curve: "
       << (scene.loading.curve.empty() ? "3-4-5" : said("curve") + ", joined " + said("curve_join"))
       << "\n  gravity: " << explained_gravity(scene) << "\n";
  if (scene.cuts) {
    explain_cuts(scene, text);
  }
  if (scene.resection) {
    text << "  resection: labels " << write_numbers(scene.resection->labels) << ", pressure in the cavity "
         << write_number(scene.resection->pressure) << " Pa, its wall "
         << (is_ours(scene, StageId::discretise) ? "a surface\n" : "where labels of integration points change\n");
  }
}

/// The active parts of the solve stage, what each asks for of its memory and of the time of its steps.
void explain_shares(const Scene& scene, const SolveSize& size, std::ostringstream& text) {
  const std::vector<PartCost> parts = solve_costs(scene, size);
  double bytes = 0, time = 0;
  for (const PartCost& part : parts) {
    bytes += part.bytes;
    time += part.nanoseconds;
  }
  text << "solve, estimated shares of memory and time while it steps\n" << std::fixed << std::setprecision(1);
  for (const PartCost& part : parts) {
    text << "  " << part.part << ": " << 100 * part.bytes / bytes << " % of memory, " << 100 * part.nanoseconds / time
         << " % of time; " << reason(scene, part.named) << "\n";
  }
}

}  // namespace

std::string explain_scene(const Scene& scene) {
  const RunSize size = run_size(scene);
  std::ostringstream text;
  text << "parts\n";
  explain_parts(scene, text);
  if (is_ours(scene, StageId::solve)) {
    text << "physics\n";
    explain_physics(scene, text);
  }
  text << "stages (estimates for a brain of " << round_number(size.solve.volume / 1000) << " ml)\n";
  for (const StageId stage : all_stages) {
    const std::string& command = scene.commands[index_of(stage)];
    text << "  " << stage_name(stage) << ": ";
    if (!command.empty()) {
      text << "external command: " << command << "\n";
    } else if (!is_active(stage, scene)) {
      text << "not built (no t1 and no labels)\n";
    } else {
      text << stage_cost(stage, scene, size) << "\n";
    }
  }
  if (is_ours(scene, StageId::solve)) {
    explain_shares(scene, size.solve, text);
  }
  return text.str();
}

}  // namespace brainshift::pipelines
