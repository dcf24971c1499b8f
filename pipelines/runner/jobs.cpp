// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/discretise_warnings.hpp"
#include "pipelines/runner/job_files.hpp"
#include "pipelines/runner/measures.hpp"
#include "pipelines/runner/register_warnings.hpp"
#include "pipelines/runner/warp_files.hpp"
#include "pipelines/show/shown_fields.hpp"
#include "register/files/warped_series.hpp"
#include "segmentation/files/naming.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

void need_same_grid(const ImageGeometry& t1, const fs::path& t1_file, const std::optional<LabelMap>& other,
                    const fs::path& other_file) {
  if (other && !same_geometry(t1, other->geometry)) {
    throw std::invalid_argument(other_file.string() +
                                ": its grid (size, spacing, origin or direction) is not that of " + t1_file.string() +
                                "; resample it onto that image first");
  }
}

/// Of what was taken out.
void need_labels(const std::vector<std::int32_t>& asked, const std::optional<LabelMap>& labels, const fs::path& file) {
  for (const std::int32_t label : asked) {
    if (labels && !has_label(*labels, label)) {
      refuse(file, "no voxel has the label " + std::to_string(label) + ", which was resected");
    }
  }
}

void add(const std::vector<std::string>& notes, StageReport& report) {
  report.notes.insert(report.notes.end(), notes.begin(), notes.end());
}

/// A load on all of the surface has no rim to be finer at.
bool has_rim(const Load& load) {
  return !load.field || !load.field->where.empty();
}

}  // namespace

StageReport run_job(const DiscretiseJob& job, const fs::path& out, const Progress& progress) {
  report(progress, 0, "reading");
  const Surface brain = read_surface(job.surface);
  const std::optional<LabelMap> labels = labels_if(job.labels);
  discretise::DiscretiseOptions options = job.options;
  if (job.refinement.factor < 1 && job.load && has_rim(*job.load)) {
    options.craniotomy = job.refinement;
    const solve::CraniotomyLoad load = read_load(*job.load, job.surface);
    options.craniotomy->centres = load.positions;
    if (!job.load->field) {
      options.craniotomy->rim = solve::opening_rim(brain, load, job.load->opening);
    }
  }
  if (!job.wall.empty()) {
    options.resected = discretise::ResectedTissue{read_surface(job.wall), job.resected};
  }
  const auto result = naming(job.surface.string(), [&] {
    return discretise::discretise(brain, labels ? &*labels : nullptr, options, progress);
  });
  discretise::write_discretisation(out, result);
  StageReport said = report_of(result.measures);
  if (labels) {
    warn(warnings_of(brain, *labels, job.options), said);
  }
  return said;
}

StageReport run_job(const RegisterJob& job, const fs::path& out, const Progress& progress) {
  std::vector<fs::path> to_warp = job.warp;
  std::ranges::copy(job.warp_labels, std::back_inserter(to_warp));
  check_to_warp(to_warp, out);
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
  if (!job.wall.empty()) {
    need_labels(job.resected, input.labels, job.labels);
    input.cavity = registration::Cavity{read_surface(job.wall), job.resected};
  }
  const fs::path& reference = job.t1.empty() ? job.labels : job.t1;
  registration::Registration result =
      naming(job.solution.string() + ", " + reference.string() + " and " + job.surface.string(),
             [&] { return registration::register_images(input, job.options, progress); });
  if (!job.landmarks.empty()) {
    result.landmark_names = PointsFile(job.landmarks).labels();
  }
  registration::write_registration(out, result);
  write_shown_fields(out, input.solution, input.brain, result.forward);
  if (!job.uncertainty.empty()) {
    write_nodal_image(out / "uncertainty.nii.gz", input.solution, registration::read_deviations(job.uncertainty));
  }
  StageReport said = report_of(result);
  said.measures["solution_sha256"] = sha256_of_file(job.solution);
  if (fs::is_directory(job.t1)) {
    const fs::path series = out / "warped_dicom";
    const std::string why =
        registration::write_warped_series(series, result.warped, job.t1, registration::Towards::intraop);
    add(why.empty() ? std::vector<std::string>{} : std::vector{"no warped_dicom was written: " + why}, said);
  }
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
