// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace brainshift::pipelines {

/// The files that a user has at hand; empty where there is none.
struct FilesAtHand {
  std::filesystem::path t1;
  std::filesystem::path labels;
  std::string labels_are;  ///< "freesurfer", "brats" or a table's file; empty: a table beside the map, or recognised
  std::filesystem::path brain_mask;
  std::filesystem::path tumour;
  std::vector<std::filesystem::path> points;  ///< craniotomy.csv; or markups or surfaces before and after
};

/// A short scene of them.
struct NewScene {
  std::string text;                ///< XML; file names are absolute, as nobody knows where it will be kept
  std::vector<std::string> taken;  ///< what each file was taken for, a sentence each; comments of the text, too
};

/// Looks into the files. Throws std::invalid_argument, naming the file and what to give instead, where one cannot be
/// read or a scene cannot be made of them.
NewScene new_scene(const FilesAtHand& files);

}  // namespace brainshift::pipelines
