// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipelines/scene/tradeoff_lists.hpp"

namespace brainshift::pipelines {

/// One value for each setting, as text, in the order of tradeoff_settings.
using Choice = std::array<std::string, tradeoff_settings.size()>;

/// All combinations of the lists' values. Values of the first setting change slowest.
std::vector<Choice> all_choices(const TradeoffLists& lists);

/// The much finer solution: reference_nodes, the best of every other setting, a tenth of the least stop tolerance.
Choice reference_choice(const TradeoffLists& lists);

/// As "path=value" overrides of a scene.
std::vector<std::string> overrides_of(const Choice& choice);

/// A name for files: "3000-auto-0-linear-full-double-0.1".
std::string name_of(const Choice& choice);

/// For people: "3000 nodes, 1 point a cell, linear basis, full derivatives, double precision, stop at 0.1 mm".
std::string describe(const Choice& choice);

}  // namespace brainshift::pipelines
