// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace brainshift::pipelines {

/// The page OPTIONS.md: every element of a scene with its options, their ranges, units and defaults, as Markdown.
std::string options_page();

}  // namespace brainshift::pipelines
