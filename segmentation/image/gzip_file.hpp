// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace brainshift {

/// Compresses a file to one gzip stream. Blocks are read and compressed in parallel and joined; the result does not
/// depend on the number of threads. ITK and VTK have writers too, but they compress on one thread. Throws
/// std::runtime_error when it cannot be written whole, and leaves none behind.
void write_gzip(const std::filesystem::path& file, const std::filesystem::path& plain);

/// The bytes of a file after decompression, the file being compressed or not. Throws std::invalid_argument when the
/// compressed stream is cut short or its checksum is wrong.
std::vector<std::uint8_t> uncompressed(const std::filesystem::path& file);

}  // namespace brainshift
