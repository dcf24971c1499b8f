// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/options/option.hpp"

namespace brainshift::detail {

std::string refusal(const std::string& name, const std::string& value, const std::string& allowed,
                    const std::string& unit) {
  return name + " is '" + value + "', but must be " + allowed + (unit.empty() ? "" : " (" + unit + ")");
}

}  // namespace brainshift::detail
