// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/frame_note.hpp"

#include "segmentation/image/image_ending.hpp"
#include "segmentation/image/image_header.hpp"

namespace brainshift {

std::string frame_note(const std::filesystem::path& file) {
  const std::string_view ending = image_ending(file);
  if (ending == ".nrrd") {
    return read_nrrd_header(file).frame_note;
  }
  if (is_mgh_ending(ending)) {
    return read_mgh_header(file).frame_note;
  }
  return is_nifti_ending(ending) ? read_nifti_header(file).frame_note : "";
}

}  // namespace brainshift
