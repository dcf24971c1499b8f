// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace brainshift::test {

inline std::string little_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(value >> (8 * i) & 0xff);
  }
  return text;
}

inline std::string element(std::uint64_t group, std::uint64_t number, const std::string& kind, std::string value) {
  value += value.size() % 2 == 0 ? "" : std::string(1, kind == "UI" ? '\0' : ' ');
  const bool is_long = kind == "OB" || kind == "OW" || kind == "SQ";
  return little_endian(group, 2) + little_endian(number, 2) + kind +
         (is_long ? std::string(2, '\0') + little_endian(value.size(), 4) : little_endian(value.size(), 2)) + value;
}

inline std::string sequence(std::uint64_t group, std::uint64_t number, const std::vector<std::string>& items) {
  std::string content;
  for (const std::string& item : items) {
    content += little_endian(0xfffe, 2) + little_endian(0xe000, 2) + little_endian(item.size(), 4) + item;
  }
  return element(group, number, "SQ", content);
}

/// A slice of an MR series in explicit little endian; pixel (i, j) holds value + i + 10 j.
struct DrawnSlice {
  std::uint64_t rows = 3, columns = 4, bits = 16, value = 100;
  std::string series = "1.2.3.4", spacing = "0.8\\0.7", orientation = "1\\0\\0\\0\\1\\0", position = "-1\\-2\\0";
  std::string sequence;
  std::string modality = "MR", study, frame_of_reference;
  std::string rescale;  ///< slope and intercept, a backslash between
  bool bare = false;    ///< it tells no place
  std::string sop_class = "1.2.840.10008.5.1.4.1.1.4";

  std::string header() const {
    const std::string meta = element(2, 2, "UI", sop_class) +
                             element(2, 3, "UI", "1.2.3.5." + position.substr(position.rfind('\\') + 1)) +
                             element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
    return std::string(128, '\0') + "DICM" + element(2, 0, "UL", little_endian(meta.size(), 4)) + meta +
           element(8, 0x16, "UI", sop_class) +
           element(8, 0x18, "UI", "1.2.3.5." + position.substr(position.rfind('\\') + 1)) +
           element(8, 0x60, "CS", modality) + sequence + element(0x10, 0x10, "PN", "Somebody") +
           (study.empty() ? "" : element(0x20, 0xd, "UI", study)) + element(0x20, 0xe, "UI", series) +
           (bare ? "" : element(0x20, 0x32, "DS", position) + element(0x20, 0x37, "DS", orientation)) +
           (frame_of_reference.empty() ? "" : element(0x20, 0x52, "UI", frame_of_reference)) +
           element(0x28, 2, "US", little_endian(1, 2)) + element(0x28, 4, "CS", "MONOCHROME2") +
           element(0x28, 0x10, "US", little_endian(rows, 2)) + element(0x28, 0x11, "US", little_endian(columns, 2)) +
           (bare ? "" : element(0x28, 0x30, "DS", spacing)) + element(0x28, 0x100, "US", little_endian(bits, 2)) +
           element(0x28, 0x101, "US", little_endian(bits, 2)) + element(0x28, 0x102, "US", little_endian(bits - 1, 2)) +
           element(0x28, 0x103, "US", little_endian(0, 2)) + rescaling();
  }
  std::string rescaling() const {
    const std::size_t slash = rescale.find('\\');
    return rescale.empty() ? ""
                           : element(0x28, 0x1052, "DS", rescale.substr(slash + 1)) +
                                 element(0x28, 0x1053, "DS", rescale.substr(0, slash));
  }
  std::string pixels() const {
    std::string pixels;
    for (std::uint64_t j = 0; j < rows; ++j) {
      for (std::uint64_t i = 0; i < columns; ++i) {
        pixels += little_endian(value + i + 10 * j, static_cast<int>(bits / 8));
      }
    }
    return pixels;
  }
  std::string bytes() const { return header() + element(0x7fe0, 0x10, "OW", pixels()); }
};

/// An enhanced MR object of several slices. bare: their places are in the functional groups alone.
inline std::string drawn_frames(const std::vector<DrawnSlice>& frames, bool bare = false) {
  DrawnSlice whole = frames.front();
  whole.bare = bare;
  whole.sop_class += ".1";
  whole.sequence = element(0x28, 8, "IS", std::to_string(frames.size()));
  std::vector<std::string> groups;
  std::string pixels;
  for (const DrawnSlice& frame : frames) {
    const std::string position = element(0x20, 0x32, "DS", frame.position);
    groups.push_back((frame.position.empty() ? "" : sequence(0x20, 0x9113, {position})) +
                     sequence(0x20, 0x9116, {element(0x20, 0x37, "DS", frame.orientation)}) +
                     sequence(0x28, 0x9110, {element(0x28, 0x30, "DS", frame.spacing)}) +
                     (frame.rescale.empty() ? "" : sequence(0x28, 0x9145, {frame.rescaling()})));
    pixels += frame.pixels();
  }
  return whole.header() + sequence(0x5200, 0x9230, groups) + element(0x7fe0, 0x10, "OW", pixels);
}

}  // namespace brainshift::test
