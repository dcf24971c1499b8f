// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/read_cut.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/cut/cut_path.hpp"
#include "solve/cut/cut_sheet.hpp"

namespace brainshift::solve {

Cut read_cut(const std::filesystem::path& file, const CutTiming& timing) {
  if (!std::filesystem::is_regular_file(file)) {
    throw std::invalid_argument(file.string() + ": there is no such file; a cut was expected");
  }
  const std::string ending = ending_of(file);
  if (ending == ".csv") {
    return read_cut_path(file, timing);
  }
  if (std::ranges::count(surface_endings, ending) == 0) {
    throw std::invalid_argument(file.string() + ": a cut ends in .csv (a path in a plane) or is a sheet, " +
                                listed_surface_endings);
  }
  return read_cut_sheet(file, timing);
}

}  // namespace brainshift::solve
