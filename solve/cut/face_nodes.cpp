// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/face_nodes.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "solve/cut/face_places.hpp"

namespace brainshift::solve {

namespace {

/// A node like another, at a place; returns its row.
std::int32_t append_node(NodeCloud& cloud, Conditions& conditions, std::int32_t like, const Eigen::Vector3d& x,
                         bool held_alike) {
  const Eigen::Index row = cloud.positions.rows();
  const auto from = static_cast<std::size_t>(like);
  cloud.positions.conservativeResize(row + 1, 3);
  cloud.positions.row(row) = x;
  cloud.spacing.push_back(cloud.spacing[from]);
  cloud.on_surface.push_back(1);
  if (conditions.displacement.rows() == row) {
    conditions.displacement.conservativeResize(row + 1, 3);
    conditions.displacement.row(row).setConstant(std::nan(""));
    if (held_alike) {
      conditions.displacement.row(row) = conditions.displacement.row(like);
    }
  }
  if (conditions.force.rows() == row) {
    conditions.force.conservativeResize(row + 1, 3);
    conditions.force.row(row).setZero();
  }
  return static_cast<std::int32_t>(row);
}

/// What a node that moves onto a face gets more of what is prescribed, mm: by a linear function through its value and
/// those of the nodes about it, on its side of the face. NaN where nothing is prescribed.
Eigen::RowVector3d more_there(const PairPlace& p, const NodeCloud& cloud, const Points& prescribed) {
  const Eigen::RowVector3d from = cloud.positions.row(p.node), value = prescribed.row(p.node);
  Eigen::RowVector3d more = 0 * value;
  if (value.array().isNaN().all()) {
    return more;
  }
  const auto side = [&](const Eigen::RowVector3d& x) { return p.normal.dot(x.transpose() - p.x) >= 0; };
  const double reach = next_on_surface * cloud.spacing[static_cast<std::size_t>(p.node)];
  std::vector<Eigen::Index> about;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    const Eigen::RowVector3d x = cloud.positions.row(a);
    if (a != p.node && (x - from).norm() < reach && side(x) == side(from)) {
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

/// Of all nodes that are split, before any has moved.
void prescribe_at(const std::vector<PairPlace>& places, const NodeCloud& cloud, Points& prescribed) {
  const Points before = prescribed;
  for (const PairPlace& p : places) {
    if (p.node != no_node) {
      prescribed.row(p.node) += more_there(p, cloud, before);
    }
  }
}

std::size_t add_at(const std::vector<PairPlace>& places, NodeCloud& cloud, Conditions& conditions,
                   std::vector<FacePair>& pairs) {
  std::size_t split = 0;
  if (conditions.displacement.rows() > 0) {
    prescribe_at(places, cloud, conditions.displacement);
  }
  for (const PairPlace& p : places) {
    const Eigen::Vector3d off = off_face * cloud.spacing[static_cast<std::size_t>(p.like)] * p.normal;
    FacePair pair{p.node, no_node, p.x, p.normal};
    const bool was_there = p.node != no_node;
    if (was_there) {
      ++split;
      cloud.positions.row(p.node) = p.x + off;
      cloud.on_surface[static_cast<std::size_t>(p.node)] = 1;
    } else {
      pair.above = append_node(cloud, conditions, p.like, p.x + off, false);
    }
    pair.below = append_node(cloud, conditions, pair.above, p.x - off, was_there);
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
  return add_at(face_places(cut, inside, cloud, pairs), cloud, conditions, pairs);
}

std::size_t add_septum_nodes(const CutFacets& septum, const InsideBody& inside, NodeCloud& cloud,
                             Conditions& conditions, std::vector<FacePair>& pairs) {
  std::vector<PairPlace> places = septum_places(septum, inside, cloud, pairs);
  const Visibility visibility(septum);
  std::erase_if(places, [&](const PairPlace& p) {  // in a crease both nodes may come to lie on one side
    const Eigen::Vector3d off = off_face * cloud.spacing[static_cast<std::size_t>(p.like)] * p.normal;
    return !visibility.detour(p.x + off, p.x - off);
  });
  return add_at(places, cloud, conditions, pairs);
}

}  // namespace brainshift::solve
