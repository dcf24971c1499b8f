// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include <algorithm>
#include <iomanip>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include "pipelines/runner/impose.hpp"
#include "pipelines/runner/job_files.hpp"
#include "pipelines/runner/load_warnings.hpp"
#include "pipelines/runner/patient_registration.hpp"
#include "pipelines/scene/field_load.hpp"
#include "segmentation/files/naming.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/collinear.hpp"
#include "segmentation/options/values.hpp"
#include "solve/cut/septum.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/outliers.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

std::string load_files(const Load& load) {
  if (load.craniotomy) {
    return load.craniotomy->string();
  }
  const std::optional<BeforeAfter>& files = load.markups ? load.markups : load.surfaces;
  return files ? files->before.string() + " and " + files->after.string() : "";
}

/// The forces that the nodes' file has stay.
void impose(const solve::CraniotomyLoad& load, const Load& how, solve::Model& model) {
  Points force = std::move(model.conditions.force);
  model.conditions = imposed(load, how, model.cloud);
  model.conditions.force = std::move(force);
}

/// Measured at the nodes themselves, of which some have no displacement.
solve::CraniotomyLoad at_known_nodes(const Points& positions, const Points& displacement) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index a = 0; a < displacement.rows(); ++a) {
    if (displacement.row(a).allFinite()) {
      rows.push_back(a);
    }
  }
  return {positions(rows, Eigen::all), displacement(rows, Eigen::all)};
}

void impose_field(const Load& how, SolveInput& input) {
  solve::Conditions& conditions = input.model.conditions;
  FieldOnSurface found = field_on_surface_nodes(*how.field, how.opening, input.model.cloud);
  input.load = at_known_nodes(input.model.cloud.positions, found.displacement);
  std::ranges::copy(frame_warnings({how.field->file}), std::back_inserter(input.notes));
  constexpr double nearly_all = 0.9;
  if (static_cast<double>(found.known + found.not_found) < nearly_all * static_cast<double>(found.asked)) {
    input.notes.push_back("warning: " + how.field->file.string() + " says something of " +
                          std::to_string(found.known + found.not_found) + " of " + std::to_string(found.asked) +
                          " nodes of the brain's surface: the others lie outside its grid or where it is NaN, and are "
                          "left free; is it in the image's frame? If it is of a part of the brain, name the opening "
                          "that it tells of (where)");
  }
  if (found.not_found > 0) {
    input.notes.push_back("warning: " + how.field->file.string() + " takes no place to " +
                          std::to_string(found.not_found) + " of " + std::to_string(found.known + found.not_found) +
                          " nodes of the brain's surface: it folds there, or ends; they are left free");
  }
  warn(warnings_of_held(how.field->file, found.displacement), input.notes);
  if (!how.noise) {
    conditions.displacement = std::move(found.displacement);
    return;
  }
  input.load->sigma = Points::Constant(input.load->positions.rows(), 3, *how.noise);
  Points force = std::move(conditions.force);
  conditions = solve::noisy_field(input.model.cloud, found.displacement, *how.noise);
  conditions.measured->weight = how.weight;
  conditions.force = std::move(force);
}

/// What is taken of the load. Where that is asked for, points that contradict those with which the solve joins them
/// hardly count; else a note names the worst, which the mean would hide.
solve::CraniotomyLoad looked_through(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const Load& how,
                                     std::vector<std::string>& notes) {
  solve::CraniotomyLoad taken = load;
  if (load.sigma.rows() > 0) {
    const std::vector<Eigen::Index> inner = solve::inner_points(cloud, load);
    warn(how.robust ? warnings_of(solve::lessen_joined(taken, inner))
                    : warnings_of(solve::worst_of_joined(taken, inner),
                                  !how.registration_unknown && std::ssize(inner) < load.positions.rows()),
         notes);
  }
  return taken;
}

void need_noise(const solve::CraniotomyLoad& load) {
  if (load.sigma.rows() == 0) {
    throw std::invalid_argument(
        "an unknown registration needs to know how well the points were measured; give <load> a noise, or the file a "
        "column sigma");
  }
  if (are_in_line(load.positions)) {
    throw std::invalid_argument("an unknown registration needs three measured points that are not in line, found " +
                                std::to_string(load.positions.rows()) +
                                (load.positions.rows() < 3 ? "" : ", all nearly in one line"));
  }
}

void read_cuts(const SolveJob& job, solve::Model& model) {
  model.cuts = job.cut_paths;
  if (job.cuts) {
    model.face_contact = job.cuts->contact;
    for (const CutFile& cut : job.cuts->files) {
      model.cuts.push_back(read_cut(cut, job.plane));
    }
  }
}

/// A centre that was meant for another frame lies as far off as that.
void note_far_centre(const Load& load, const Points& opening, std::vector<std::string>& notes) {
  if (!load.simulated) {
    return;
  }
  Eigen::Index nearest = 0;
  const double far = (opening.rowwise() - load.simulated->centre.transpose()).rowwise().norm().minCoeff(&nearest);
  if (far > load.opening.farthest) {
    std::ostringstream text;
    text << std::setprecision(3) << "warning: the simulated opening's centre lies " << far
         << " mm off the brain's surface, so the opening is about " << opening.row(nearest)
         << "; give a centre on the cortex, in mm of the image (LPS)";
    notes.push_back(text.str());
  }
}

/// The load's displacements take the place of those that the nodes' file prescribes.
void note_replaced(const SolveJob& job, const solve::Conditions& own, std::vector<std::string>& notes) {
  if (const std::size_t nodes = solve::prescribed_nodes(own).size(); job.load && nodes > 0) {
    notes.push_back("warning: " + job.nodes.string() + " prescribes displacements of " + std::to_string(nodes) +
                    " nodes, which do not act, as there is a load; leave the one or the other out");
  }
}

/// Of cells that the body's surface cuts: without it, where the body ends between their corners.
void note_unknown_boundary(const SolveJob& job, const solve::Model& model, std::vector<std::string>& notes) {
  const bool cut = std::ranges::any_of(model.cells.inside_fraction, [](double share) { return share < 1; });
  if (job.surface.empty() && cut && !is_planar(model.cells.kind)) {
    notes.push_back("warning: " + job.cells.string() +
                    " has cells that lie in the body in part, and no surface says where it ends: at its surface the "
                    "answer may be off by a tenth of what moves; give the body's surface (--surface)");
  }
}

/// A segmentation that another program made, or that was edited, may hold a number that the scene has no tissue for.
void check_labels(const SolveJob& job, const solve::Model& model) {
  if (!model.labels || !job.other_labels) {
    return;
  }
  std::map<std::uint16_t, std::size_t> nodes;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    const std::uint16_t label = label_at(*model.labels, model.cloud.positions.row(a));
    if (model.cloud.on_surface[static_cast<std::size_t>(a)] == 0 && label != 0 && !job.materials.contains(label) &&
        !job.other_labels->contains(label)) {
      ++nodes[label];
    }
  }
  if (!nodes.empty()) {
    const auto& [label, count] = *nodes.begin();
    refuse(job.labels, "label " + std::to_string(label) + ", in which " + std::to_string(count) +
                           " nodes inside the brain lie, has no material; give it a <tissue>, or list it in the "
                           "image's other_labels if it is not of the brain");
  }
}

/// A load ends at the septum that it was not measured beyond.
void end_at_septum(const std::optional<solve::CraniotomyLoad>& measured, solve::Model& model,
                   std::vector<std::string>& notes) {
  Points& prescribed = model.conditions.displacement;
  if (!model.septum || prescribed.rows() == 0) {
    return;
  }
  const solve::Visibility past(solve::facets_of(*model.septum));
  if (measured) {
    prescribed = solve::not_through(past, measured->positions, model.cloud, std::move(prescribed));
  }
  if (const std::size_t nodes = solve::moved_through(past, model.cloud, prescribed); nodes > 0) {
    notes.push_back("warning: the load takes " + std::to_string(nodes) +
                    " nodes of the surface through the septum, which holds no node that is loaded; do load and septum "
                    "lie where they should?");
  }
}

/// Reads a load that is no field into the input and imposes it, after an unknown registration was found. Throws
/// std::invalid_argument, naming the load's files, where it cannot be imposed.
void read_measured_load(const SolveJob& job, SolveInput& input) {
  const Load& how = *job.load;
  solve::Model& model = input.model;
  input.load = read_load(how, job.surface);
  note_far_centre(how, input.load->positions, input.notes);
  solve::CraniotomyLoad& load = *input.load;
  if (load.paired_by_order) {
    input.notes.push_back(load_files(how) + " share no label: their points were paired by their order");
  }
  add_noise(how, load);
  if (how.surfaces && load.sigma.rows() > 0) {
    input.notes.push_back(
        "warning: two surfaces tell how the cortex moved along its normals, not how it slid along itself, and faults "
        "of neighbouring vertices are alike: the answer may be off by more than is said; measure points, or state a "
        "noise as large as the cortex may have slid");
  }
  naming(load_files(how), [&] {
    const solve::CraniotomyLoad taken = looked_through(load, model.cloud, how, input.notes);
    if (!how.registration_unknown) {
      impose(taken, how, model);
      return;
    }
    need_noise(taken);
    const PatientRegistration found = patient_registration(
        taken, job.options, [&](const auto& l, solve::Model& m) { impose(l, how, m); }, model);
    input.registration = found.motion;
    if (found.open > registration_at_rest) {
      input.notes.push_back("warning: the registration has not come to rest: it would still move by " +
                            with_decimals(found.open, 2) + " mm; measure more points, best inside the brain, too");
    }
  });
}

}  // namespace

solve::CraniotomyLoad read_load(const Load& load, const fs::path& surface) {
  if (load.craniotomy) {
    return solve::read_craniotomy_csv(*load.craniotomy);
  }
  if (load.markups) {
    return solve::read_markups(load.markups->before, load.markups->after);
  }
  if (load.surfaces) {
    const Surface before = read_surface(load.surfaces->before), after = read_surface(load.surfaces->after);
    return naming(load_files(load), [&] { return solve::load_from_surfaces(before, after); });
  }
  if (load.simulated) {
    return solve::simulated_craniotomy(read_surface(surface), *load.simulated);
  }
  if (load.field) {
    const Points vertices = read_surface(surface).vertices;
    const NodeCloud cloud{.positions = vertices,
                          .spacing = std::vector<double>(static_cast<std::size_t>(vertices.rows()), 1.0),
                          .on_surface = std::vector<std::uint8_t>(static_cast<std::size_t>(vertices.rows()), 1)};
    return at_known_nodes(vertices, field_on_surface_nodes(*load.field, load.opening, cloud).displacement);
  }
  throw std::invalid_argument("no load is named: give measured displacements, markups, surfaces or a simulated one");
}

SolveInput read_input(const SolveJob& job) {
  SolveInput input;
  solve::Model& model = input.model;
  model.cloud = read_node_cloud(job.nodes);
  model.conditions = solve::read_conditions(job.nodes);
  note_replaced(job, model.conditions, input.notes);
  model.cells = read_background_cells(job.cells);
  model.labels = labels_if(job.labels);
  model.materials = job.materials;
  check_labels(job, model);
  model.plane = job.plane;
  model.gravity = job.loading.gravity;
  if (job.gravity) {
    model.fluid = drained_fluid(*job.gravity, model.cloud.positions);
  }
  model.curve = load_curve(job.loading);
  model.rupture = job.rupture;
  model.resection = job.resection;
  if (model.resection && !job.wall.empty()) {
    model.resection->wall = read_surface(job.wall);
  }
  read_cuts(job, model);
  if (!job.last.empty()) {
    model.last = read_solution(job.last);
  }
  if (!job.septum.empty()) {
    model.septum = solve::read_septum(job.septum);
  }
  if (!job.surface.empty()) {
    model.boundary = read_surface(job.surface);
  }
  note_unknown_boundary(job, model, input.notes);
  if (!job.skull.empty()) {
    model.skull = read_surface(job.skull);
  }
  if (job.load && job.load->field) {
    impose_field(*job.load, input);
    end_at_septum({}, model, input.notes);
  } else if (job.load) {
    read_measured_load(job, input);
    end_at_septum(input.load, model, input.notes);
  }
  if (job.load && job.load->robust) {
    warn(warnings_of(naming(load_files(*job.load),
                            [&] { return solve::lessen_outliers(model, job.options, job.load->opening); })),
         input.notes);
  }
  if (model.conditions.measured && !job.landmarks.empty()) {
    model.conditions.measured->asked = solve::read_markup_positions(job.landmarks);
  }
  input.options = job.options;
  return input;
}

}  // namespace brainshift::pipelines
