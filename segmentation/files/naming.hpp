// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace brainshift {

/// Does work that knows no files: what it refuses is what these hold. files: their names; empty: none.
template <class Work>
auto naming(const std::string& files, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(files.empty() ? fault.what() : files + ": " + fault.what());
  }
}

}  // namespace brainshift
