// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/frame_note.hpp"

#include "segmentation/files/lower_case.hpp"
#include "segmentation/image/image_header.hpp"

namespace brainshift {

std::string frame_note(const std::filesystem::path& file) {
  const std::string name = in_lower_case(file.filename().string());
  if (name.ends_with(".nrrd")) {
    return read_nrrd_header(file).frame_note;
  }
  if (name.ends_with(".mgh") || name.ends_with(".mgz") || name.ends_with(".mgh.gz")) {
    return read_mgh_header(file).frame_note;
  }
  return name.ends_with(".nii") || name.ends_with(".nii.gz") ? read_nifti_header(file).frame_note : "";
}

}  // namespace brainshift
