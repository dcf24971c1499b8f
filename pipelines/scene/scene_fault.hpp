// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Throws std::invalid_argument with the place of an element or option in the scene's file before the sentence. Without
/// a file the options are those of a command, and the sentence stands alone.
[[noreturn]] void fail(const Scene& scene, const std::string& path, const std::string& what);

/// Runs a check of the library; the place in the scene comes before its message.
template <class Check>
void check_at(const Scene& scene, const std::string& path, const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    fail(scene, path, error.what());
  }
}

}  // namespace brainshift::pipelines
