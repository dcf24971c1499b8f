// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace brainshift::pipelines {

/// A script that shows the run in whose folder it lies, wherever the folder is moved.
struct ShowScript {
  const char* name;
  const char* text;
};

/// open_in_slicer.py and open_in_paraview.py.
std::array<ShowScript, 2> show_scripts();

}  // namespace brainshift::pipelines
