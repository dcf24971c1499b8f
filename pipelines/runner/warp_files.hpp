// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "register/files/warp_any.hpp"

namespace brainshift::pipelines {

/// Files that a finished run's fields take to the other brain.
struct WarpJob {
  std::filesystem::path run;  ///< the --out of a run, or its register folder
  std::vector<std::filesystem::path> files;
  std::filesystem::path like;  ///< image whose grid warped images take; their own if empty
  registration::Towards towards = registration::Towards::intraop;
  registration::WarpAnyOptions options;
};

/// Throws std::invalid_argument where what is warped would lie among the files of a run's stage.
void refuse_stage_folder(const std::filesystem::path& out);

/// Throws std::invalid_argument where a file is missing, two would get one name in the folder, or one there would be
/// written over.
void check_to_warp(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

/// Writes each to a folder as warped_NAME. Returns a sentence on each. Throws as check_to_warp(), before anything is
/// written, and as warp_any().
std::vector<std::string> warp_files(const std::vector<std::filesystem::path>& files,
                                    registration::RegisterFields& fields, const std::filesystem::path& out,
                                    const registration::WarpAnyOptions& options);

/// The same with a run's fields.
std::vector<std::string> warp_files(const WarpJob& job, const std::filesystem::path& out);

/// Of the same files warped before, what lies in `out` and has nothing of its name in `made`: a run without an
/// estimate of the error writes none beside a warped image, and that of another run is not its.
void remove_values_of_earlier(const std::vector<std::filesystem::path>& files, const std::filesystem::path& made,
                              const std::filesystem::path& out);

}  // namespace brainshift::pipelines
