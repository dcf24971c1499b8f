// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "solve/interface/model.hpp"

namespace brainshift::solve {

class Visibility;

/// A septum from a surface that read_surface() reads. Throws std::invalid_argument, naming the file, when it cannot be
/// read or check_septum() refuses it.
Septum read_septum(const std::filesystem::path& file);

/// Throws std::invalid_argument, naming the septum, when it has no triangle, or one without area, and in a plane
/// problem.
void check_septum(const Septum& septum, bool planar);

/// As those of a cut from the start.
CutFacets facets_of(const Septum& septum);

/// Of what is prescribed at nodes, (n × 3) mm, NaN: free, what a measured point tells that a node sees past the septum,
/// of the nearest; the other nodes are freed, as what one hemisphere does is not the other's. measured: (m × 3) mm.
Points not_through(const Visibility& septum, const Points& measured, const NodeCloud& cloud, Points prescribed);

/// How many nodes what is prescribed takes to the septum's other side.
std::size_t moved_through(const Visibility& septum, const NodeCloud& cloud, const Points& prescribed);

}  // namespace brainshift::solve
