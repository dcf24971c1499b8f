// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/node_cloud.hpp"

#include <vtkPointData.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "segmentation/files/naming.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/geometry/neighbour_distance.hpp"

namespace brainshift {
namespace {

/// Nearer than this fraction of the mean distance to their neighbours, two nodes are in one place.
constexpr double same_place = 1e-6;

void check_distinct(const std::filesystem::path& file, const NearestNeighbours& neighbours,
                    const std::vector<double>& mean_distance) {
  const auto width = static_cast<std::size_t>(neighbours.count);
  for (std::size_t node = 0; node < mean_distance.size(); ++node) {
    if (!(neighbours.distance[node * width] > same_place * mean_distance[node])) {
      refuse(file, "nodes " + std::to_string(node) + " and " + std::to_string(neighbours.index[node * width]) +
                       " are in one place; remove one of them.");
    }
  }
}

void check_count(std::size_t nodes) {
  if (nodes < 2) {
    throw std::invalid_argument("there are " + std::to_string(nodes) + " nodes; a cloud has at least two.");
  }
}

}  // namespace

void check_nodes(const NodeCloud& cloud) {
  const std::size_t nodes = cloud.size();
  check_count(nodes);
  if (cloud.spacing.size() != nodes || cloud.on_surface.size() != nodes) {
    throw std::invalid_argument("of " + std::to_string(nodes) + " nodes spacing has " +
                                std::to_string(cloud.spacing.size()) + " entries and on_surface " +
                                std::to_string(cloud.on_surface.size()) + "; one a node is expected.");
  }
  for (std::size_t node = 0; node < nodes; ++node) {
    if (!cloud.positions.row(static_cast<Eigen::Index>(node)).allFinite()) {
      throw std::invalid_argument("the position of node " + std::to_string(node) + " is not finite.");
    }
    if (!(cloud.spacing[node] > 0 && std::isfinite(cloud.spacing[node]))) {
      throw std::invalid_argument("node " + std::to_string(node) + " has spacing " +
                                  std::to_string(cloud.spacing[node]) + "; a positive length in mm is expected.");
    }
  }
}

NodeCloud read_node_cloud(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  NodeCloud cloud;
  cloud.positions = vtu::points(file, *grid, "node");
  const std::size_t nodes = cloud.size();
  naming(file.string(), [&] { check_count(nodes); });
  const NearestNeighbours neighbours = nearest_neighbours(cloud.positions, 6);
  const std::vector<double> mean_distance = mean_neighbour_distance(neighbours);
  check_distinct(file, neighbours, mean_distance);

  vtkPointData& data = *grid->GetPointData();
  cloud.spacing = vtu::array(file, data, "spacing", nodes);
  if (cloud.spacing.empty()) {
    cloud.spacing = mean_distance;
  }
  cloud.on_surface.assign(nodes, 0);
  const std::vector<double> on_surface = vtu::array(file, data, "on_surface", nodes);
  for (std::size_t node = 0; node < on_surface.size(); ++node) {
    cloud.on_surface[node] = on_surface[node] != 0 ? 1 : 0;
  }
  naming(file.string(), [&] { check_nodes(cloud); });
  return cloud;
}

std::vector<std::int32_t> surface_nodes(const NodeCloud& cloud) {
  std::vector<std::int32_t> nodes;
  for (std::size_t a = 0; a < cloud.on_surface.size(); ++a) {
    if (cloud.on_surface[a] != 0) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

double mean_spacing(const NodeCloud& cloud) {
  return std::accumulate(cloud.spacing.begin(), cloud.spacing.end(), 0.0) / static_cast<double>(cloud.size());
}

void write_node_cloud(const std::filesystem::path& file, const NodeCloud& cloud, std::span<const NodeVectors> vectors) {
  const auto grid = vtu::vertex_grid(cloud.positions);
  vtkPointData& data = *grid->GetPointData();
  vtu::add_array(data, "spacing", cloud.spacing);
  vtu::add_array(data, "on_surface", cloud.on_surface);
  for (const auto& [name, values] : vectors) {
    vtu::add_array(data, name, {values.data(), static_cast<std::size_t>(values.size())}, 3);
  }
  vtu::write(file, *grid);
}

}  // namespace brainshift
