// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/geometry/points.hpp"
#include "segmentation/progress/progress.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// A body at rest that waits for another load.
struct KeptBody {
  Body body;
  NodalVectors parameters;  ///< û at rest, mm
  Settled settled;
};

/// Whether a load prescribes any component at a node.
inline bool is_loaded(const Points& prescribed, Eigen::Index node) {
  return !prescribed.row(node).array().isNaN().all();
}

/// How a body at rest answers small changes of what is prescribed: to long waves over the loaded nodes. What answers to
/// short ones lies near them and relaxes in a few steps. None of a wave under which the body did not come to rest, and
/// none at all where more than 1500 nodes are loaded: a start from them is farther off.
struct Responses {
  std::vector<std::int32_t> nodes;  ///< loaded, of the cloud
  std::vector<double> waves;        ///< (waves × nodes), orthonormal
  std::vector<float> parameters;  ///< (waves × 3 × nodes of the body × 3): change of û with a wave along x, y or z

  std::size_t count() const { return nodes.empty() ? 0 : waves.size() / nodes.size(); }
};

/// Nodes that a load prescribes any component at, in order.
std::vector<std::int32_t> loaded_nodes(const Points& prescribed);

/// prescribed: (n × 3) mm, NaN: free; of the load that the body is at rest under. options: that it was solved with.
Responses responses_of(const KeptBody& kept, const Points& prescribed, const SolveOptions& options,
                       const Progress& progress);

/// û at rest, and what a change, (n × 3) mm at the cloud's nodes, adds to it in the first order.
NodalVectors answered(const NodalVectors& at_rest, const Responses& responses, const Points& change);

}  // namespace brainshift::solve
