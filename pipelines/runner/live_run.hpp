// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipelines/runner/folder_lock.hpp"
#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/update_run.hpp"
#include "register/field/repeated_field.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {

/// A finished run in memory that answers one load after another with transforms, each in a folder of its own,
/// RUN/live/NUMBER, that appears when it is whole. Numbers go on from those that are there; it holds RUN/live against
/// other processes, whose numbers would be the same.
class LiveRun {
 public:
  /// with_image: the T1 is warped, too. device: as of UpdatedRun. Throws as UpdatedRun does, and where there is no T1
  /// to warp.
  LiveRun(const std::filesystem::path& run, bool with_image, std::optional<solve::Device> device,
          Interruption& interruption, const Progress& progress);

  struct Answer {
    std::filesystem::path folder;
    double largest_displacement = 0;  ///< mm
    double error_bound = 0;           ///< mm
    std::string device_fault;         ///< UpdatedRun::device_fault() where it is new
  };

  /// Throws std::invalid_argument, naming the file, where it is at fault, and std::runtime_error where the load could
  /// not be answered: the run is then read again before the next answer. std::invalid_argument, too, once the run was
  /// solved anew: answers would be of what it was.
  Answer answer(const std::filesystem::path& load);

  /// UpdatedRun::not_kept() of the run as it was read first.
  const std::string& not_kept() const { return not_kept_; }

  /// What is wrong with the load of the last answer, UpdatedRun::warnings(). Only after an answer.
  Warnings warnings() const { return updated_->warnings(); }

  /// Adds warped.nii.gz to the last answer. Only with an image.
  void warp_image();

 private:
  UpdatedRun& updated();
  solve::SolveResult solve(const solve::CraniotomyLoad& load, const std::filesystem::path& file);
  void rehearse(const Progress& progress);
  void check_same_run() const;

  std::filesystem::path run_, live_;
  std::optional<solve::Device> device_;
  Interruption& interruption_;
  std::optional<FolderLock> lock_;
  std::optional<UpdatedRun> updated_;
  std::optional<registration::RepeatedField> field_;
  std::optional<ScalarImage> t1_;
  registration::RegisterOptions options_;
  std::string not_kept_;
  std::filesystem::file_time_type solved_at_;  ///< when the run's solve stage was written
  int number_ = 0;                             ///< of the last answer
  VectorImage resampling_;                     ///< of the last answer
};

}  // namespace brainshift::pipelines
