// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include "pipelines/runner/answer_warnings.hpp"
#include "pipelines/runner/job_files.hpp"
#include "pipelines/runner/load_warnings.hpp"
#include "pipelines/runner/measure_warnings.hpp"
#include "pipelines/runner/measures.hpp"
#include "pipelines/runner/patient_registration.hpp"
#include "segmentation/files/naming.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/outliers.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// What a load with noise leaves beside the solution.
void write_measured(const SolveJob& job, const SolveInput& input, const solve::SolveResult& result, const fs::path& out,
                    StageReport& said) {
  if (!result.measures.measured) {
    return;
  }
  const Load& how = job.load.value();
  const solve::MeasuredFit& fit = *result.measures.measured;
  if (!how.field) {  // what sinks moves as the rest of the surface does not, and nobody can take a place out of a field
    warn(warnings_of(solve::outliers(solve::thinned_body(input.model, input.options.shape), input.model.conditions),
                     !how.robust && !how.registration_unknown),
         said);
  }
  if (input.registration) {
    solve::write_rigid(out / "registration_error.tfm", *input.registration);
    said.measures["registration_angle_deg"] = input.registration->angle();
    constexpr double most = 30;  // degrees
    if (const double angle = input.registration->angle(); angle > most) {
      said.notes.push_back("warning: the registration turns by " + with_digits(angle) +
                           " degrees; are load and image in the same frame (LPS or RAS)?");
    }
    const Points& x = input.load->positions;
    said.measures["registration_shift_mm"] = ((*input.registration)(x)-x).colwise().mean().norm();
    const double doubt = registration_deviation(fit, input.model.cloud.positions);
    said.measures["registration_deviation_mm"] = doubt;
    if (!input.model.skull) {
      said.notes.push_back(
          "no skull holds the brain: all rigid motion that was measured counts as the patient's registration");
    } else if (doubt > 1) {
      said.notes.push_back("warning: the error of the registration is known to " + with_decimals(doubt) +
                           " mm only; the points do not tell it from the brain's own motion: measure more, some of "
                           "them inside the brain and some away from the opening");
    }
  }
}

constexpr double solving_share = 0.3;  // of the stage's progress, where samples follow

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
  write_covariance(out / "uncertainty.csv", solve::read_markup_positions(job.landmarks), result,
                   spread ? spread->constants : Eigen::MatrixXd());
}

/// How far a state lies from the one before it.
void measure_move(const Solution& last, const Solution& now, StageReport& said) {
  const bool same = last.positions.rows() == now.positions.rows() && last.positions == now.positions;
  const solve::FieldDifference move =
      same ? solve::field_difference(now.displacement, last.displacement) : solve::field_difference(now, last);
  said.measures["moved_since_last_mm"] = move.largest;
  said.measures["moved_since_last_95_mm"] = move.percentile_95;
}

/// The load in the frame of the image, also where the tracker's had to be found.
solve::CraniotomyLoad in_image(const SolveInput& input) {
  return input.registration ? solve::registered(*input.load, *input.registration) : *input.load;
}

}  // namespace

StageReport run_job(const SolveJob& job, const fs::path& out, const Progress& given) {
  const Progress progress = job.uncertainty ? part_of(given, 0, solving_share) : given;
  report(progress, 0, "reading");
  const SolveInput input = read_input(job);
  if (input.load) {
    solve::write_craniotomy_csv(out / "load.csv", in_image(input));
  }
  if (input.model.septum) {
    write_surface(out / "septum.vtp", input.model.septum->sheet);
  }
  const solve::SolveResult result = naming(job.nodes.string() + " and " + job.cells.string(),
                                           [&] { return solve::solve(input.model, input.options, progress); });
  solve::write_solve(out, result);
  StageReport said = report_of(result, input.options.dynamics);
  if (input.model.last) {
    measure_move(*input.model.last, result.solution, said);
  }
  for (const std::vector<std::string>& notes : {input.notes, notes_of(result.measures)}) {
    said.notes.insert(said.notes.end(), notes.begin(), notes.end());
  }
  write_measured(job, input, result, out, said);
  add_uncertainty(job, input, result, out, said, part_of(given, solving_share, 1));
  warn(warnings_of(result.measures), said);
  warn(warnings_of_gravity(input.model), said);
  warn(warnings_of_rooms(input.model), said);
  warn(warnings_of_levels(input.model), said);
  warn(warnings_of(input.model, result.solution), said);
  if (said.failure.empty()) {
    said.failure = turn_fault(input.model, result.solution);
  }
  if (input.load) {
    warn(warnings_of(in_image(input), input.model, result.solution.displacement), said);
  }
  return said;
}

}  // namespace brainshift::pipelines
