// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warped_series.hpp"

#include "segmentation/image/derived_series.hpp"

namespace brainshift::registration {

std::string write_warped_series(const std::filesystem::path& folder, const ScalarImage& warped,
                                const std::filesystem::path& source, Towards towards) {
  const std::string brain = towards == Towards::intraop ? "intraop" : "preop";
  return write_derived_series(
      folder, warped, source,
      {.series = "Warped to " + brain + " by brainshift, NOT FOR DIAGNOSIS",
       .description = "Resampled by a displacement field that brainshift computed by mechanics, to match the " + brain +
                      " brain. No new measurement; what the source image does not show is not in it. Research "
                      "software: not for diagnosis."});
}

}  // namespace brainshift::registration
