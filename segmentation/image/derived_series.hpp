// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "segmentation/image/image.hpp"

namespace brainshift {

/// What a DICOM series says of how it came from another.
struct Derivation {
  std::string series;       ///< SeriesDescription, ASCII, at most 64 characters
  std::string description;  ///< DerivationDescription, ASCII, at most 1024 characters
};

/// Writes an image as a new MR series, a slice a file (0001.dcm, ...), into a folder that it makes. Patient, study,
/// frame of reference and what is known of the acquisition are those of the series in the folder `source`, whose
/// slices it names as the sources (DICOM PS3.3 C.7.6.1, C.8.3.1). Its UIDs follow from what it holds: equal images of
/// one source make equal files. Values are stored in 16 bits in steps of the source's, wider ones where its range needs
/// them, and come back to half a step.
///
/// Returns why the source cannot have such a series, and then writes nothing: it is no MR, or lacks the UID of its
/// study or frame of reference. Empty when the series was written. Throws std::invalid_argument, naming the file, when
/// the source cannot be read and std::runtime_error, naming the folder, when the series cannot be written whole.
std::string write_derived_series(const std::filesystem::path& folder, const ScalarImage& image,
                                 const std::filesystem::path& source, const Derivation& derivation);

}  // namespace brainshift
