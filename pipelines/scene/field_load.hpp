// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "discretise/interface/node_cloud.hpp"
#include "pipelines/scene/scene.hpp"
#include "register/files/read_place_map.hpp"

namespace brainshift::pipelines {

/// Which way the field goes: as the scene says, or the file itself, registration::known_direction(). Throws
/// std::invalid_argument where neither does or the two contradict each other.
registration::Moves direction_of(const FieldLoad& field);

/// Throws std::invalid_argument, naming the file, where the files of a field cannot be read or its direction is not
/// known.
void check_field_load(const FieldLoad& field);

/// What a field says of a brain's surface.
struct FieldOnSurface {
  Points displacement;        ///< at the nodes (n × 3), mm; NaN where it says nothing
  std::size_t asked = 0;      ///< nodes under the opening
  std::size_t known = 0;      ///< nodes with a displacement
  std::size_t not_found = 0;  ///< nodes that the field, which resamples, takes no place to: it folds, or ends there
};

/// The displacement that a field has at the surface nodes under its opening, or at all of them where it names none, as
/// far as it is known there, registration::read_place_map(). A field that moves points is looked up; of one that moves
/// images the intraop place is sought that it takes to the node, registration::inverse_at(). Throws
/// std::invalid_argument, naming the file, as check_field_load() and solve::prescribed_on_surface_nodes() of the
/// opening do, and when it knows none of the nodes.
FieldOnSurface field_on_surface_nodes(const FieldLoad& field, const solve::OpeningOptions& opening,
                                      const NodeCloud& cloud);

}  // namespace brainshift::pipelines
