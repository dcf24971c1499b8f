// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace brainshift::pipelines {

/// Writes a soft cylinder that stands on a smooth plate while its top, which is held sideways, is pressed down by a
/// tenth of its height: cylinder.vtp, plate.vtp, craniotomy.csv and scene.xml. Everything that a head brings along, its
/// image, labels and tissues, is left out. Makes the folder. Throws std::runtime_error, naming the file, when it cannot
/// be written.
void write_cylinder(const std::filesystem::path& out);

}  // namespace brainshift::pipelines
