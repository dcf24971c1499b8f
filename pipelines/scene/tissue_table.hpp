// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipelines/scene/scene.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::pipelines {

/// The options of a <tissue> inside <tissues>; paths "tissues.LABEL.NAME".
const OptionTable<Tissue>& tissue_options();
/// The name of the material that a class of the brain has where nothing else is said.
std::string usual_material(std::uint16_t tissue_class);
/// Whether an option of a tissue says which tissue it is.
bool names_tissue(const std::string& option);

}  // namespace brainshift::pipelines
