// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: a name by which ITK reads one file alone.

#include <filesystem>
#include <string>

#include "segmentation/image/image_format.hpp"

namespace brainshift {

/// Of NAME.nii.gz the library takes the voxels from NAME.nii where that lies beside it. While it lives, this is a link
/// in a folder of its own then, else the file's own name.
class NameAlone {
 public:
  /// Throws std::invalid_argument, naming the file, where no link can be made.
  NameAlone(const std::filesystem::path& file, ImageFormat format);
  ~NameAlone() { remove(); }
  NameAlone(const NameAlone&) = delete;
  NameAlone& operator=(const NameAlone&) = delete;

  std::string name() const { return name_.string(); }

 private:
  void remove() const;

  std::filesystem::path name_, folder_;
};

}  // namespace brainshift
