// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/gii_claims.hpp"

#include <expat.h>

#include <charconv>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <type_traits>

#include "segmentation/files/bytes_of_file.hpp"
#include "segmentation/files/deflated.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

using Attributes = std::map<std::string, std::string>;

/// What the file says; a fault found on the way is told when the parser is done, as nothing may be thrown through it.
struct Claims {
  double most = 0;  ///< numbers that a file of its length can hold
  int arrays = 0;
  std::string fault = {};
};

bool is_one_of(const Attributes& attributes, const std::string& name, const std::set<std::string>& values) {
  const auto found = attributes.find(name);
  return found != attributes.end() && values.contains(found->second);
}

/// A size as GIFTI writes it; none where it is no number >= 1.
double size_of(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  const std::string text = found == attributes.end() ? "" : found->second;
  int size = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), size);
  const bool whole = fault == std::errc{} && end == text.data() + text.size() && size >= 1;
  return whole ? size : std::numeric_limits<double>::quiet_NaN();
}

std::string fault_of(const Attributes& array, double most) {
  if (is_one_of(array, "Encoding", {"ExternalFileBinary"})) {
    return "keeps its numbers in another file; save it again with all in one file";
  }
  const bool known = is_one_of(array, "Encoding", {"ASCII", "Base64Binary", "GZipBase64Binary"}) &&
                     is_one_of(array, "Endian", {"BigEndian", "LittleEndian"}) &&
                     is_one_of(array, "ArrayIndexingOrder", {"RowMajorOrder", "ColumnMajorOrder"}) &&
                     is_one_of(array, "DataType",
                               {"NIFTI_TYPE_UINT8", "NIFTI_TYPE_INT32", "NIFTI_TYPE_FLOAT32", "NIFTI_TYPE_FLOAT64",
                                "NIFTI_TYPE_RGB24"});
  const double axes = size_of(array, "Dimensionality");
  double numbers = 1;
  for (int axis = 0; axis < axes && axis < 6; ++axis) {
    numbers *= size_of(array, "Dim" + std::to_string(axis));
  }
  if (!known || !(axes <= 6) || !(numbers >= 1)) {
    return "one of its arrays has an encoding, a type or a size that is none; it is damaged, copy it again";
  }
  return numbers <= most ? "" : "an array of it says that it is larger than the file; it is damaged, copy it again";
}

void look_at_element(void* user_data, const XML_Char* name, const XML_Char** attributes) {
  Claims& claims = *static_cast<Claims*>(user_data);
  if (std::string(name) != "DataArray") {
    return;
  }
  ++claims.arrays;
  Attributes found;
  for (; attributes[0] != nullptr; attributes += 2) {
    found[attributes[0]] = attributes[1];
  }
  if (claims.fault.empty()) {
    claims.fault = fault_of(found, claims.most);
  }
}

}  // namespace

void check_gii_claims(const fs::path& file) {
  const std::string text = bytes_of_file(file);
  Claims claims{.most = static_cast<double>(most_deflated) * static_cast<double>(text.size())};
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                                             XML_ParserFree);
  if (!parser) {
    throw std::bad_alloc();
  }
  XML_SetUserData(parser.get(), &claims);
  XML_SetStartElementHandler(parser.get(), look_at_element);
  const bool small = text.size() < static_cast<std::size_t>(std::numeric_limits<int>::max());
  const bool well_formed =
      small && XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK;
  if (!well_formed || claims.arrays == 0) {
    refuse(file, "is no GIFTI file, or is damaged or truncated; copy it again");
  }
  if (!claims.fault.empty()) {
    refuse(file, claims.fault);
  }
}

}  // namespace brainshift::registration
