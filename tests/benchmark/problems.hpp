// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "solve/force/point_blocks.hpp"
#include "solve/solve.hpp"

namespace brainshift::bench {

/// What is solved, and how.
struct Problem {
  solve::Model model;
  solve::SolveOptions options;
};

/// An ellipsoid as large as a brain; the top sinks by up to 4 mm, the rest is free. cells_per_node: of
/// DiscretiseOptions. wall: cells and nodes know of it; nothing: of none.
Problem ellipsoid(std::size_t nodes, double cells_per_node, const std::optional<Surface>& wall = {});

/// The same surface, larger by so many mm in each direction.
Surface ellipsoid_surface(double larger);

/// The solve stage's model in the folder of a run of the scene, its later stages made or not.
Problem problem_of_run(const std::filesystem::path& scene, const std::filesystem::path& run);

/// Linear basis, so wide that a point sees about 30 nodes, and one integration point a cell: with two cells a node the
/// setting of most published MTLED models.
void as_published(solve::SolveOptions& options);
inline constexpr double published_cells_per_node = 1.9;

template <class T>
double bytes(const std::vector<T>& values) {
  return static_cast<double>(values.size() * sizeof(T));
}

/// Bytes that an evaluation of the internal force reads at least once: what was laid out, and the nodes' parameters.
double bytes_read(const solve::PointBlocks& points);

}  // namespace brainshift::bench
