// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace brainshift::pipelines {

/// SHA-256 (FIPS 180-4) of data that comes in pieces.
class Sha256 {
 public:
  void add(std::span<const unsigned char> data);
  /// The digest of all that was added, 64 hexadecimal digits. Call it once.
  std::string hex();

 private:
  void add_block(const unsigned char* block);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> buffer_{};
  std::size_t buffered_ = 0;
  std::uint64_t length_ = 0;  ///< bytes
};

std::string sha256_of_text(std::string_view text);

/// Of a file's contents, as sha256sum gives it; of a folder (a DICOM series): over the names and contents of its files
/// in the order of their names. Throws std::invalid_argument, naming the file, when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace brainshift::pipelines
