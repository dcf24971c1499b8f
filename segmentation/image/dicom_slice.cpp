// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/dicom_slice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <string_view>

#include "segmentation/files/refuse.hpp"
#include "segmentation/image/bytes.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t undefined_length = 0xffffffff;
constexpr std::uint64_t preamble = 132;

// Tags: group, element.
constexpr std::uint32_t transfer_syntax = 0x00020010;
constexpr std::uint32_t pixel_data = 0x7fe00010;
constexpr std::uint32_t groups_of_frames = 0x52009230;
constexpr std::uint32_t item = 0xfffee000, item_end = 0xfffee00d, sequence_end = 0xfffee0dd;

struct DicomElement {
  std::uint32_t tag = 0;
  std::string kind;  ///< the two letters of its value representation; empty where there are none
  std::uint32_t length = 0;
};

/// The elements of a file one after the other; no step goes behind the file's end.
class DicomReader {
 public:
  explicit DicomReader(const fs::path& file) : file_(file), in_(file, std::ios::binary), size_(fs::file_size(file)) {
    skip(preamble);
  }

  bool ended() const { return place_ >= size_; }
  std::uint64_t left() const { return size_ - place_; }
  const fs::path& file() const { return file_; }

  std::uint16_t next_group() {
    const auto group = number_at<std::uint16_t>(bytes(2), 0);
    place_ -= 2;
    in_.seekg(static_cast<std::streamoff>(place_));
    return group;
  }

  DicomElement next(bool with_kind) {
    DicomElement element;
    const auto head = bytes(8);
    element.tag =
        static_cast<std::uint32_t>(number_at<std::uint16_t>(head, 0)) << 16 | number_at<std::uint16_t>(head, 2);
    if (!with_kind || (element.tag >> 16) == (item >> 16)) {
      element.length = number_at<std::uint32_t>(head, 4);
      return element;
    }
    element.kind = {static_cast<char>(head[4]), static_cast<char>(head[5])};
    const bool is_long =
        std::string_view("OB OW OF OD OL OV SQ UC UN UR UT SV UV").find(element.kind) != std::string_view::npos;
    element.length = is_long ? number_at<std::uint32_t>(bytes(4), 0) : number_at<std::uint16_t>(head, 6);
    return element;
  }

  std::vector<std::uint8_t> bytes(std::uint64_t count) {
    need(count);
    std::vector<std::uint8_t> result(count);
    in_.read(reinterpret_cast<char*>(result.data()), static_cast<std::streamsize>(count));
    place_ += count;
    return result;
  }

  void skip(std::uint64_t count) {
    need(count);
    place_ += count;
    in_.seekg(static_cast<std::streamoff>(place_));
  }

 private:
  void need(std::uint64_t count) const {
    if (count > left()) {
      refuse(file_, "the DICOM slice is cut short, or its header is damaged; copy it again");
    }
  }

  fs::path file_;
  std::ifstream in_;
  std::uint64_t size_;
  std::uint64_t place_ = 0;
};

[[noreturn]] void refuse_field(const fs::path& file, const std::string& name) {
  refuse(file, "the DICOM slice has no " + name + " that can be used; copy it again, or leave it out of the folder");
}

void skip_value(DicomReader& reader, const DicomElement& element, bool with_kinds, int depth);

// Items, up to the mark of the sequence's end.
void skip_sequence(DicomReader& reader, bool with_kinds, int depth) {
  constexpr int deepest = 50;
  if (depth > deepest) {
    refuse(reader.file(), "the DICOM header's sequences lie within each other too deep; it is damaged, copy it again");
  }
  for (DicomElement part = reader.next(false); part.tag != sequence_end; part = reader.next(false)) {
    if (part.tag != item) {
      refuse(reader.file(), "the DICOM header is damaged within a sequence; copy the slice again");
    }
    if (part.length != undefined_length) {
      reader.skip(part.length);
      continue;
    }
    for (DicomElement inner = reader.next(with_kinds); inner.tag != item_end; inner = reader.next(with_kinds)) {
      skip_value(reader, inner, with_kinds, depth);
    }
  }
}

void skip_value(DicomReader& reader, const DicomElement& element, bool with_kinds, int depth) {
  if (element.length == undefined_length) {
    skip_sequence(reader, with_kinds && element.kind != "UN", depth + 1);
  } else {
    reader.skip(element.length);
  }
}

std::string dicom_text(const std::vector<std::uint8_t>& bytes) {
  const std::string text(bytes.begin(), bytes.end());
  constexpr std::string_view padding(" \0", 2);
  const std::size_t first = text.find_first_not_of(padding);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(padding) - first + 1);
}

/// A field that is taken from the header, by its tag.
struct DicomField {
  std::uint32_t tag;
  std::function<bool(DicomSlice&, const std::vector<std::uint8_t>&)> take;  ///< false when it is none
  const char* name;
};

DicomField whole_field(std::uint32_t tag, const char* name, std::uint64_t DicomSlice::*member) {
  return {tag,
          [member](DicomSlice& slice, const std::vector<std::uint8_t>& value) {
            if (value.size() != 2) {
              return false;
            }
            slice.*member = number_at<std::uint16_t>(value, 0);
            return true;
          },
          name};
}

DicomField real_field(std::uint32_t tag, const char* name, std::vector<double> DicomSlice::*member, std::size_t count) {
  return {tag,
          [member, count](DicomSlice& slice, const std::vector<std::uint8_t>& value) {
            slice.*member = dicom_numbers(dicom_text(value));
            return (slice.*member).size() == count;
          },
          name};
}

const std::vector<DicomField>& dicom_fields() {
  const auto is_number = [](DicomSlice&, const std::vector<std::uint8_t>& value) {
    return dicom_numbers(dicom_text(value)).size() == 1;
  };
  static const std::vector<DicomField> fields = {
      {0x0020000e,
       [](DicomSlice& slice, const std::vector<std::uint8_t>& value) {
         slice.series = dicom_text(value);
         return !slice.series.empty();
       },
       "SeriesInstanceUID"},
      {0x00280008,
       [](DicomSlice& slice, const std::vector<std::uint8_t>& value) {
         const auto frames = dicom_numbers(dicom_text(value));
         const bool is_count = frames.size() == 1 && frames[0] >= 1 && frames[0] < 1e6;
         slice.frames = is_count ? static_cast<std::uint64_t>(frames[0]) : 0;
         return is_count;
       },
       "NumberOfFrames"},
      {0x00281052, is_number, "RescaleIntercept"},
      {0x00281053, is_number, "RescaleSlope"},
      real_field(0x00200032, "ImagePositionPatient", &DicomSlice::position, 3),
      real_field(0x00200037, "ImageOrientationPatient", &DicomSlice::orientation, 6),
      real_field(0x00280030, "PixelSpacing", &DicomSlice::spacing, 2),
      whole_field(0x00280002, "SamplesPerPixel", &DicomSlice::samples),
      whole_field(0x00280010, "Rows", &DicomSlice::rows),
      whole_field(0x00280011, "Columns", &DicomSlice::columns),
      whole_field(0x00280100, "BitsAllocated", &DicomSlice::bits_allocated),
      whole_field(0x00280101, "BitsStored", &DicomSlice::bits_stored),
      whole_field(0x00280102, "HighBit", &DicomSlice::high_bit),
      whole_field(0x00280103, "PixelRepresentation", &DicomSlice::pixel_representation)};
  return fields;
}

// The group 2 at the begin. What it says of the rest: whether the elements name their kinds.
bool read_meta_group(DicomReader& reader) {
  std::string syntax = "1.2.840.10008.1.2";
  while (!reader.ended() && reader.next_group() == 2) {
    const DicomElement element = reader.next(true);
    if (element.tag == transfer_syntax && element.length <= 64) {
      syntax = dicom_text(reader.bytes(element.length));
    } else {
      skip_value(reader, element, true, 0);
    }
  }
  const bool implicit = syntax == "1.2.840.10008.1.2";
  const bool compressed = syntax.starts_with("1.2.840.10008.1.2.4.") || syntax == "1.2.840.10008.1.2.5";
  if (!implicit && !compressed && syntax != "1.2.840.10008.1.2.1") {
    refuse(reader.file(), "the DICOM slice is stored in a way (transfer syntax) that is not read; convert the series");
  }
  return !implicit;
}

void check_slice(const DicomSlice& slice) {
  const auto need = [&](bool holds, const char* name) {
    if (!holds) {
      refuse_field(slice.file, name);
    }
  };
  need(!slice.series.empty(), "SeriesInstanceUID");
  need(slice.rows > 0, "Rows");
  need(slice.columns > 0, "Columns");
  if (slice.bits_allocated == 1) {
    refuse(slice.file,
           "is a DICOM segmentation (1 bit a voxel), which is not read; convert it to .nii.gz or .seg.nrrd");
  }
  need(slice.bits_allocated == 8 || slice.bits_allocated == 16 || slice.bits_allocated == 32, "BitsAllocated");
  need(slice.bits_stored >= 1 && slice.bits_stored <= slice.bits_allocated, "BitsStored");
  need(slice.high_bit + 1 == slice.bits_stored || slice.high_bit + 1 == slice.bits_allocated, "HighBit");
  need(slice.pixel_representation <= 1, "PixelRepresentation");
  if (slice.samples != 1) {
    refuse(slice.file, "the DICOM slice holds " + std::to_string(slice.samples) +
                           " values a pixel, one is needed; choose a series of grey values");
  }
  if (slice.frames == 1 && !slice.in_groups) {
    need(slice.spacing.size() == 2, "PixelSpacing");
    need(slice.orientation.size() == 6, "ImageOrientationPatient");
    need(slice.position.size() == 3, "ImagePositionPatient");
  }
}

void check_pixels(DicomReader& reader, const DicomElement& element, const DicomSlice& slice) {
  if (element.length == undefined_length) {
    skip_sequence(reader, false, 0);
    return;
  }
  const std::uint64_t expected = slice.rows * slice.columns * slice.frames * slice.bits_allocated / 8;
  const std::uint64_t found = std::min<std::uint64_t>(element.length, reader.left());
  if (found < expected || element.length > reader.left()) {
    refuse(slice.file, "truncated: the DICOM slice promises " + std::to_string(expected) +
                           " bytes of pixels, the file holds " + std::to_string(found) + "; copy it again");
  }
}

}  // namespace

std::vector<double> dicom_numbers(const std::string& text) {
  std::vector<double> values;
  std::string rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\\'), rest.size());
    const std::string field = rest.substr(0, end);
    const std::size_t first = std::min(field.find_first_not_of(" +"), field.size());
    const std::size_t last = field.find_last_not_of(' ') + 1;
    double value = 0;
    const auto [stop, fault] = std::from_chars(field.data() + first, field.data() + std::max(first, last), value);
    if (fault != std::errc{} || stop != field.data() + std::max(first, last) || !std::isfinite(value)) {
      return {};
    }
    values.push_back(value);
    rest.erase(0, end + 1);
  }
  return values;
}

bool is_dicom_slice(const fs::path& file) {
  std::error_code fault;
  if (!fs::is_regular_file(file, fault)) {
    return false;
  }
  std::array<char, preamble> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  return in.gcount() == static_cast<std::streamsize>(head.size()) && std::string_view(head.data() + 128, 4) == "DICM" &&
         file.filename() != "DICOMDIR";
}

DicomSlice read_dicom_slice(const fs::path& file) {
  DicomSlice slice;
  slice.file = file;
  DicomReader reader(file);
  const bool with_kinds = read_meta_group(reader);
  while (!reader.ended()) {
    const DicomElement element = reader.next(with_kinds);
    if (element.tag == pixel_data) {
      check_slice(slice);
      check_pixels(reader, element, slice);
      return slice;
    }
    slice.in_groups = slice.in_groups || element.tag == groups_of_frames;
    const auto& fields = dicom_fields();
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const DicomField& known) { return known.tag == element.tag; });
    constexpr std::uint32_t longest = 1024;
    if (field == fields.end() || element.length == 0) {
      skip_value(reader, element, with_kinds, 0);
    } else if (element.length > longest || !field->take(slice, reader.bytes(element.length))) {
      refuse_field(file, field->name);
    }
  }
  refuse(file, "the DICOM slice ends before its pixels; copy it again, or leave it out of the folder");
}

}  // namespace brainshift
