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

struct Count {
  double surface;
  double interior;
  double total() const { return surface + interior; }
};

Count count_at(double area, double volume_inside, double spacing) {
  const double surface = nodes_per_square * area / (spacing * spacing);
  const double interior = nodes_per_cube * volume_inside / (spacing * spacing * spacing) - surface_share * surface;
  return {surface, std::max(0.0, interior)};
}

/// The spacing at which the body takes `nodes`: the count falls with it.
double spacing_for(double area, double volume_inside, double nodes) {
  double low = std::cbrt(volume_inside / nodes) * 0.1;
  double high = std::cbrt(volume_inside / nodes) * 10 + std::sqrt(area / nodes) * 10;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (count_at(area, volume_inside, middle).total() > nodes ? low : high) = middle;
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
  if (demand.surface_nodes + demand.interior_nodes < fewest_nodes) {
    throw std::invalid_argument("a spacing of " + std::to_string(demand.spacing) +
                                " mm is too coarse for this body: it takes " +
                                std::to_string(demand.surface_nodes + demand.interior_nodes) + " nodes, and at least " +
                                std::to_string(fewest_nodes) + " are needed; ask for a finer spacing.");
  }
}

}  // namespace

NodeDemand node_demand(const Surface& surface, const Scanlines& body, const LabelMap* labels,
                       const DiscretiseOptions& options) {
  const auto nodes = static_cast<double>(options.nodes.value_or(default_nodes));
  NodeDemand demand;
  double area = surface_demand(surface, demand.sizing);
  double inside = volume_demand(surface, body, demand.sizing);
  demand.spacing = options.spacing ? *options.spacing : spacing_for(area, inside, nodes);
  // The field depends on the spacing (how far a fine place reaches) and the spacing on the field.
  for (int round = 0; round < 4; ++round) {
    demand.sizing = sizing_field(surface, labels, options, demand.spacing);
    if (demand.sizing.is_uniform()) {
      break;
    }
    area = surface_demand(surface, demand.sizing);
    inside = volume_demand(surface, body, demand.sizing);
    if (options.spacing) {
      break;
    }
    demand.spacing = spacing_for(area, inside, nodes);
  }
  const Count count = count_at(area, inside, demand.spacing);
  demand.surface_nodes = static_cast<std::size_t>(std::min(count.surface, most_nodes));
  demand.interior_nodes = static_cast<std::size_t>(std::min(count.interior, most_nodes));
  if (!options.spacing && demand.surface_nodes < options.nodes.value_or(default_nodes)) {
    demand.interior_nodes = options.nodes.value_or(default_nodes) - demand.surface_nodes;
  }
  check(demand, count.total());
  return demand;
}

}  // namespace brainshift::discretise
