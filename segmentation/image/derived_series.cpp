// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/derived_series.hpp"

#include <gdcmImageHelper.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/image/dicom_series.hpp"
#include "segmentation/image/gdcm_bridge.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;
using namespace dicom;
using gdcm::DataSet;
using gdcm::Tag;

constexpr const char* mr_image_storage = "1.2.840.10008.5.1.4.1.1.4";
const Tag study_uid(0x0020, 0x000d), series_uid(0x0020, 0x000e), frame_of_reference_uid(0x0020, 0x0052);
const Tag sop_class_uid(0x0008, 0x0016), sop_instance_uid(0x0008, 0x0018);

/// What of a source's header is as true of what is derived from it: who and where the patient is, how the scanner
/// measured, how bright the image is shown.
bool is_kept(const Tag& tag) {
  constexpr std::uint16_t patient = 0x0010, trial = 0x0012;  // the latter says, too, that the patient has no name here
  constexpr auto kept = std::to_array<std::uint32_t>(
      {// character set, study, acquisition
       0x00080005, 0x00080020, 0x00080022, 0x0008002a, 0x00080030, 0x00080032, 0x00080050, 0x00080051, 0x00080080,
       0x00080090, 0x00080201, 0x00081030, 0x00081032, 0x00081040, 0x00081048, 0x00181030, 0x00200012,
       // contrast agent, body part, sequence of the scanner, its times and angles
       0x00180010, 0x00180015, 0x00180020, 0x00180021, 0x00180022, 0x00180023, 0x00180024, 0x00180025, 0x00180080,
       0x00180081, 0x00180082, 0x00180083, 0x00180084, 0x00180085, 0x00180087, 0x00180091, 0x00180095, 0x00181314,
       0x00185100,
       // UIDs of study and frame of reference
       0x0020000d, 0x00200010, 0x00200052, 0x00201040,
       // window, lossy compression
       0x00281050, 0x00281051, 0x00281055, 0x00281056, 0x00282110, 0x00282112, 0x00282114});
  return tag.GetGroup() == patient || tag.GetGroup() == trial ||
         std::find(kept.begin(), kept.end(), tag.GetElementTag()) != kept.end();
}

/// What all slices of the new series share, but for the pixels' and the series' own. Elements of type 1 and 2 that the
/// source lacks, as one of many frames does, are filled in as the standard asks.
DataSet common_header(const DataSet& source, const Derivation& derivation) {
  DataSet header;
  for (const gdcm::DataElement& element : source.GetDES()) {
    if (is_kept(element.GetTag())) {
      header.Insert(element);
    }
  }
  for (const std::uint32_t tag :
       {0x00080020, 0x00080030, 0x00080050, 0x00080090, 0x00100010, 0x00100020, 0x00100030, 0x00100040, 0x00180022,
        0x00180023, 0x00180080, 0x00180081, 0x00180091, 0x00185100, 0x00200010, 0x00200060, 0x00201040}) {
    set_if_absent(header, Tag(tag), "");
  }
  set_if_absent(header, Tag(0x0018, 0x0020), "RM");  // a sequence that nobody names: research mode
  set_if_absent(header, Tag(0x0018, 0x0021), "NONE");
  const std::string number = text_of(source, Tag(0x0020, 0x0011));
  constexpr long beside_the_scanners = 1000;
  set(header, Tag(0x0020, 0x0011),
      number.empty() ? "" : std::to_string(std::atol(number.c_str()) + beside_the_scanners));
  set(header, sop_class_uid, mr_image_storage);
  set(header, Tag(0x0008, 0x0008), "DERIVED\\SECONDARY\\OTHER");
  set(header, Tag(0x0008, 0x0060), "MR");
  set(header, Tag(0x0008, 0x0070), "brainshift");
  set(header, Tag(0x0008, 0x103e), derivation.series);
  set(header, Tag(0x0008, 0x2111), derivation.description);
  return header;
}

/// The SourceImageSequence: every slice of the source, as tissue moves from one to others.
gdcm::DataElement sources_of(const DicomSeries& series) {
  const gdcm::SmartPointer<gdcm::SequenceOfItems> sources = new gdcm::SequenceOfItems();
  sources->SetLengthToUndefined();
  for (const std::string& file : series.files) {
    const gdcm::File slice = read_header(file);
    gdcm::Item item;
    item.SetVLToUndefined();
    for (const auto& [from, to] :
         {std::pair(sop_class_uid, Tag(0x0008, 0x1150)), std::pair(sop_instance_uid, Tag(0x0008, 0x1155))}) {
      set(item.GetNestedDataSet(), to, text_of(slice.GetDataSet(), from));
    }
    sources->AddItem(item);
  }
  gdcm::DataElement element(Tag(0x0008, 0x2112));
  element.SetVR(gdcm::VR::SQ);
  element.SetValue(*sources);
  element.SetVLToUndefined();
  return element;
}

/// The voxels in 16 bits: value = slope * stored + intercept.
struct Stored {
  double slope = 1, intercept = 0;
  bool with_sign = false;
  std::string bytes;  ///< little endian
};

/// Whether each value has a whole number of the type nearest to it, and the bytes of those.
template <class Number>
bool fits(const ScalarImage& image, Stored& stored) {
  stored.with_sign = std::is_signed_v<Number>;
  stored.bytes.clear();
  stored.bytes.reserve(2 * image.voxels.size());
  for (const float value : image.voxels) {
    const double number = std::round((double{value} - stored.intercept) / stored.slope);
    if (number < std::numeric_limits<Number>::min() || number > std::numeric_limits<Number>::max()) {
      return false;
    }
    const auto bits = static_cast<std::uint16_t>(static_cast<Number>(number));
    stored.bytes += {static_cast<char>(bits & 0xff), static_cast<char>(bits >> 8)};
  }
  return true;
}

Stored store(const ScalarImage& image, const gdcm::File& source) {
  const std::vector<double> rescale = gdcm::ImageHelper::GetRescaleInterceptSlopeValue(source);
  Stored stored;
  stored.intercept = rounded_to_decimal(rescale[0]);  // as the header will have them
  stored.slope = rounded_to_decimal(rescale[1]);
  if (stored.slope > 0 && (fits<std::uint16_t>(image, stored) || fits<std::int16_t>(image, stored))) {
    return stored;
  }
  const auto [low, high] = std::minmax_element(image.voxels.begin(), image.voxels.end());
  constexpr double steps = 65000;  // room for what the header rounds off
  stored.intercept = rounded_to_decimal(*low);
  stored.slope = rounded_to_decimal(std::max((double{*high} - *low) / steps, 1e-12));
  if (!fits<std::uint16_t>(image, stored)) {
    throw std::logic_error("the image's values do not fit its own range");
  }
  return stored;
}

void set_grid_and_type(DataSet& header, const ImageGeometry& grid, const Stored& stored) {
  const Eigen::Vector3d row = grid.direction.col(0), column = grid.direction.col(1);
  set(header, Tag(0x0018, 0x0050), decimal(grid.spacing.z()));
  set(header, Tag(0x0018, 0x0088), decimal(grid.spacing.z()));
  set(header, Tag(0x0020, 0x0037), decimals({row.x(), row.y(), row.z(), column.x(), column.y(), column.z()}));
  set_number(header, Tag(0x0028, 0x0002), 1);
  set(header, Tag(0x0028, 0x0004), "MONOCHROME2");
  set_number(header, Tag(0x0028, 0x0010), static_cast<std::uint16_t>(grid.size.y()));
  set_number(header, Tag(0x0028, 0x0011), static_cast<std::uint16_t>(grid.size.x()));
  set(header, Tag(0x0028, 0x0030), decimals({grid.spacing.y(), grid.spacing.x()}));
  set_number(header, Tag(0x0028, 0x0100), 16);
  set_number(header, Tag(0x0028, 0x0101), 16);
  set_number(header, Tag(0x0028, 0x0102), 15);
  set_number(header, Tag(0x0028, 0x0103), stored.with_sign ? 1 : 0);
  if (stored.slope != 1 || stored.intercept != 0) {  // MR images need not have them
    set(header, Tag(0x0028, 0x1052), decimal(stored.intercept));
    set(header, Tag(0x0028, 0x1053), decimal(stored.slope));
    set(header, Tag(0x0028, 0x1054), "US");
  }
}

void write_slice(const fs::path& file, const DataSet& header) {
  gdcm::Writer writer;
  writer.GetFile().SetDataSet(header);
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  writer.SetFileName(file.c_str());
  if (!writer.Write()) {
    throw std::runtime_error("cannot be written");
  }
}

void write_slices(const fs::path& folder, DataSet header, const ImageGeometry& grid, const Stored& stored,
                  const std::string& series) {
  set(header, series_uid, series);
  const std::size_t size = 2 * static_cast<std::size_t>(grid.size.x()) * static_cast<std::size_t>(grid.size.y());
  for (int k = 0; k < grid.size.z(); ++k) {
    const std::string number = std::to_string(k + 1);
    const Eigen::Vector3d place = grid.to_world({0, 0, static_cast<double>(k)});
    set(header, sop_instance_uid, uid_of(series + " " + number));
    set(header, Tag(0x0020, 0x0013), number);
    set(header, Tag(0x0020, 0x0032), decimals({place.x(), place.y(), place.z()}));
    set(header, pixel_data, stored.bytes.substr(static_cast<std::size_t>(k) * size, size));
    constexpr std::size_t digits = 4;
    write_slice(folder / (std::string(digits - std::min(digits, number.size()), '0') + number + ".dcm"), header);
  }
}

/// All that the series holds beside its source's header.
std::string name_of(const std::string& source, const Derivation& derivation, const ImageGeometry& grid,
                    const Stored& stored) {
  std::string name = source + derivation.series + derivation.description + stored.bytes;
  for (const double number : {stored.slope, stored.intercept}) {
    name += decimal(number) + " ";
  }
  for (const Eigen::Vector3d& vector :
       {grid.spacing, grid.origin, Eigen::Vector3d(grid.direction.col(0)), Eigen::Vector3d(grid.direction.col(1)),
        Eigen::Vector3d(grid.direction.col(2))}) {
    name += decimals({vector.x(), vector.y(), vector.z()}) + " ";
  }
  return name;
}

}  // namespace

std::string write_derived_series(const fs::path& folder, const ScalarImage& image, const fs::path& source,
                                 const Derivation& derivation) {
  const DicomSeries series = read_dicom_series(source);
  const gdcm::File first = read_header(series.files.front());
  const DataSet& header = first.GetDataSet();
  if (text_of(header, Tag(0x0008, 0x0060)) != "MR") {
    return "the source is no MR";
  }
  for (const auto& [tag, what] :
       {std::pair(study_uid, "study"), std::pair(frame_of_reference_uid, "frame of reference"),
        std::pair(sop_instance_uid, "slices")}) {
    if (text_of(header, tag).empty()) {
      return std::string("the source does not say the UID of its ") + what;
    }
  }
  DataSet common = common_header(header, derivation);
  common.Replace(sources_of(series));
  const Stored stored = store(image, first);
  set_grid_and_type(common, image.geometry, stored);
  make_folder(folder);
  try {
    write_slices(folder, common, image.geometry, stored,
                 uid_of(name_of(text_of(header, series_uid), derivation, image.geometry, stored)));
    read_dicom_series(folder);  // what was written must be there
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    fail_to_write(folder);
  }
  return {};
}

}  // namespace brainshift
