// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "pipelines/runner/measures.hpp"
#include "pipelines/runner/patient_registration.hpp"
#include "pipelines/runner/warnings.hpp"
#include "pipelines/runner/warp_files.hpp"
#include "pipelines/show/shown_fields.hpp"
#include "register/field/nodal_values.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/frame_note.hpp"
#include "segmentation/septa/septa.hpp"
#include "solve/cut/septum.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/measured.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

std::optional<LabelMap> labels_if(const fs::path& file) {
  return file.empty() ? std::nullopt : std::optional(read_label_map(file));
}

void need_same_grid(const ImageGeometry& t1, const fs::path& t1_file, const std::optional<LabelMap>& other,
                    const fs::path& other_file) {
  if (other && !same_geometry(t1, other->geometry)) {
    throw std::invalid_argument(other_file.string() +
                                ": its grid (size, spacing, origin or direction) is not that of " + t1_file.string() +
                                "; resample it onto that image first");
  }
}

/// A mask, which may be an image of other numbers: non-zero is inside.
std::optional<LabelMap> mask_if(const fs::path& file) {
  if (file.empty()) {
    return std::nullopt;
  }
  const ScalarImage image = read_image(file);
  LabelMap mask{image.geometry, std::vector<std::uint16_t>(image.voxels.size())};
  std::transform(image.voxels.begin(), image.voxels.end(), mask.voxels.begin(),
                 [](float value) { return static_cast<std::uint16_t>(value != 0); });
  return mask;
}

/// A tumour's map as a mask: of BraTS's numbers the tumour without its oedema.
std::optional<LabelMap> tumour_if(const fs::path& file) {
  auto tumour = labels_if(file);
  if (tumour) {
    const auto volumes = segmentation::label_volumes(*tumour);
    const bool brats = volumes.contains(2) && volumes.contains(1) + volumes.contains(3) + volumes.contains(4) > 0;
    for (std::uint16_t& voxel : tumour->voxels) {
      voxel = voxel != 0 && !(brats && voxel == 2) ? 1 : 0;
    }
  }
  return tumour;
}

/// Takes a map to the reference's grid, and says so. `counted`: the labels that must lie within it, all when empty.
void take_to_grid(std::optional<LabelMap>& map, const fs::path& file, const ImageGeometry& grid,
                  const fs::path& grid_file, std::vector<std::string>& notes,
                  const std::vector<std::uint16_t>& counted = {}) {
  if (!map || same_geometry(map->geometry, grid)) {
    return;
  }
  LabelMap inner = *map;
  for (std::uint16_t& voxel : inner.voxels) {
    voxel = counted.empty() || std::find(counted.begin(), counted.end(), voxel) != counted.end() ? voxel : 0;
  }
  if (const double share = share_within(inner, grid); share < 0.5) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(static_cast<int>(100 * share)) +
                                " % of it lie within " + grid_file.string() + " (" + described(map->geometry) +
                                " against " + described(grid) +
                                "); are they of one patient and one frame? Register one to the other first");
  }
  *map = on_grid(*map, grid);
  notes.push_back(file.string() + ": lies on another grid than " + grid_file.string() +
                  "; taken to it, the nearest label at each voxel");
}

void note_frames(const ImageInputs& image, std::vector<std::string>& notes) {
  for (const fs::path& file : std::set<fs::path>{image.t1, image.labels, image.brain_mask}) {
    if (const std::string note = frame_note(file); !note.empty()) {
      notes.push_back("warning: " + file.string() + ": " + note);
    }
  }
}

/// What a table told of the labels, as the stage's options.
void set_classes(const LabelMap& labels, bool tumour, segmentation::SegmentOptions& options) {
  namespace label = segmentation::default_label;
  const auto volumes = segmentation::label_volumes(labels);
  options.brain_labels.clear();
  for (const std::uint16_t number : {label::parenchyma, label::ventricles, label::tumour}) {
    if (volumes.contains(number) || (tumour && number == label::tumour)) {
      options.brain_labels.push_back(number);
    }
  }
  options.fluid_label = label::csf;
  options.skull_label = volumes.contains(label::skull) ? std::optional(label::skull) : std::nullopt;
  // Of eight heads and FreeSurfer's, 3 mm is the least that leaves no fold; more takes in more of the fluid outside.
  constexpr double radius = 4;
  options.closing = options.closing.value_or(radius);
}

/// A stage knows no files; what it refuses is what these hold.
template <class Work>
auto naming(const std::string& files, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(files.empty() ? fault.what() : files + ": " + fault.what());
  }
}

/// From the numbers as the map has them: classes do not tell left from right.
void write_septa(const fs::path& labels, const fs::path& file, StageReport& said) {
  const Surface septa = naming(labels.string(), [&] { return segmentation::septa_of(read_label_map(labels)); });
  write_surface(file, septa);
  said.measures["septa_area_mm2"] = area(septa);
}

void add(const std::vector<std::string>& notes, StageReport& report) {
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
}

void warn(const Warnings& warnings, StageReport& report) {
  for (const std::string& warning : warnings) {
    report.notes.push_back("warning: " + warning);
  }
}

std::string load_files(const Load& load) {
  if (load.craniotomy) {
    return load.craniotomy->string();
  }
  const std::optional<BeforeAfter>& files = load.markups ? load.markups : load.surfaces;
  return files ? files->before.string() + " and " + files->after.string() : "";
}

/// As measured where standard deviations are known, else exactly.
void impose(const solve::CraniotomyLoad& load, const Load& how, solve::Model& model) {
  if (load.sigma.rows() == 0) {
    model.conditions.displacement = solve::prescribed_on_surface_nodes(model.cloud, load, how.opening);
    return;
  }
  Points force = std::move(model.conditions.force);
  model.conditions = solve::noisy_conditions(model.cloud, load, how.opening);
  model.conditions.measured->weight = how.weight;
  model.conditions.force = std::move(force);
}

/// Then what is said of points of the cortex alone does not hold.
bool has_inner_points(const solve::Model& model) {
  return model.conditions.measured && model.conditions.measured->inner.rows() > 0;
}

void need_noise(const solve::CraniotomyLoad& load) {
  if (load.sigma.rows() == 0) {
    throw std::invalid_argument(
        "an unknown registration needs to know how well the points were measured; give <load> a noise, or the file a "
        "column sigma");
  }
  if (load.positions.rows() < 3) {
    throw std::invalid_argument("an unknown registration needs three measured points that are not in line, found " +
                                std::to_string(load.positions.rows()));
  }
}

/// What a load with noise leaves beside the solution.
void write_measured(const SolveInput& input, const solve::SolveResult& result, const fs::path& out, StageReport& said) {
  if (!result.measures.measured) {
    return;
  }
  const solve::MeasuredFit& fit = *result.measures.measured;
  warn(warnings_of(solve::worst_outlier(input.model, input.options, fit)), said);
  if (input.registration) {
    solve::write_rigid(out / "registration_error.tfm", *input.registration);
    said.measures["registration_angle_deg"] = input.registration->angle();
    const Points& x = input.load->positions;
    said.measures["registration_shift_mm"] = ((*input.registration)(x)-x).colwise().mean().norm();
    const double doubt = fit.motion_deviation.maxCoeff();
    said.measures["registration_deviation_mm"] = doubt;
    if (!input.model.skull) {
      said.notes.push_back(
          "no skull holds the brain: all rigid motion that was measured counts as the patient's registration");
    } else if (doubt > 1) {
      said.notes.push_back("warning: the error of the registration is known to " + std::to_string(doubt) +
                           " mm only; the points do not tell it from the brain's own motion: measure some inside the "
                           "brain, or away from the opening");
    }
  }
}

constexpr double solving_share = 0.3;  // of the stage's progress, where samples follow

Progress part_of(const Progress& whole, double from, double to) {
  return
      [whole, from, to](double fraction, std::string_view what) { report(whole, from + fraction * (to - from), what); };
}

/// uncertainty.vtu where it is wanted, and uncertainty.csv where the landmarks' covariance is known.
void add_uncertainty(const SolveJob& job, const SolveInput& input, const solve::SolveResult& result,
                     const fs::path& out, StageReport& said, const Progress& progress) {
  std::optional<Spread> spread;
  if (job.uncertainty && result.failure.empty()) {
    spread = write_spread(*job.uncertainty, {input.model, input.options, result}, out, said, progress);
  }
  if (job.landmarks.empty() || (!spread && !result.measures.measured)) {
    return;
  }
  const Points places = solve::read_markup_positions(job.landmarks);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(places.rows(), 6);
  if (result.measures.measured) {
    covariance += result.measures.measured->covariance;
  }
  if (spread) {
    covariance += registration::nodal_values_at(result.solution, spread->constants, false, places);
  }
  write_covariance(out / "uncertainty.csv", places, covariance);
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
  throw std::invalid_argument("no load is named: give measured displacements, markups, surfaces or a simulated one");
}

StageReport run_job(const SegmentJob& job, const fs::path& out, const Progress& progress) {
  segmentation::SegmentInput input;
  segmentation::SegmentOptions options = job.options;
  std::vector<std::string> notes;
  report(progress, 0, "reading");
  if (!job.image.t1.empty()) {
    input.t1 = read_image(job.image.t1);
  }
  if (!job.image.labels.empty()) {
    ReadLabels read = read_labels(job.image, job.reading);
    input.labels = std::move(read.map);
    notes = std::move(read.notes);
  }
  input.brain_mask = mask_if(job.image.brain_mask);
  input.tumour_mask = job.image.tumour.empty() ? mask_if(job.image.tumour_mask) : tumour_if(job.image.tumour);
  if (!job.image.surface.empty()) {
    input.surface = read_surface(job.image.surface);
  }
  if (input.labels && job.reading.by_class) {
    set_classes(*input.labels, input.tumour_mask.has_value(), options);
  }
  const fs::path& tumour = job.image.tumour.empty() ? job.image.tumour_mask : job.image.tumour;
  if (input.t1) {
    take_to_grid(input.labels, job.image.labels, input.t1->geometry, job.image.t1, notes, options.brain_labels);
    take_to_grid(input.brain_mask, job.image.brain_mask, input.t1->geometry, job.image.t1, notes);
    take_to_grid(input.tumour_mask, tumour, input.t1->geometry, job.image.t1, notes);
  } else if (input.labels) {
    take_to_grid(input.tumour_mask, tumour, input.labels->geometry, job.image.labels, notes);
  }
  note_frames(job.image, notes);
  if (input.t1 && input.labels) {
    for (const std::string& warning : warnings_of(*input.t1, *input.labels, options.brain_labels)) {
      notes.push_back("warning: " + warning);
    }
  }
  const fs::path& file = input.labels ? job.image.labels : input.surface ? job.image.surface : job.image.brain_mask;
  const segmentation::Segmentation result =
      naming(file.string(), [&] { return segmentation::segment(input, options, progress); });
  segmentation::write_segmentation(out, result);
  StageReport stage = report_of(result);
  if (job.septa) {
    write_septa(job.image.labels, out / "septa.vtp", stage);
  }
  stage.notes.insert(stage.notes.begin(), notes.begin(), notes.end());
  return stage;
}

StageReport run_job(const DiscretiseJob& job, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading");
  const Surface brain = read_surface(job.surface);
  const std::optional<LabelMap> labels = labels_if(job.labels);
  discretise::DiscretiseOptions options = job.options;
  if (job.refinement.factor < 1 && job.load) {
    options.craniotomy = job.refinement;
    options.craniotomy->centres = read_load(*job.load, job.surface).positions;
  }
  const auto result = naming(job.surface.string(), [&] {
    return discretise::discretise(brain, labels ? &*labels : nullptr, options, progress);
  });
  discretise::write_discretisation(out, result);
  return report_of(result.measures);
}

SolveInput read_input(const SolveJob& job) {
  SolveInput input;
  solve::Model& model = input.model;
  model.cloud = read_node_cloud(job.nodes);
  model.conditions = solve::read_conditions(job.nodes);
  model.cells = read_background_cells(job.cells);
  model.labels = labels_if(job.labels);
  model.materials = job.materials;
  model.plane = job.plane;
  model.gravity = job.loading.gravity;
  if (job.gravity) {
    model.fluid = drained_fluid(*job.gravity, model.cloud.positions);
  }
  model.curve = load_curve(job.loading);
  model.rupture = job.rupture;
  model.resection = job.resection;
  read_cuts(job, model);
  if (!job.septum.empty()) {
    model.septum = solve::read_septum(job.septum);
  }
  if (!job.surface.empty()) {
    model.boundary = read_surface(job.surface);
  }
  if (!job.skull.empty()) {
    model.skull = read_surface(job.skull);
  }
  if (job.load) {
    input.load = read_load(*job.load, job.surface);
    solve::CraniotomyLoad& load = *input.load;
    if (load.sigma.rows() == 0 && job.load->noise) {
      load.sigma = Points::Constant(load.positions.rows(), 3, *job.load->noise);
    }
    naming(load_files(*job.load), [&] {
      if (!job.load->registration_unknown) {
        impose(load, *job.load, model);
        return;
      }
      need_noise(load);
      input.registration = patient_registration(
          load, job.options, [&](const auto& l, solve::Model& m) { impose(l, *job.load, m); }, model);
    });
    if (model.conditions.measured && !job.landmarks.empty()) {
      model.conditions.measured->asked = solve::read_markup_positions(job.landmarks);
    }
  }
  input.options = job.options;
  return input;
}

StageReport run_job(const SolveJob& job, const fs::path& out, const Progress& given) {
  const Progress progress = job.uncertainty ? part_of(given, 0, solving_share) : given;
  report(progress, 0, "reading");
  const SolveInput input = read_input(job);
  if (input.load) {
    solve::write_craniotomy_csv(out / "load.csv", *input.load);
  }
  if (input.model.septum) {
    write_surface(out / "septum.vtp", input.model.septum->sheet);
  }
  const solve::SolveResult result = naming(job.nodes.string() + " and " + job.cells.string(),
                                           [&] { return solve::solve(input.model, input.options, progress); });
  solve::write_solve(out, result);
  StageReport said = report_of(result, input.options.dynamics);
  write_measured(input, result, out, said);
  add_uncertainty(job, input, result, out, said, part_of(given, solving_share, 1));
  warn(warnings_of(result.measures), said);
  warn(warnings_of_weight(input.model), said);
  if (input.load && !has_inner_points(input.model)) {
    warn(warnings_of(*input.load, input.model.cloud, input.model.conditions.displacement), said);
    warn(warnings_of(input.model, result.solution.displacement), said);
  }
  return said;
}

StageReport run_job(const RegisterJob& job, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading");
  registration::RegisterInput input;
  input.solution = read_solution(job.solution);
  input.brain = read_surface(job.surface);
  input.labels = labels_if(job.labels);
  if (!job.t1.empty()) {
    input.t1 = read_image(job.t1);
    need_same_grid(input.t1.geometry, job.t1, input.labels, job.labels);
  } else if (input.labels) {
    input.t1.geometry = input.labels->geometry;
  }
  if (!job.landmarks.empty()) {
    input.landmarks = solve::read_markup_positions(job.landmarks);
  }
  const fs::path& reference = job.t1.empty() ? job.labels : job.t1;
  const registration::Registration result = naming(reference.string() + " and " + job.surface.string(), [&] {
    return registration::register_images(input, job.options, progress);
  });
  registration::write_registration(out, result);
  write_shown_fields(out, input.solution, input.brain, result.forward);
  if (!job.uncertainty.empty()) {
    write_nodal_image(out / "uncertainty.nii.gz", input.solution, read_deviations(job.uncertainty));
  }
  StageReport said = report_of(result);
  warn(warnings_of(result.measures), said);
  if (!job.warp.empty() || !job.warp_labels.empty()) {
    registration::RegisterFields fields(out, registration::Towards::intraop, job.solution);
    registration::WarpAnyOptions options{.interpolation = job.options.interpolation, .grid = {}};
    add(warp_files(job.warp, fields, out, options), said);
    options.values = registration::Values::labels;
    add(warp_files(job.warp_labels, fields, out, options), said);
  }
  return said;
}

}  // namespace brainshift::pipelines
