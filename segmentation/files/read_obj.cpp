// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/read_obj.hpp"

#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace brainshift {
namespace {

std::optional<std::array<double, 3>> parse_vertex(std::istringstream& words) {
  std::array<double, 3> point{};
  for (double& coordinate : point) {
    std::string word;
    words >> word;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), coordinate);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size()) {
      return std::nullopt;
    }
  }
  return point;
}

// A corner is VERTEX[/TEXTURE[/NORMAL]]; a negative number counts back from the last vertex read.
std::optional<std::size_t> parse_corner(const std::string& word, std::size_t vertices) {
  const std::string head = word.substr(0, word.find('/'));
  long long number = 0;
  const auto parsed = std::from_chars(head.data(), head.data() + head.size(), number);
  if (parsed.ec != std::errc{} || parsed.ptr != head.data() + head.size()) {
    return std::nullopt;
  }
  const long long index = number > 0 ? number - 1 : static_cast<long long>(vertices) + number;
  if (number == 0 || index < 0) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(index);
}

std::optional<std::vector<std::size_t>> parse_face(std::istringstream& words, std::size_t vertices) {
  std::vector<std::size_t> corners;
  std::string word;
  while (words >> word && !word.starts_with('#')) {
    const auto corner = parse_corner(word, vertices);
    if (!corner) {
      return std::nullopt;
    }
    corners.push_back(*corner);
  }
  return corners.size() >= 3 ? std::optional(corners) : std::nullopt;
}

[[noreturn]] void refuse_line(const std::filesystem::path& file, std::size_t line_number, const std::string& line,
                              const std::string& expected) {
  throw std::invalid_argument(file.string() + ":" + std::to_string(line_number) + ": expected " + expected +
                              ", found \"" + line.substr(0, 80) + "\"");
}

}  // namespace

PolygonSoup read_obj(const std::filesystem::path& file) {
  std::ifstream in(file);
  PolygonSoup soup;
  std::string line;
  for (std::size_t line_number = 1; std::getline(in, line); ++line_number) {
    for (std::string more; line.ends_with('\\') && std::getline(in, more); ++line_number) {
      line.back() = ' ';  // a statement goes on behind a backslash
      line += more;
    }
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      const auto point = parse_vertex(words);
      if (!point) {
        refuse_line(file, line_number, line, "a vertex \"v x y z\"");
      }
      soup.points.push_back(*point);
    } else if (keyword == "f") {
      const auto corners = parse_face(words, soup.points.size());
      if (!corners) {
        refuse_line(file, line_number, line, "a face \"f i j k\" of at least three vertices");
      }
      soup.polygons.push_back(*corners);
    } else if (!keyword.empty() && keyword.front() != '#' &&
               std::isalpha(static_cast<unsigned char>(keyword.front())) == 0) {
      refuse_line(file, line_number, line, "a statement of a Wavefront file");
    }
  }
  return soup;
}

}  // namespace brainshift
