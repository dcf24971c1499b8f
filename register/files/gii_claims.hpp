// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift::registration {

/// Throws std::invalid_argument, naming the file, when a GIFTI file is no well-formed XML, says of an array what the
/// library breaks down on or prints words of its own about, keeps numbers in another file, or claims more of them than
/// its length allows for: memory would be taken for them.
void check_gii_claims(const std::filesystem::path& file);

}  // namespace brainshift::registration
