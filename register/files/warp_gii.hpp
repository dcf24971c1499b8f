// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "register/warp/point_mover.hpp"

namespace brainshift::registration {

/// Moves the points of a GIFTI surface (.gii). All arrays, metadata, label tables and coordinate systems stay. Its
/// points lie in the scanner's RAS, mm: as they are where their data space says so or nothing does, else by their
/// matrix to NIFTI_XFORM_SCANNER_ANAT or, of a file of FreeSurfer, by the volume (VolGeom…) that its metadata hold.
/// What the points move by turns with that. What goes along with the points is written beside, as the .shape.gii of
/// values_name(). Throws as warp_any().
void warp_gii(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out);

}  // namespace brainshift::registration
