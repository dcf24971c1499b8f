// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

#include "solve/force/internal_force.hpp"
#include "solve/force/patch_dilatation.hpp"

namespace brainshift::solve {

namespace {

constexpr double much_softer = 100;   // ratio of shear moduli from which on a neighbour is worth naming
constexpr double much_swollen = 0.2;  // share of a tissue's volume from which on its swelling is worth naming

/// Calls use(point, node) for all pairs of a patch's points and the nodes they see, patch by patch.
template <class Use>
void for_each_pair(const PointBlocks& points, const Use& use) {
  for (const Block& block : points.blocks) {
    for (std::int32_t i = block.first_patch; i < block.last_patch; ++i) {
      const Patch& patch = points.patches[static_cast<std::size_t>(i)];
      for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
        for (const std::uint16_t slot : points.slots_of(p)) {
          use(patch, p, points.slot_node[static_cast<std::size_t>(block.first_slot) + slot]);
        }
      }
    }
  }
}

/// Cosine of the last two increments over these nodes; −1: they go there and back.
double alignment(const std::vector<std::int32_t>& nodes, const LastSteps& steps) {
  double product = 0, last = 0, earlier = 0;
  for (const std::int32_t node : nodes) {
    const auto a = static_cast<std::size_t>(node);
    const Eigen::Vector4d now = at(steps.now, a) - at(steps.before, a);
    const Eigen::Vector4d before = at(steps.before, a) - at(steps.earlier, a);
    product += now.dot(before);
    last += now.squaredNorm();
    earlier += before.squaredNorm();
  }
  return product / std::sqrt(last * earlier);
}

bool swing(const std::vector<std::int32_t>& nodes, const LastSteps& steps) {
  return alignment(nodes, steps) < -0.5;
}

/// The softest and the stiffest tissue about a node.
struct Neighbours {
  double softest = std::numeric_limits<double>::infinity(), stiffest = 0;  // shear modulus, Pa
  std::int32_t soft_point = 0, stiff_point = 0;
};

/// The nodes that the points that see a node see: what lies beside it, though it may be hidden from some of that.
std::set<std::int32_t> nodes_about(const PointBlocks& points, std::int32_t node) {
  std::set<std::int32_t> about_node;
  std::vector<std::int32_t> of_point;
  std::int32_t last = -1;
  const auto take = [&] {
    if (std::ranges::find(of_point, node) != of_point.end()) {
      about_node.insert(of_point.begin(), of_point.end());
    }
    of_point.clear();
  };
  for_each_pair(points, [&](const Patch&, std::int32_t point, std::int32_t seen) {
    if (point != last) {
      take();
      last = point;
    }
    of_point.push_back(seen);
  });
  take();
  return about_node;
}

Neighbours neighbours(const PointBlocks& points, const PointLaws& laws, std::int32_t node) {
  const std::set<std::int32_t> about = nodes_about(points, node);
  Neighbours found;
  for_each_pair(points, [&](const Patch& patch, std::int32_t point, std::int32_t seen) {
    if (!about.contains(seen)) {
      return;
    }
    const double modulus = std::visit([](const auto& law) { return law.shear_modulus; },
                                      laws.elastic[static_cast<std::size_t>(patch.material)]);
    if (modulus < found.softest) {
      found.softest = modulus;
      found.soft_point = point;
    }
    if (modulus > found.stiffest) {
      found.stiffest = modulus;
      found.stiff_point = point;
    }
  });
  return found;
}

std::string cause(const Fault& fault, std::int32_t node, const Body& body) {
  if (fault.swings) {
    return "the step is too long for the stiffness there, the node swings there and back from step to step; take a "
           "smaller time step";
  }
  if (std::ranges::any_of(body.laws.swelling, [](double share) { return std::abs(share) >= much_swollen; })) {
    return "a tissue swells by more than what is around it makes room for; take a smaller swelling";
  }
  const Neighbours n = neighbours(body.points, body.laws, node);
  if (n.stiffest >= much_softer * n.softest) {
    std::ostringstream text;
    const auto tissue = [&](std::int32_t point) { return body.placed.tissue[static_cast<std::size_t>(point)]; };
    text << "tissue " << tissue(n.soft_point) << " is " << n.stiffest / n.softest << " times softer than tissue "
         << tissue(n.stiff_point) << " beside it; check the materials, or put more nodes there";
    return text.str();
  }
  return fault.fast ? "the load comes too fast; spread it over more steps, or more time"
                    : "the load is too large for the nodes there; put more nodes there, or take a smaller load";
}

}  // namespace

Fault broken_point(const PointBlocks& points, const ForceScratch& scratch, const LastSteps& steps) {
  Fault fault;
  double least = std::numeric_limits<double>::infinity();
  for (const Patch& patch : points.patches) {
    std::int32_t point = patch.first_point;
    for (const Eigen::Matrix3d& gradient : gradients_of(points, patch, scratch)) {
      const double jacobian = gradient.determinant();
      if (!(jacobian >= least) && !std::isnan(least)) {
        least = jacobian;
        fault.point = point;
      }
      ++point;
    }
  }
  std::vector<std::int32_t> support;
  for_each_pair(points, [&](const Patch&, std::int32_t point, std::int32_t node) {
    if (point == fault.point) {
      support.push_back(node);
    }
  });
  fault.swings = swing(support, steps);
  return fault;
}

Fault restless_node(const LastSteps& steps) {
  Fault fault;
  double most = -1;
  for (std::size_t a = 0; a < steps.now.size() / 4; ++a) {
    const double change = (at(steps.now, a) - 2 * at(steps.before, a) + at(steps.earlier, a)).norm();
    if (!std::isfinite(change)) {
      fault.node = static_cast<std::int32_t>(a);
      return fault;
    }
    if (change > most) {
      most = change;
      fault.node = static_cast<std::int32_t>(a);
    }
  }
  fault.swings = swing({fault.node}, steps);
  return fault;
}

std::string describe(const Fault& fault, const Body& body) {
  std::int32_t node = fault.node;
  std::ostringstream text;
  const Eigen::IOFormat coordinates(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ") mm");
  text << "at ";
  if (fault.point >= 0) {
    const Eigen::RowVector3d place = body.placed.position.row(fault.point);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < body.original.size(); ++a) {
      const double distance = (body.positions.row(body.original[a]) - place).squaredNorm();
      node = distance < nearest ? static_cast<std::int32_t>(a) : node;
      nearest = std::min(nearest, distance);
    }
    text << "the integration point " << place.format(coordinates) << ", tissue "
         << body.placed.tissue[static_cast<std::size_t>(fault.point)] << ", next to ";
  }
  const std::int32_t original = body.original[static_cast<std::size_t>(node)];
  text << "node " << original << ", " << body.positions.row(original).format(coordinates);
  if (!fault.explained) {
    text << "; likely cause: " << cause(fault, node, body);
  }
  return text.str();
}

}  // namespace brainshift::solve
