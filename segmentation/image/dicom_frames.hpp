// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: where the frames of one DICOM file lie (enhanced objects, DICOM PS3.3, C.7.6.16).

#include <vector>

#include "segmentation/image/dicom_slice.hpp"

namespace brainshift {

/// Each frame as a slice of its own, in the order in which the file holds them. What its functional groups tell goes
/// before what those that all frames share do. Throws std::invalid_argument, naming the file and the frame, where
/// position, orientation or spacing of a frame is not told: which place a frame without them has is not known.
std::vector<DicomSlice> frames_of(const DicomSlice& whole);

/// A slice as it is, or that of a file of one frame with the place that its functional groups tell.
DicomSlice with_place(const DicomSlice& slice);

}  // namespace brainshift
