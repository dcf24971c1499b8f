// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "segmentation/files/lower_case.hpp"

namespace brainshift {

/// ".nii.gz" of "T1.NII.GZ"; empty where the name is none of an image's. Folders, which may hold DICOM, have none.
inline std::string_view image_ending(const std::filesystem::path& file) {
  static constexpr std::array<std::string_view, 7> endings = {".nii", ".nii.gz", ".nrrd",  ".mha",
                                                              ".mgz", ".mgh",    ".mgh.gz"};
  const std::string name = in_lower_case(file.filename().string());
  for (const std::string_view ending : endings) {
    if (name.ends_with(ending)) {
      return ending;
    }
  }
  return {};
}

inline bool is_nifti_ending(std::string_view ending) {
  return ending == ".nii" || ending == ".nii.gz";
}

inline bool is_mgh_ending(std::string_view ending) {
  return ending == ".mgz" || ending == ".mgh" || ending == ".mgh.gz";
}

}  // namespace brainshift
