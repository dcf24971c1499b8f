// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipelines/runner/interruption.hpp"
#include "pipelines/runner/jobs.hpp"
#include "pipelines/runner/warnings.hpp"
#include "pipelines/scene/scene.hpp"
#include "segmentation/progress/progress.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/update/kept_run.hpp"

namespace brainshift::pipelines {

/// A finished run that answers other loads. What is expensive to make lies in RUN/update/kept.bin, under a key of all
/// that it was made from: one of another content counts as absent and is made again.
class UpdatedRun {
 public:
  /// Throws std::invalid_argument, naming the folder, where it holds no finished run, one of another version, one whose
  /// scene or files have changed since, or one that cannot be updated. device: that answers; the run's own if absent.
  UpdatedRun(const std::filesystem::path& run, Interruption& interruption, const Progress& progress = {},
             std::optional<solve::Device> device = {});

  /// Displacements of a CSV, with standard deviations where the run's load had some: the scene's, where the file says
  /// none. Throws std::invalid_argument, naming the file, where they cannot be the run's new ones.
  solve::CraniotomyLoad read(const std::filesystem::path& file) const;

  /// Answers them. file: that they are from, for what is at fault. After a failure the run must be made anew, after a
  /// throw unless it is_whole().
  solve::SolveResult solve(const solve::CraniotomyLoad& load, const std::filesystem::path& file,
                           const Progress& progress);

  /// Once more the load that the run was solved with; otherwise as solve().
  solve::SolveResult answer_own_load(const Progress& progress);

  /// Not where a throw has come from between two states of rest.
  bool is_whole() const { return kept_.fine.body.nodes() > 0; }

  /// What is wrong with the load that was answered last, as a run's notes say it of the load.
  Warnings warnings() const;

  /// û of the last answer, in the order of the cloud, (n × 3) mm.
  Points parameters() const;

  const Scene& scene() const { return scene_; }

  /// Why what was prepared could not be kept on disk, so that the next update prepares it again; empty: it is kept.
  const std::string& not_kept() const { return not_kept_; }

  /// How a GPU has failed, so that the processor answers from then on; empty: it has not.
  std::string device_fault() const;

  /// Answers the displacements of a CSV and writes solution.vtu, history.csv and load.csv into an existing folder, and
  /// uncertainty.csv where the load has noise and the scene landmarks. Throws std::invalid_argument, naming the file,
  /// where it is at fault.
  StageReport answer(const std::filesystem::path& load, const std::filesystem::path& out, const Progress& progress);

 private:
  struct Answered {
    solve::CraniotomyLoad load;
    solve::Conditions conditions;
  };

  void make_kept(const SolveJob& job, const Progress& progress);

  /// The same as solve() with what noise leaves open of the displacement at places (m × 3), mm.
  solve::SolveResult solve_and_ask(const solve::CraniotomyLoad& load, const std::filesystem::path& file,
                                   const Points& places, const Progress& progress);

  NodeCloud cloud() const;

  std::filesystem::path run_, file_;
  Scene scene_;
  std::string key_;
  Load how_;          ///< as the run's load was imposed
  Points landmarks_;  ///< (m × 3) mm, whose uncertainty a run writes; none of a load without noise
  solve::KeptRun kept_;
  Answered answered_;  ///< last
  std::string not_kept_;
};

}  // namespace brainshift::pipelines
