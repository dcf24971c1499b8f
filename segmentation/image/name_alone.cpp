// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/name_alone.hpp"

#include <cstdlib>
#include <system_error>

#include "segmentation/files/refuse.hpp"

namespace brainshift {

namespace fs = std::filesystem;

NameAlone::NameAlone(const fs::path& file, ImageFormat format) : name_(file) {
  std::error_code fault;
  const fs::path beside = fs::path(file).replace_extension();
  if (format != ImageFormat::nifti_gz || !fs::exists(beside, fault)) {
    return;
  }
  std::string folder = (fs::temp_directory_path(fault) / "brainshift-image-XXXXXX").string();
  if (!fault && mkdtemp(folder.data()) != nullptr) {
    folder_ = folder;
    name_ = folder_ / "image.nii.gz";
    fs::create_symlink(fs::absolute(file), name_, fault);
  }
  if (fault || folder_.empty()) {
    remove();
    refuse(file, "cannot be told from " + beside.string() +
                     " beside it, as no link can be made in the folder for "
                     "temporary files; set TMPDIR, or move one of the two");
  }
}

void NameAlone::remove() const {
  std::error_code ignored;
  if (!folder_.empty()) {
    fs::remove_all(folder_, ignored);
  }
}

}  // namespace brainshift
