// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/warp_files.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "pipelines/checksum/sha256.hpp"
#include "pipelines/runner/artefacts.hpp"
#include "pipelines/runner/job_files.hpp"
#include "pipelines/runner/read_run_record.hpp"
#include "pipelines/runner/stage_record.hpp"
#include "pipelines/runner/warnings.hpp"
#include "pipelines/scene/scene.hpp"
#include "register/files/warped_name.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/image/frame_note.hpp"
#include "segmentation/image/image_series.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

/// Of an image that shows little or nothing of what moves; empty of others.
std::string outside_of(const registration::WarpedFile& warped) {
  constexpr double much = 0.5;
  if (std::isnan(warped.from_outside)) {
    return "; warning: nothing in it moves; does it lie where the run's image does?";
  }
  return !warped.is_label_map && warped.from_outside > much
             ? "; warning: " + with_digits(100 * warped.from_outside) +
                   " % of what moves comes from outside the image, as it is cut off or thin, and is 0"
             : "";
}

/// What became of a file, as a sentence.
std::string told(const fs::path& file, const registration::WarpedFile& warped) {
  const std::string name = file.filename().string() + ": ", frame = frame_note(file);
  const std::string noted = outside_of(warped) + (frame.empty() ? "" : "; warning: " + frame);
  const std::string emptied = warped.removed == 0 ? "" : ", 0 where tissue was taken out";
  if (warped.is_label_map) {
    return name + "a label map, each voxel took the nearest label" + emptied + noted;
  }
  if (warped.is_image) {
    return name + "an image, interpolated" + emptied + noted +
           (warped.no_series.empty() ? "" : "; no DICOM series was written: " + warped.no_series);
  }
  const registration::MovedPoints& moved = warped.moved;
  std::string sentence = name + std::to_string(moved.points) + " points, moved by up to " +
                         write_number(std::round(100 * moved.largest) / 100) + " mm";
  if (moved.outside > 0) {
    sentence += "; " + std::to_string(moved.outside) + " lie outside the run's image and stay where they were";
  }
  if (moved.removed > 0) {
    sentence += "; warning: of all points " + std::to_string(moved.removed) + (moved.removed == 1 ? " lies" : " lie") +
                " in what was taken out, where a displacement means nothing";
  }
  return sentence;
}

/// All that a warped file may be written as.
std::vector<fs::path> names_of(const fs::path& file) {
  const fs::path warped = registration::warped_name(file);
  std::vector<fs::path> names = {warped, registration::values_name("estimated_error", warped),
                                 registration::values_name("uncertainty", warped)};
  if (fs::is_directory(file)) {
    names.push_back(registration::series_name(warped));
  }
  return names;
}

/// A sequence has the fields of each state.
void check_is_one_state(const fs::path& run) {
  if (const auto record = read_run_record(run); record.is_object() && record.contains("states")) {
    refuse(run, "the folder of a sequence; give that of one of its states, states/NAME in it");
  }
}

/// A state that its sequence no longer has stays where it was.
void check_is_of_its_sequence(const fs::path& run) {
  const fs::path state = fs::weakly_canonical(run), states = state.parent_path();
  if (states.filename() != "states") {
    return;
  }
  const auto record = read_run_record(states.parent_path());
  if (record.is_object() && !(record.contains("states") && record["states"].contains(state.filename().string()))) {
    refuse(run, "the sequence has not come to this state when it ran last, or has it no more; run it again");
  }
}

/// A later run that did not get so far, or still goes on, leaves the fields of an earlier one.
void check_up_to_date(const fs::path& fields) {
  const auto record = read_run_record(fields / "..");
  if (!record.is_object() || !record.contains("stages")) {
    return;  // fields alone
  }
  const std::string status = record.value(nlohmann::ordered_json::json_pointer("/stages/register/status"), "");
  if (status != "done" && status != "kept") {
    refuse(fields, "its fields are of an earlier run: the scene has changed since; run it again to the end");
  }
}

/// Points move by one field, images by the other: a field that was replaced alone would part them.
void check_both_or_neither_replaced(const fs::path& folder) {
  const std::optional<StageRecord> record = read_stage_record(folder);
  if (!record) {
    return;  // fields alone
  }
  nlohmann::ordered_json fields = nlohmann::ordered_json::object();
  for (const char* name : {registration::forward_name, registration::resampling_name}) {
    if (record->artefacts.contains(name)) {
      fields[name] = record->artefacts[name];
    }
  }
  const std::vector<std::string> replaced = changes_of(fields, folder).edited;
  if (replaced.size() == 1) {
    refuse(folder / replaced.front(),
           "it is another than the run made, and the field of the other direction is not: points would go by the one "
           "and images by the other; replace both, or run the scene again");
  }
}

/// The solution that the fields are of, as far as it is known; none where another lies there.
fs::path solution_of(const fs::path& fields, std::vector<std::string>& notes) {
  const fs::path solution = fields / "../solve/solution.vtu";
  const std::optional<StageRecord> record = read_stage_record(fields);
  const std::string known = record ? record->entry.value("/measures/solution_sha256"_json_pointer, "") : "";
  if (known.empty() || !fs::exists(solution) || sha256_of_file(solution) == known) {
    return solution;
  }
  if (fs::canonical(fields).filename() == stage_name(StageId::registration)) {
    refuse(fields, "its fields are of an earlier solution than the one beside it; register that one first");
  }
  notes.push_back(fields.string() + ": its fields are of another solution than " + solution.string() +
                  ", so how far they may be off is not told");
  return {};
}

}  // namespace

void refuse_stage_folder(const fs::path& out) {
  if (fs::exists(out / "stage.json")) {
    refuse(out, "is a stage's folder, whose own files warped ones could take the place of; give another --out");
  }
}

void check_to_warp(const std::vector<fs::path>& files, const fs::path& out) {
  std::set<fs::path> names;
  for (const fs::path& file : files) {
    if (!fs::exists(file)) {
      refuse(file, "no such file; check the path");
    }
    for (const fs::path& name : names_of(file)) {
      if (fs::exists(out / name) || !names.insert(name).second) {
        refuse(file, "there is a " + name.string() + " already; rename the file that is to be warped");
      }
    }
  }
}

std::vector<std::string> warp_files(const std::vector<fs::path>& files, registration::RegisterFields& fields,
                                    const fs::path& out, const registration::WarpAnyOptions& options) {
  check_to_warp(files, out);
  std::vector<std::string> notes;
  for (const fs::path& file : files) {
    notes.push_back(told(file, registration::warp_any(file, fields, out / registration::warped_name(file), options)));
  }
  return notes;
}

std::vector<std::string> warp_files(const WarpJob& job, const fs::path& out) {
  check_is_one_state(job.run);
  check_is_of_its_sequence(job.run);
  const fs::path stage = job.run / "register";
  const fs::path folder = fs::is_directory(stage) ? stage : job.run;
  check_up_to_date(folder);
  check_both_or_neither_replaced(folder);
  std::vector<std::string> notes;
  registration::RegisterFields fields(folder, job.towards, solution_of(folder, notes));
  registration::WarpAnyOptions options = job.options;
  if (!job.like.empty()) {
    std::ranges::copy(frame_warnings({job.like}), std::back_inserter(notes));
    options.grid = is_image_series(job.like) ? read_image_series(job.like).volumes.front().geometry
                                             : read_image(job.like).geometry;
  }
  std::ranges::copy(warp_files(job.files, fields, out, options), std::back_inserter(notes));
  return notes;
}

void remove_values_of_earlier(const std::vector<fs::path>& files, const fs::path& made, const fs::path& out) {
  for (const fs::path& file : files) {
    for (const fs::path& name : names_of(file)) {
      if (!fs::exists(made / name) && !fs::is_directory(out / name)) {
        fs::remove(out / name);
      }
    }
  }
}

}  // namespace brainshift::pipelines
