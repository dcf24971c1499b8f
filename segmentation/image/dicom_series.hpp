// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: which files of a folder are the slices of its one DICOM series.

#include <string>

#include "segmentation/image/image_header.hpp"

namespace brainshift {

struct DicomSeries {
  std::vector<std::string> files;   ///< in the order of their places
  std::vector<std::size_t> frames;  ///< of one file that holds all slices: in the order of their places; else empty
  ImageHeader header;               ///< of the volume
};

/// Files that are no DICOM are passed over. Throws std::invalid_argument, naming folder or slice, when there is not
/// exactly one series, a slice is damaged, or the slices, or frames of one file, differ in size, spacing, orientation
/// or kind of pixel, are not evenly spaced or do not lie one behind the other.
DicomSeries read_dicom_series(const std::filesystem::path& folder);

}  // namespace brainshift
