// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "solve/solve.hpp"
#include "solve/uncertainty/draw.hpp"

namespace brainshift::pipelines {

/// Where finished samples lie.
class SampleFolder {
 public:
  /// Makes the folder. scratch: on the same file system, cleared when the run is interrupted.
  SampleFolder(std::filesystem::path folder, std::filesystem::path scratch);

  /// Displacements of so many nodes, mm. Absent: it is not there, or damaged.
  std::optional<Points> find(const std::string& key, Eigen::Index nodes);
  /// Appears when it is whole.
  void keep(const std::string& key, Solution sample) const;
  /// Samples that nobody has asked for go: they are of other loads and constants.
  void clear_others() const;

 private:
  std::filesystem::path named(const std::string& key) const;

  std::filesystem::path folder_, scratch_;
  std::set<std::filesystem::path> used_;
};

/// samples.csv: what was drawn and how far it moved the answer.
class SampleTable {
 public:
  SampleTable(const std::filesystem::path& file, const solve::Constants& constants);
  /// rms: of the difference from the answer, mm.
  void add(int sample, const solve::Constants& constants, double rms);
  /// Throws std::runtime_error, naming the file, when it cannot be written whole.
  void close();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

/// Solves a model with other constants, or finds it solved.
class Sampler {
 public:
  /// Of a finished solution and what it is of, which must live on.
  Sampler(const solve::Model& model, const solve::SolveOptions& options, const solve::SolveResult& result,
          SampleFolder folder);

  /// One of each, mm; those that are not found are solved together. Absent: it could not be solved.
  std::vector<std::optional<Points>> displacements(const std::vector<solve::Constants>& constants,
                                                   const Progress& progress);
  void clear_others() const { folder_.clear_others(); }

 private:
  void keep(const solve::Constants& constants, const Points& displacement) const;

  const solve::SolveOptions& options_;
  solve::Model model_;
  const Solution& answer_;
  SampleFolder folder_;
};

}  // namespace brainshift::pipelines
