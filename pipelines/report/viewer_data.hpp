// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pipelines/report/slice_figures.hpp"

namespace brainshift::pipelines {

/// Bytes in the page: compressed (zlib or gzip), as text (base64).
struct PackedBytes {
  std::string name;
  std::string text;
};

/// What viewer.js shows of a run. Places and displacements are in LPS, numbers in arrays little-endian.
struct ViewerData {
  nlohmann::json facts = nlohmann::json::object();  ///< grids, steps, colours, options and measures; the measured load
                                                    ///< and the history as they were written
  std::vector<PackedBytes> arrays = {};
};

/// Both images around the brain in 64 greys, the warped one as what it differs by from the first, which takes a third
/// of the letters; both label maps; on a grid of 2 mm displacement, volume ratio, estimated error and what is brain;
/// the surface. Images and labels are made coarser until all takes no more letters than room. The run must have a
/// brain's surface, a solution, T1, warped image and forward field; what else it lacks is left out.
ViewerData viewer_data(const RunData& run, const View& view, std::size_t room);

/// How much of the page they take.
std::size_t letters_of(const std::vector<PackedBytes>& all);

/// Bytes compressed and as text. Throws std::length_error as encode_base64() does.
std::string packed(std::string_view bytes);

}  // namespace brainshift::pipelines
