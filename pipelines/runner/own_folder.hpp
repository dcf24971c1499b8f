// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift::pipelines {

/// A folder that is being written holds this file; one that is finished holds stage.json.
inline constexpr const char* unfinished_mark = ".unfinished";

/// Whether the folder is one of ours: empty, or with a mark of ours in it. What is no folder is not ours, nor is a
/// link.
bool is_own_folder(const std::filesystem::path& folder);

/// Throws std::invalid_argument, naming the folder, when there is one that is not ours.
void refuse_foreign_folder(const std::filesystem::path& folder);

/// Removes all that lies in the folder, the marks last: who is stopped on the way leaves a folder that is still ours.
void clear_own_folder(const std::filesystem::path& folder);

/// The same, and the folder.
void remove_own_folder(const std::filesystem::path& folder);

}  // namespace brainshift::pipelines
