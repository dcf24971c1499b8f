// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace brainshift::registration {

/// Where a place goes, both mm, LPS; nothing where the map is not known, as outside the grid of a field.
using PlaceMap = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector3d&)>;

/// The y near x that the map takes to x, by Newton's method with differences over half a millimetre, within 0.001 mm.
/// Nothing where the map is not known at x or on the way, or no such place is found, as where the map folds.
std::optional<Eigen::Vector3d> inverse_at(const PlaceMap& map, const Eigen::Vector3d& x);

}  // namespace brainshift::registration
