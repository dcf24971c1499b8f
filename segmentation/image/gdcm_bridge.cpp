// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/gdcm_bridge.hpp"

#include <gdcmDicts.h>
#include <gdcmFileExplicitFilter.h>
#include <gdcmGlobal.h>
#include <gdcmReader.h>
#include <gdcmSHA1.h>
#include <gdcmSystem.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "segmentation/files/refuse.hpp"

namespace brainshift::dicom {

using gdcm::DataSet;
using gdcm::Tag;
using gdcm::VR;

void set(DataSet& header, const Tag& tag, std::string value) {
  const VR listed = gdcm::Global::GetInstance().GetDicts().GetDictEntry(tag).GetVR();
  const VR kind = listed == VR::OB_OW ? VR(VR::OW) : listed;  // of pixels the dictionary has both
  if (value.size() % 2 != 0) {
    value += kind == VR::UI ? '\0' : ' ';  // every value has an even length (PS3.5, 7.1.1)
  }
  gdcm::DataElement element(tag);
  element.SetVR(kind);
  element.SetByteValue(value.data(), static_cast<std::uint32_t>(value.size()));
  header.Replace(element);
}

void set_if_absent(DataSet& header, const Tag& tag, const std::string& value) {
  if (!header.FindDataElement(tag)) {
    set(header, tag, value);
  }
}

void set_number(DataSet& header, const Tag& tag, std::uint16_t value) {
  set(header, tag, {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)});
}

std::string text_of(const DataSet& header, const Tag& tag) {
  const gdcm::ByteValue* const value =
      header.FindDataElement(tag) ? header.GetDataElement(tag).GetByteValue() : nullptr;
  std::string text = value == nullptr ? "" : std::string(value->GetPointer(), value->GetLength());
  text.erase(text.find_last_not_of(std::string_view(" \0", 2)) + 1);
  return text;
}

std::string decimal(double value) {
  constexpr std::ptrdiff_t longest = 16;
  std::array<char, 32> text{};
  const char* end = nullptr;
  for (int digits = 15; end == nullptr || end - text.data() > longest; --digits) {
    end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  }
  return {text.data(), static_cast<std::size_t>(end - text.data())};
}

double rounded_to_decimal(double value) {
  const std::string text = decimal(value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += text.empty() ? "" : "\\";
    text += decimal(value);
  }
  return text;
}

gdcm::File read_header(const std::filesystem::path& file) {
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  gdcm::FileExplicitFilter with_kinds;
  if (reader.ReadUpToTag(pixel_data)) {
    with_kinds.SetFile(reader.GetFile());
    if (with_kinds.Change()) {
      return with_kinds.GetFile();
    }
  }
  refuse(file, "the DICOM header cannot be read; copy the slice again");
}

std::string uid_of(const std::string& name) {
  std::array<char, 41> hex{};
  if (!gdcm::SHA1::Compute(name.data(), name.size(), hex.data())) {
    throw std::logic_error("GDCM was built without SHA-1");
  }
  std::array<unsigned char, 16> uuid{};
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    uuid[i] = static_cast<unsigned char>(std::stoi(std::string(hex.data() + 2 * i, 2), nullptr, 16));
  }
  uuid[6] = static_cast<unsigned char>((uuid[6] & 0x0f) | 0x50);
  uuid[8] = static_cast<unsigned char>((uuid[8] & 0x3f) | 0x80);
  std::array<char, 64> digits{};
  const std::size_t count = gdcm::System::EncodeBytes(digits.data(), uuid.data(), uuid.size());
  std::string uid("2.25.");
  return uid.append(digits.data(), count);
}

}  // namespace brainshift::dicom
