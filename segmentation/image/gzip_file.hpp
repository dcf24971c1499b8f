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

/// Whether the file begins as a gzip stream does.
bool is_gzip(const std::filesystem::path& file);

/// The first bytes of a file after decompression, the file being compressed or not; fewer where it is shorter. Throws
/// std::invalid_argument when the compressed stream is cut short within them or damaged.
std::vector<std::uint8_t> first_uncompressed(const std::filesystem::path& file, std::size_t count);

/// All of them. Throws also when there are more than at_most, or the checksum is wrong.
std::vector<std::uint8_t> uncompressed(const std::filesystem::path& file, std::size_t at_most);

/// Throws std::invalid_argument unless the streams of zlib or gzip from an offset of the file on are whole and give so
/// many bytes. Takes little memory.
void check_inflates(const std::filesystem::path& file, std::uint64_t offset, std::uint64_t bytes);

}  // namespace brainshift
