// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/warp/point_mover.hpp"

namespace brainshift::registration {

/// Moves the tracts of MRtrix's .tck, points in RAS, mm. Header, type of number, order and marks between the tracts
/// stay byte for byte. A tract at a time is in memory at most. What goes along with the points is written
/// beside, as TrackScalars does. Throws as warp_any().
void warp_tck(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

/// The same of TrackVis' .trk (version 2), points in voxels scaled to mm. Scalars of points and properties of tracts
/// stay; what goes along with the points become scalars behind them, as far as the header's ten have room.
void warp_trk(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

}  // namespace brainshift::registration
