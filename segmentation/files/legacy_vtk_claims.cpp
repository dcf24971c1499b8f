// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/legacy_vtk_claims.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>

#include "segmentation/files/bytes_of_file.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

/// The next number of the cells, in text or as four bytes, the first of which counts most; -1 where there is none.
std::int64_t next_number(std::istream& in, bool binary) {
  if (!binary) {
    std::int64_t number = -1;
    return in >> number ? number : -1;
  }
  std::int64_t number = 0;
  for (int byte = 0; byte < 4; ++byte) {
    const int value = in.get();
    number = value < 0 || number < 0 ? -1 : 256 * number + value;
  }
  return number;
}

/// Cells are a count and so many points each.
bool are_whole(std::istream& in, bool binary, std::int64_t cells, std::int64_t numbers) {
  for (; cells > 0; --cells) {
    const std::int64_t points = next_number(in, binary);
    numbers -= points + 1;
    if (points < 0 || numbers < 0) {
      return false;
    }
    for (std::int64_t p = 0; p < points; ++p) {
      if (next_number(in, binary) < 0) {
        return false;
      }
    }
  }
  return numbers == 0;
}

}  // namespace

void check_legacy_vtk_claims(const std::filesystem::path& file) {
  const std::string text = bytes_of_file(file);
  const bool binary = text.find("\nBINARY") < text.find("\nDATASET");
  for (const char* keyword : {"\nVERTICES ", "\nLINES ", "\nPOLYGONS ", "\nTRIANGLE_STRIPS ", "\nCELLS "}) {
    const std::size_t place = text.find(keyword);
    if (place == std::string::npos) {
      continue;
    }
    const std::size_t end = std::min(text.find('\n', place + 1), text.size());
    std::istringstream counts(text.substr(place + std::string(keyword).size(), end - place)), rest(text.substr(end));
    std::int64_t cells = -1, numbers = -1;
    counts >> cells >> numbers;
    rest.get();  // the end of the line
    if (cells < 0 || numbers < cells || !are_whole(rest, binary, cells, numbers)) {
      refuse(file, "its cells are not as many as it says; it is damaged or truncated, copy it again");
    }
  }
}

}  // namespace brainshift
