// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace brainshift {

/// A name for what is added to a file: "warp_" goes before it as often as is_taken(name).
template <class IsTaken>
std::string free_name(std::string name, const IsTaken& is_taken) {
  while (is_taken(name)) {
    name.insert(0, "warp_");
  }
  return name;
}

}  // namespace brainshift
