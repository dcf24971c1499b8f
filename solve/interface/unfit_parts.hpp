// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>

namespace brainshift::solve {

/// A part of a model that may be there, and its name.
using UnfitPart = std::pair<bool, const char*>;

/// Throws std::invalid_argument with the first of the parts that is there: "<what> with <part>; <advice>".
inline void refuse_unfit(const std::string& what, std::initializer_list<UnfitPart> parts, const std::string& advice) {
  for (const auto& [there, name] : parts) {
    if (there) {
      throw std::invalid_argument(what + " with " + name + "; " + advice);
    }
  }
}

}  // namespace brainshift::solve
