// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/node_demand.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "discretise/cloud/interior_nodes.hpp"
#include "discretise/cloud/surface_nodes.hpp"

namespace brainshift::discretise {
namespace {

/// Nodes in a cube of the spacing's edge, and on a square of it: with these the mean distance of a node to its six
/// nearest is the spacing (measured on a ball and on brains).
constexpr double nodes_per_cube = 1.13;
constexpr double nodes_per_square = 1.1;
/// The part of a surface node's cell that would otherwise take an interior node.
constexpr double surface_share = 0.5;

constexpr std::size_t default_nodes = 12000;
constexpr std::size_t fewest_nodes = 30;
constexpr double most_nodes = 20e6;

/// What takes nodes, after the sizing field.
struct Room {
  double surface;  ///< mm²
  double wall;     ///< mm²
  double volume;   ///< mm³
};

struct Count {
  double surface;
  double wall;
  double interior;
  double total() const { return surface + wall + interior; }
};

/// A node on a wall has a cell on both sides: it takes the place of one in the interior.
Count count_at(const Room& room, double spacing) {
  const double surface = nodes_per_square * room.surface / (spacing * spacing);
  const double wall = nodes_per_square * room.wall / (spacing * spacing);
  const double interior = nodes_per_cube * room.volume / (spacing * spacing * spacing) - surface_share * surface - wall;
  return {surface, wall, std::max(0.0, interior)};
}

Room room_of(const Surface& surface, const Surface& wall, const Scanlines& body, const SizingField& sizing) {
  return {surface_demand(surface, sizing), surface_demand(wall, sizing), volume_demand(surface, body, sizing)};
}

/// The spacing at which the body takes `nodes`: the count falls with it.
double spacing_for(const Room& room, double nodes) {
  double low = std::cbrt(room.volume / nodes) * 0.1;
  double high = std::cbrt(room.volume / nodes) * 10 + std::sqrt(room.surface / nodes) * 10;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (count_at(room, middle).total() > nodes ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void check(const NodeDemand& demand, double total) {
  if (total > most_nodes) {
    throw std::invalid_argument("a spacing of " + std::to_string(demand.spacing) + " mm takes " +
                                std::to_string(total / 1e6) +
                                " million nodes, more than 20 million; ask for a coarser "
                                "spacing.");
  }
  if (demand.surface_nodes + demand.wall_nodes + demand.interior_nodes < fewest_nodes) {
    throw std::invalid_argument(
        "a spacing of " + std::to_string(demand.spacing) + " mm is too coarse for this body: it takes " +
        std::to_string(demand.surface_nodes + demand.wall_nodes + demand.interior_nodes) + " nodes, and at least " +
        std::to_string(fewest_nodes) + " are needed; ask for a finer spacing.");
  }
}

}  // namespace

NodeDemand node_demand(const Surface& surface, const Surface& wall, const Scanlines& body, const LabelMap* labels,
                       const DiscretiseOptions& options) {
  const auto nodes = static_cast<double>(options.nodes.value_or(default_nodes));
  NodeDemand demand;
  Room room = room_of(surface, wall, body, demand.sizing);
  demand.spacing = options.spacing ? *options.spacing : spacing_for(room, nodes);
  const auto sizing_at = sizing_by_spacing(surface, labels, options);
  // The field depends on the spacing (how far a fine place reaches) and the spacing on the field.
  for (int round = 0; round < 4; ++round) {
    demand.sizing = sizing_at(demand.spacing);
    if (demand.sizing.is_uniform()) {
      break;
    }
    room = room_of(surface, wall, body, demand.sizing);
    if (options.spacing) {
      break;
    }
    demand.spacing = spacing_for(room, nodes);
  }
  const Count count = count_at(room, demand.spacing);
  demand.surface_nodes = static_cast<std::size_t>(std::min(count.surface, most_nodes));
  demand.wall_nodes = static_cast<std::size_t>(std::min(count.wall, most_nodes));
  demand.interior_nodes = static_cast<std::size_t>(std::min(count.interior, most_nodes));
  const std::size_t on_surfaces = demand.surface_nodes + demand.wall_nodes;
  if (!options.spacing && on_surfaces < options.nodes.value_or(default_nodes)) {
    demand.interior_nodes = options.nodes.value_or(default_nodes) - on_surfaces;
  }
  check(demand, count.total());
  return demand;
}

}  // namespace brainshift::discretise
