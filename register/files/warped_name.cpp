// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warped_name.hpp"

#include <string>
#include <string_view>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/image/image_ending.hpp"

namespace brainshift::registration {

std::filesystem::path values_name(const std::string& values, const std::filesystem::path& warped) {
  std::string name = warped.filename().string();
  if (ending_of(warped) == ".gii") {  // as programs expect of values at the vertices of a surface
    for (const std::string_view ending : {".gii", ".surf"}) {
      name.resize(name.size() - (name.ends_with(ending) ? ending.size() : 0));
    }
    name += ".shape.gii";
  } else if (ending_of(warped) == ".tck") {
    name = std::filesystem::path(name).replace_extension(".tsf").string();
  }
  return warped.parent_path() / (values + "_" + name);
}

std::filesystem::path warped_name(const std::filesystem::path& in) {
  const std::filesystem::path file = in.has_filename() ? in.filename() : in.parent_path().filename();
  std::string name = "warped_" + file.string();
  if (std::filesystem::is_directory(in)) {
    return name + ".nii.gz";
  }
  const std::string_view ending = image_ending(file);
  if (!is_nifti_ending(ending) && !is_mgh_ending(ending)) {
    return name;
  }
  name.resize(name.size() - ending.size());
  return name + (ending == ".nii" ? ".nii" : ".nii.gz");
}

std::filesystem::path series_name(const std::filesystem::path& warped) {
  const std::filesystem::path name = warped.parent_path() / warped.stem();
  return name.extension() == ".nii" ? name.parent_path() / name.stem() : name;
}

}  // namespace brainshift::registration
