// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/segments.hpp"

#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>

#include <optional>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/image/image_header.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> text_of(const itk::MetaDataDictionary& keys, const std::string& key) {
  std::string text;
  return itk::ExposeMetaData<std::string>(keys, key, text) ? std::optional(text) : std::nullopt;
}

// Without the key it is what 3D Slicer takes then.
template <class Number>
Number number_of(const fs::path& file, const itk::MetaDataDictionary& keys, const std::string& key, Number otherwise) {
  const auto text = text_of(keys, key);
  const auto number = text ? read_number<Number>(*text) : std::optional(otherwise);
  if (!number) {
    refuse(file, "the header's " + key + " is '" + *text + "', where a whole number is expected; repair the header");
  }
  return *number;
}

void check_numbers(const fs::path& file, const itk::MetaDataDictionary& keys) {
  for (const char* key : {"Segmentation_SourceRepresentation", "Segmentation_MasterRepresentation"}) {
    if (text_of(keys, key).value_or("").starts_with("Fractional")) {
      refuse(file, "holds fractional segments, shares of a voxel; save it as a binary labelmap");
    }
  }
}

std::vector<Segment> segments_in(const fs::path& file, const itk::MetaDataDictionary& keys, std::size_t layers) {
  std::vector<Segment> segments;
  while (true) {
    const std::string prefix = "Segment" + std::to_string(segments.size()) + "_";
    const auto name = text_of(keys, prefix + "Name");
    if (!name) {
      return segments;
    }
    // Files of old have no layers named: each segment has one of its own, which holds 1.
    const std::size_t usual = layers == 1 ? 0 : segments.size();
    segments.push_back({.name = *name,
                        .label = number_of<std::uint16_t>(file, keys, prefix + "LabelValue", 1),
                        .layer = number_of<std::size_t>(file, keys, prefix + "Layer", usual)});
    if (segments.back().layer >= layers) {
      refuse(file, "the segment '" + *name + "' lies in layer " + std::to_string(segments.back().layer) +
                       ", counted from 0, of " + std::to_string(layers) + "; save the segmentation again");
    }
  }
}

}  // namespace

std::vector<Segment> read_segments(const fs::path& file) {
  std::error_code unknown;
  if (ending_of(file) != ".nrrd" || fs::is_directory(file, unknown)) {
    return {};
  }
  check_readable(file);
  const ImageHeader header = read_nrrd_header(file);
  auto io = itk::NrrdImageIO::New();
  io->SetFileName(file.string());
  try {
    io->ReadImageInformation();
  } catch (const itk::ExceptionObject&) {
    refuse(file, "its header cannot be read; copy the file again");
  }
  const itk::MetaDataDictionary& keys = io->GetMetaDataDictionary();
  auto segments = segments_in(file, keys, header.components);
  if (!segments.empty()) {
    check_numbers(file, keys);
  }
  return segments;
}

}  // namespace brainshift
