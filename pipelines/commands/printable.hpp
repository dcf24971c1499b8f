// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace brainshift::pipelines {

/// The text on one line, as a terminal may show it: control characters, with which a foreign file could steer it, and
/// what is no UTF-8 become '?', ends of lines blanks; of a very long one the middle is left out.
std::string printable(std::string_view text);

}  // namespace brainshift::pipelines
