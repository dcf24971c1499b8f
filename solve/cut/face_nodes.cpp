// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/face_nodes.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "solve/cut/face_places.hpp"

namespace brainshift::solve {

namespace {

/// A node like another, at a place; returns its row.
std::int32_t append_node(NodeCloud& cloud, Conditions& conditions, std::int32_t like, const Eigen::Vector3d& x) {
  const Eigen::Index row = cloud.positions.rows();
  const auto from = static_cast<std::size_t>(like);
  cloud.positions.conservativeResize(row + 1, 3);
  cloud.positions.row(row) = x;
  cloud.spacing.push_back(cloud.spacing[from]);
  cloud.on_surface.push_back(1);
  if (conditions.displacement.rows() == row) {
    conditions.displacement.conservativeResize(row + 1, 3);
    conditions.displacement.row(row).setConstant(std::nan(""));
  }
  if (conditions.force.rows() == row) {
    conditions.force.conservativeResize(row + 1, 3);
    conditions.force.row(row).setZero();
  }
  return static_cast<std::int32_t>(row);
}

/// By how much more is prescribed at a place of a face than at a node, mm: by a linear function through the values of
/// the node and of those about it, on its side of the face. NaN where nothing is prescribed.
Eigen::RowVector3d more_there(const PairPlace& p, Eigen::Index node, const NodeCloud& cloud, const Points& prescribed) {
  const Eigen::RowVector3d from = cloud.positions.row(node), value = prescribed.row(node);
  Eigen::RowVector3d more = 0 * value;
  if (value.array().isNaN().all()) {
    return more;
  }
  const auto side = [&](const Eigen::RowVector3d& x) { return p.normal.dot(x.transpose() - p.x) >= 0; };
  const double reach = next_on_surface * cloud.spacing[static_cast<std::size_t>(node)];
  std::vector<Eigen::Index> about;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a);
    if (a != node && (x - from).norm() < reach && side(x) == side(from)) {
      about.push_back(a);
    }
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<Eigen::Index> near = about;
    std::erase_if(near, [&](Eigen::Index a) { return std::isnan(prescribed(a, axis)); });
    if (near.empty() || std::isnan(value[axis])) {
      continue;
    }
    const Eigen::MatrixXd apart = cloud.positions(near, Eigen::all).rowwise() - from;
    const Eigen::VectorXd change = prescribed(near, axis).array() - value[axis];
    Eigen::JacobiSVD<Eigen::MatrixXd> fit(apart, Eigen::ComputeThinU | Eigen::ComputeThinV);
    fit.setThreshold(0.05);  // across a patch of the surface nothing is known
    more[axis] = (p.x.transpose() - from).dot(fit.solve(change));
  }
  return more;
}

/// What is prescribed at the two nodes of a pair, mm.
struct HeldPair {
  Eigen::RowVector3d above = Eigen::RowVector3d::Constant(std::nan("")), below = above;
};

/// Where a face comes out of the body within a patch that is held, free nodes would depart from the nodes about them,
/// which their side sees few of: a pair there is held as its side of the patch is. within: of a node of it, spacings.
HeldPair held_there(const PairPlace& p, double within, const std::vector<Eigen::Index>& patch, const NodeCloud& cloud,
                    const Points& prescribed) {
  const double h = cloud.spacing[static_cast<std::size_t>(p.like)];
  double near_above = next_on_surface * h, near_below = near_above;
  Eigen::Index above = no_node, below = no_node;
  for (const Eigen::Index a : patch) {
    const Eigen::Vector3d apart = cloud.positions.row(a).transpose() - p.x;
    const bool is_above = p.normal.dot(apart) >= 0;
    if (apart.norm() < (is_above ? near_above : near_below)) {
      (is_above ? above : below) = a;
      (is_above ? near_above : near_below) = apart.norm();
    }
  }
  HeldPair held;
  if (std::min(near_above, near_below) < within * h) {
    const auto at = [&](Eigen::Index a) -> Eigen::RowVector3d {
      return prescribed.row(a) + more_there(p, a, cloud, prescribed);
    };
    held.above = above != no_node ? at(above) : held.above;
    held.below = below != no_node ? at(below) : held.below;
  }
  return held;
}

/// What is prescribed at all pairs, before any node has moved. Of a node that is split at both as it was; by a septum,
/// which parts what its sides do, of a held node as its sides of the patch are.
std::vector<HeldPair> held_pairs(const std::vector<PairPlace>& places, bool septum, const NodeCloud& cloud,
                                 const Points& prescribed) {
  constexpr double on_patch = 0.75, of_patch = next_on_surface;  // spacings
  std::vector<std::uint8_t> is_split(cloud.size(), 0);
  for (const PairPlace& p : places) {
    if (p.node != no_node) {
      is_split[static_cast<std::size_t>(p.node)] = septum ? 1 : 0;
    }
  }
  std::vector<Eigen::Index> patch;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (cloud.on_surface[k] != 0 && is_split[k] == 0 && prescribed.row(a).allFinite()) {
      patch.push_back(a);
    }
  }
  std::vector<HeldPair> held;
  for (const PairPlace& p : places) {
    const bool is_free = p.node == no_node || (cloud.on_surface[static_cast<std::size_t>(p.node)] != 0 &&
                                               prescribed.row(p.node).array().isNaN().all());
    HeldPair of_patches;
    if (is_free || (septum && prescribed.row(p.node).allFinite())) {
      of_patches = held_there(p, is_free ? on_patch : of_patch, patch, cloud, prescribed);
    }
    if (is_free || of_patches.above.allFinite() || of_patches.below.allFinite()) {
      held.push_back(of_patches);
    } else {
      const Eigen::RowVector3d value = prescribed.row(p.node) + more_there(p, p.node, cloud, prescribed);
      held.push_back({.above = value, .below = value});
    }
  }
  return held;
}

std::size_t add_at(const std::vector<PairPlace>& places, bool septum, NodeCloud& cloud, Conditions& conditions,
                   std::vector<FacePair>& pairs) {
  std::size_t split = 0;
  const bool prescribes = conditions.displacement.rows() > 0;
  const std::vector<HeldPair> held =
      prescribes ? held_pairs(places, septum, cloud, conditions.displacement) : std::vector<HeldPair>();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PairPlace& p = places[i];
    const Eigen::Vector3d off = off_face * cloud.spacing[static_cast<std::size_t>(p.like)] * p.normal;
    FacePair pair{p.node, no_node, p.x, p.normal};
    if (p.node != no_node) {
      ++split;
      cloud.positions.row(p.node) = p.x + off;
      cloud.on_surface[static_cast<std::size_t>(p.node)] = 1;
    } else {
      pair.above = append_node(cloud, conditions, p.like, p.x + off);
    }
    pair.below = append_node(cloud, conditions, pair.above, p.x - off);
    if (prescribes) {
      conditions.displacement.row(pair.above) = held[i].above;
      conditions.displacement.row(pair.below) = held[i].below;
    }
    if (conditions.force.rows() > 0) {
      conditions.force.row(pair.above) /= 2;
      conditions.force.row(pair.below) = conditions.force.row(pair.above);
    }
    pairs.push_back(pair);
  }
  return split;
}

}  // namespace

std::size_t add_face_nodes(const CutFacets& cut, const InsideBody& inside, NodeCloud& cloud, Conditions& conditions,
                           std::vector<FacePair>& pairs) {
  return add_at(face_places(cut, inside, cloud, pairs), false, cloud, conditions, pairs);
}

std::size_t add_septum_nodes(const CutFacets& septum, const InsideBody& inside, NodeCloud& cloud,
                             Conditions& conditions, std::vector<FacePair>& pairs) {
  std::vector<PairPlace> places = septum_places(septum, inside, cloud, pairs);
  const Visibility visibility(septum);
  std::erase_if(places, [&](const PairPlace& p) {  // in a crease both nodes may come to lie on one side
    const Eigen::Vector3d off = off_face * cloud.spacing[static_cast<std::size_t>(p.like)] * p.normal;
    return !visibility.detour(p.x + off, p.x - off);
  });
  return add_at(places, true, cloud, conditions, pairs);
}

}  // namespace brainshift::solve
