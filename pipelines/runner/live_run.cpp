// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/live_run.hpp"

#include <algorithm>
#include <cstdlib>
#include <future>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "pipelines/runner/own_folder.hpp"
#include "pipelines/runner/read_run_record.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "register/field/moving_part.hpp"
#include "register/field/resampling_field.hpp"
#include "register/files/transform_files.hpp"
#include "register/files/write_transform.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/whole_path.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

constexpr double grid_spacing = 2.5;  // mm

/// The highest number of an answer; what a killed program left unfinished goes.
int last_number(const fs::path& live) {
  int last = 0;
  for (const auto& entry : fs::directory_iterator(live)) {
    if (entry.path().extension() == ".partial" && is_own_folder(entry.path())) {
      remove_own_folder(entry.path());
    } else {
      last = std::max(last, std::atoi(entry.path().filename().c_str()));
    }
  }
  return last;
}

/// With leading zeros, so that names are in the order of the answers.
std::string name_of(int number) {
  constexpr std::size_t digits = 6;
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

/// The grid of the fields is the image's, too.
void check_image(const fs::path& run, const fs::path& t1) {
  const auto record = read_run_record(run);
  for (const auto& input : record["inputs"]) {
    if (input.value("role", "") == "image.t1" && !is_unchanged(input)) {
      refuse(t1, "the image has changed since the run was made; run the scene again");
    }
  }
}

/// The least time where there is none.
fs::file_time_type solved_at(const fs::path& run) {
  std::error_code absent;
  return fs::last_write_time(run / "solve" / "stage.json", absent);
}

}  // namespace

LiveRun::LiveRun(const fs::path& run, bool with_image, std::optional<solve::Device> device, Interruption& interruption,
                 const Progress& progress)
    : run_(whole_path(run)),
      live_(run_ / "live"),
      device_(device),
      interruption_(interruption),
      solved_at_(solved_at(run_)) {
  updated_.emplace(run_, interruption_, progress, device_);
  not_kept_ = updated_->not_kept();
  const Scene& scene = updated_->scene();
  options_ = scene.registration;
  const fs::path image = !scene.image.t1.empty() ? scene.image.t1 : run_ / "segment" / "labels.nii.gz";
  if (with_image && scene.image.t1.empty()) {
    refuse(run_, "there is no image to warp: its scene names no T1; leave --image out");
  }
  if (!fs::exists(image)) {
    refuse(run_, "there is no grid for a field: its scene names neither an image nor labels; use 'brainshift update'");
  }
  if (image == scene.image.t1) {
    check_image(run_, image);
  }
  ScalarImage t1 = read_image(image);
  field_.emplace(read_solution(run_ / "solve" / "solution.vtu"), read_surface(run_ / "segment" / "brain.vtp"),
                 registration::covering_grid(t1.geometry, grid_spacing), options_.fade);
  if (with_image) {
    t1_ = std::move(t1);
  }
  lock_.emplace(live_, "end it first");
  number_ = last_number(live_);
  rehearse(progress);
}

/// The first answer then waits less for memory that the system has yet to give: 0.44 s on the demo in place of 0.56.
void LiveRun::rehearse(const Progress& progress) {
  try {
    if (!updated_->answer_own_load(progress).failure.empty()) {
      updated_.reset();
      return;
    }
  } catch (const std::invalid_argument&) {  // a load.csv that is gone or was changed
    updated_.reset();
    return;
  }
  resampling_ =
      registration::resampling_field(field_->forward(updated_->parameters()), options_.inverse_tolerance).field;
}

UpdatedRun& LiveRun::updated() {
  return updated_ ? *updated_ : updated_.emplace(run_, interruption_, Progress(), device_);
}

solve::SolveResult LiveRun::solve(const solve::CraniotomyLoad& load, const fs::path& file) {
  try {
    return updated().solve(load, file, {});
  } catch (...) {
    if (updated_ && !updated_->is_whole()) {
      updated_.reset();
    }
    throw;
  }
}

void LiveRun::check_same_run() const {
  if (solved_at(run_) != solved_at_) {
    refuse(run_, "the run was solved anew since it was read; end 'brainshift live' and start it again");
  }
}

LiveRun::Answer LiveRun::answer(const fs::path& file) {
  check_same_run();
  const solve::CraniotomyLoad load = updated().read(file);
  const std::string fault_before = updated().device_fault();
  solve::SolveResult result = solve(load, file);
  if (!result.failure.empty()) {  // it went on from the answer before, with what others taught
    updated_.reset();
    result = solve(load, file);
  }
  if (!result.failure.empty()) {
    const std::optional<UpdatedRun> failed = std::exchange(updated_, std::nullopt);
    std::string fault = file.string() + ": " + result.failure;
    for (const std::string& warning : failed->warnings()) {
      fault += "; " + warning;
    }
    throw std::runtime_error(fault);
  }
  const VectorImage forward = field_->forward(updated().parameters());
  const fs::path place = live_ / name_of(number_ + 1);
  StageFolder folder(place, interruption_);
  const auto inside = [&](const char* name) { return folder.path() / (std::string(name) + ".h5"); };
  const auto plain = registration::Packing::plain;  // to deflate them takes longer than to write them
  std::future<void> point_transform = std::async(std::launch::async, [&] {  // a disk's time beside the processors'
    registration::write_transform(inside(registration::point_transform), registration::moving_part(forward), plain);
  });
  resampling_ = registration::resampling_field(forward, options_.inverse_tolerance).field;
  point_transform.get();
  registration::write_transform(inside(registration::image_transform), registration::moving_part(resampling_), plain);
  solve::write_craniotomy_csv(folder.path() / "load.csv", load);
  folder.replace();
  ++number_;
  return {place, result.measures.largest_displacement, result.measures.error_bound,
          fault_before.empty() ? updated().device_fault() : std::string()};
}

void LiveRun::warp_image() {
  StageFolder folder(live_ / name_of(number_), interruption_);
  write_image(folder.path() / "warped.nii.gz",
              registration::warp(*t1_, resampling_, options_.interpolation, t1_->geometry));
  folder.merge();
}

}  // namespace brainshift::pipelines
