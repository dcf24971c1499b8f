// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/dicom_series.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <fstream>
#include <set>

#include "segmentation/files/refuse.hpp"
#include "segmentation/image/dicom_frames.hpp"
#include "segmentation/image/dicom_slice.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> dicom_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder, fault)) {
    std::error_code none;
    if (is_dicom_slice(entry.path())) {
      files.push_back(entry.path());
    } else if (entry.is_symlink(none) && !fs::exists(entry.path(), none)) {
      refuse(entry.path(), "is a link to no file; fetch what it names (as 'datalad get' does), or remove it");
    } else if (fs::is_regular_file(entry.path(), none) && !std::ifstream(entry.path())) {
      refuse(entry.path(), "cannot be read, and may be a slice; change its permissions, or move it elsewhere");
    }
  }
  if (fault) {
    refuse(folder, "the folder cannot be listed (" + fault.message() + "); change its permissions");
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<DicomSlice> read_slices(const fs::path& folder) {
  std::vector<DicomSlice> slices;
  std::set<std::string> series;
  for (const fs::path& file : dicom_files(folder)) {
    slices.push_back(with_place(read_dicom_slice(file)));
    series.insert(slices.back().series);
  }
  if (series.empty()) {
    refuse(folder, "is a folder with no DICOM file (DICM at byte 128); name the folder of one DICOM series, or a file");
  }
  if (series.size() != 1) {
    refuse(folder, "a folder with exactly one DICOM series is needed, this one holds " + std::to_string(series.size()));
  }
  return slices;
}

bool close(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double tolerance = 1e-4;
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::abs(x - y) <= tolerance * std::max(1.0, std::abs(x));
         });
}

// Slope and intercept, which may be of any size: to a thousandth of the last bit of a value of 16 bits.
bool rescaled_alike(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double tolerance = 1e-8;
  return a.size() == b.size() && (a.size() != 2 || (std::abs(a[0] - b[0]) <= tolerance * std::abs(a[0]) &&
                                                    std::abs(a[1] - b[1]) <= 1e-3 * std::abs(a[0])));
}

std::string name_of(const DicomSlice& slice) {
  return slice.frame > 0 ? "frame " + std::to_string(slice.frame) : slice.file.filename().string();
}

void check_alike(const DicomSlice& slice, const DicomSlice& first) {
  const auto need = [&](bool same, const std::string& name) {
    if (!same) {
      refuse(slice.file, (slice.frame > 0 ? "the " + name + " of " + name_of(slice) : "its " + name) +
                             " is not that of " + name_of(first) +
                             ", another slice of the series; one of the two is damaged or of another scan");
    }
  };
  need(slice.rows == first.rows, "Rows");
  need(slice.columns == first.columns, "Columns");
  need(slice.bits_allocated == first.bits_allocated, "BitsAllocated");
  need(slice.pixel_representation == first.pixel_representation, "PixelRepresentation");
  need(close(slice.spacing, first.spacing), "PixelSpacing");
  need(close(slice.orientation, first.orientation), "ImageOrientationPatient");
  need(rescaled_alike(slice.rescale, first.rescale), "RescaleSlope or RescaleIntercept");
  if (slice.frames != 1) {
    refuse(slice.file, "holds " + std::to_string(slice.frames) +
                           " frames and is not alone in its folder; leave it alone there, or take single slices");
  }
}

Eigen::Vector3d position_of(const DicomSlice& slice) {
  return Eigen::Vector3d::Map(slice.position.data());
}

/// Sorts the slices along the normal; the distance of two neighbours. Places that are rounded to a tenth of a
/// millimetre are taken for even and upright.
double in_order(const fs::path& folder, std::vector<DicomSlice>& slices, const Eigen::Vector3d& normal) {
  const auto height = [&](const DicomSlice& slice) { return normal.dot(position_of(slice)); };
  std::sort(slices.begin(), slices.end(),
            [&](const DicomSlice& a, const DicomSlice& b) { return height(a) < height(b); });
  const auto count = static_cast<double>(slices.size() - 1);
  const Eigen::Vector3d step =
      slices.size() > 1 ? Eigen::Vector3d((position_of(slices.back()) - position_of(slices.front())) / count) : normal;
  const double distance = step.norm();
  constexpr double most_off = 0.2;  // mm
  const double tolerance = std::min(0.1 * distance, most_off);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Eigen::Vector3d even = position_of(slices.front()) + static_cast<double>(i) * step;
    const double off = (position_of(slices[i]) - even).norm();
    if (!(distance > 0) || !(off <= tolerance)) {
      refuse(folder, "the DICOM slices are not evenly spaced (" + name_of(slices[i]) + " is off by " +
                         std::to_string(off) + " mm); is a slice missing, or there twice?");
    }
  }
  const double shifted = count * (step - step.dot(normal) * normal).norm();
  if (!(shifted <= most_off)) {
    refuse(folder, "the DICOM slices are shifted against each other, the last by " + std::to_string(shifted) +
                       " mm, as by a tilted gantry; resample the series");
  }
  return distance;
}

}  // namespace

DicomSeries read_dicom_series(const fs::path& folder) {
  std::vector<DicomSlice> slices = read_slices(folder);
  const bool one_file = slices.size() == 1 && slices.front().frames > 1;
  if (one_file) {
    slices = frames_of(slices.front());
  }
  const DicomSlice first = slices.front();
  for (const DicomSlice& slice : slices) {
    check_alike(slice, first);
  }
  DicomSeries series;
  series.header.size = {first.columns, first.rows, slices.size()};
  series.header.bytes_a_value = first.bits_allocated / 8;
  const Eigen::Vector3d row = Eigen::Vector3d::Map(first.orientation.data());
  const Eigen::Vector3d column = Eigen::Vector3d::Map(first.orientation.data() + 3);
  series.header.direction << row, column, row.cross(column);
  check_volume(first.file, series.header, 1);  // sorting needs a direction
  const double distance = in_order(folder, slices, series.header.direction.col(2));
  series.header.spacing = Eigen::Vector3d(first.spacing[1], first.spacing[0], distance);
  series.header.origin = position_of(slices.front());
  check_volume(folder, series.header, 1);
  for (const DicomSlice& slice : slices) {
    if (one_file) {
      series.frames.push_back(slice.frame - 1);
    } else {
      series.files.push_back(slice.file.string());
    }
  }
  if (one_file) {
    series.files.push_back(first.file.string());
  }
  return series;
}

}  // namespace brainshift
