// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace brainshift::pipelines {

/// SHA-256, 64 hexadecimal digits.
std::string sha256_of_text(std::string_view text);

/// Of a file's contents, as sha256sum gives it; of a folder (a DICOM series): over the names and contents of its files
/// in the order of their names. Throws std::invalid_argument, naming the file, when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace brainshift::pipelines
