// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: what a DICOM file says of its slice, read by us before a library sees the file.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brainshift {

struct DicomSlice {
  std::filesystem::path file;
  std::string series;  ///< SeriesInstanceUID
  std::uint64_t rows = 0, columns = 0, frames = 1, samples = 1;
  std::uint64_t bits_allocated = 0, bits_stored = 0, high_bit = 0, pixel_representation = 0;
  std::vector<double> spacing;      ///< PixelSpacing: between rows, between columns, mm
  std::vector<double> orientation;  ///< ImageOrientationPatient: along a row, along a column
  std::vector<double> position;     ///< ImagePositionPatient, mm, LPS
  std::vector<double> rescale;      ///< RescaleSlope, RescaleIntercept; of a frame alone
  std::uint64_t frame = 0;          ///< of a file of several, from 1; 0: the file is a slice
  bool in_groups = false;           ///< it has functional groups, which may tell the place of a frame

  bool is_placed() const { return spacing.size() == 2 && orientation.size() == 6 && position.size() == 3; }
};

/// Whether the file is a regular one with DICM at byte 128, and no directory of others (DICOMDIR).
bool is_dicom_slice(const std::filesystem::path& file);

/// Throws std::invalid_argument, naming the file, when it is cut short, in its header or its pixels, or a field cannot
/// be. Where it has functional groups, dicom_frames.hpp tells where its frames lie.
DicomSlice read_dicom_slice(const std::filesystem::path& file);

/// Decimal numbers between backslashes; empty where one of them is none.
std::vector<double> dicom_numbers(const std::string& text);

}  // namespace brainshift
