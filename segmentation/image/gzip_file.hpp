// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace brainshift {

/// Writes bytes as one gzip stream. Blocks are compressed in parallel and joined; the file does not depend on the
/// number of threads. Throws std::runtime_error when the file cannot be written whole, and leaves none behind.
void write_gzip(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// The bytes of a file after decompression, the file being compressed or not. Throws std::invalid_argument when the
/// compressed stream is cut short or its checksum is wrong.
std::vector<std::uint8_t> uncompressed(const std::filesystem::path& file);

}  // namespace brainshift
