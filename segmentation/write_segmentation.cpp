// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/segment.hpp"

namespace brainshift::segmentation {

void write_segmentation(const std::filesystem::path& folder, const Segmentation& segmentation) {
  make_folder(folder);
  if (segmentation.labels) {
    write_image(folder / "labels.nii.gz", *segmentation.labels);
  }
  if (segmentation.closed) {
    write_image(folder / "closed.nii.gz", *segmentation.closed);
  }
  write_surface(folder / "brain.vtp", segmentation.brain);
  write_surface(folder / "skull.vtp", segmentation.skull);
  for (const auto& [label, surface] : segmentation.tissues) {
    write_surface(folder / ("tissue_" + std::to_string(label) + ".vtp"), surface);
  }
  for (std::size_t c = 0; c < segmentation.memberships.size(); ++c) {
    write_image(folder / ("membership_" + std::to_string(c) + ".nii.gz"), segmentation.memberships[c]);
  }
}

}  // namespace brainshift::segmentation
