// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/ply_claims.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "segmentation/files/bytes_of_file.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

/// Of a number, by the name of its type; none for an unknown name.
std::optional<std::size_t> bytes_of_ply_type(const std::string& name) {
  static const std::map<std::string, std::size_t> bytes = {{"char", 1},  {"int8", 1},    {"uchar", 1},  {"uint8", 1},
                                                           {"short", 2}, {"int16", 2},   {"ushort", 2}, {"uint16", 2},
                                                           {"int", 4},   {"int32", 4},   {"uint", 4},   {"uint32", 4},
                                                           {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = bytes.find(name);
  return found == bytes.end() ? std::nullopt : std::optional(found->second);
}

/// None where the line is no property.
std::optional<PlyProperty> read_property(std::istringstream& words) {
  PlyProperty property;
  std::string count;
  words >> property.type;
  const bool is_list = property.type == "list";
  if (is_list) {
    words >> count >> property.type;
    property.count_bytes = bytes_of_ply_type(count);
  }
  words >> property.name;
  const auto bytes = bytes_of_ply_type(property.type);
  if (!bytes || property.count_bytes.has_value() != is_list) {
    return std::nullopt;
  }
  property.bytes = *bytes;
  return property;
}

/// Takes the header off the text. None where it is none.
std::optional<PlyHeader> take_header(std::string_view& text) {
  PlyHeader header;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::istringstream words{std::string(text.substr(0, end))};
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string keyword;
    words >> keyword;
    if (first != (keyword == "ply")) {
      return std::nullopt;
    }
    first = false;
    if (keyword == "end_header") {
      return header;
    }
    if (keyword == "format") {
      words >> header.format;
    } else if (keyword == "element") {
      PlyElement& element = header.elements.emplace_back();
      words >> element.name >> element.rows;
    } else if (keyword == "property") {
      const auto property = read_property(words);
      if (!property || header.elements.empty()) {
        return std::nullopt;
      }
      header.elements.back().properties.push_back(*property);
    }
  }
  return std::nullopt;
}

/// Goes along the numbers of a binary file. False when they end.
class BinaryRows {
 public:
  BinaryRows(std::string_view text, bool big_endian) : text_(text), big_endian_(big_endian) {}

  bool skip(std::uint64_t numbers, std::size_t bytes) {
    if (numbers > text_.size() / bytes) {
      return false;
    }
    text_.remove_prefix(static_cast<std::size_t>(numbers) * bytes);
    return true;
  }
  std::optional<std::uint64_t> count(std::size_t bytes) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < bytes && i < text_.size(); ++i) {
      const std::size_t place = big_endian_ ? bytes - 1 - i : i;
      number |= std::uint64_t{static_cast<unsigned char>(text_[i])} << (8 * place);
    }
    return skip(1, bytes) ? std::optional(number) : std::nullopt;
  }

 private:
  std::string_view text_;
  bool big_endian_;
};

/// The same in text, where a number is a word.
class TextRows {
 public:
  explicit TextRows(std::string_view text) : text_(text) {}

  bool skip(std::uint64_t numbers, std::size_t) {
    for (; numbers > 0; --numbers) {
      if (word().empty()) {
        return false;
      }
    }
    return true;
  }
  std::optional<std::uint64_t> count(std::size_t) {
    const std::string_view digits = word();
    std::uint64_t number = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return fault == std::errc{} && number <= text_.size() ? std::optional(number) : std::nullopt;
  }

 private:
  std::string_view word() {
    constexpr std::string_view blanks = " \t\r\n";
    text_.remove_prefix(std::min(text_.find_first_not_of(blanks), text_.size()));
    const std::string_view word = text_.substr(0, text_.find_first_of(blanks));
    text_.remove_prefix(word.size());
    return word;
  }

  std::string_view text_;
};

template <class Rows>
bool has_all(Rows rows, const std::vector<PlyElement>& elements) {
  for (const PlyElement& element : elements) {
    for (std::uint64_t row = 0; row < element.rows && !element.properties.empty(); ++row) {
      for (const PlyProperty& property : element.properties) {
        const auto numbers = property.count_bytes ? rows.count(*property.count_bytes) : std::optional<std::uint64_t>(1);
        if (!numbers || !rows.skip(*numbers, property.bytes)) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace

PlyHeader check_ply_claims(const std::filesystem::path& file) {
  const std::string content = bytes_of_file(file);
  std::string_view text = content;
  auto header = take_header(text);
  if (!header) {
    refuse(file, "is no .ply file, or its header is damaged; copy it again");
  }
  const bool whole = header->format == "ascii"
                         ? has_all(TextRows(text), header->elements)
                         : has_all(BinaryRows(text, header->format == "binary_big_endian"), header->elements);
  if (!whole) {
    refuse(file, "ends before what its header and lists promise; copy it again");
  }
  return *std::move(header);
}

}  // namespace brainshift
