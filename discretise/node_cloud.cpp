// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/node_cloud.hpp"

#include <vtkPointData.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "discretise/neighbours/neighbour_distance.hpp"
#include "discretise/vtu/vtu_file.hpp"

namespace brainshift {
namespace {

/// Nearer than this fraction of the mean distance to their neighbours, two nodes are in one place.
constexpr double same_place = 1e-6;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::invalid_argument(file.string() + ": " + why);
}

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

void check_spacing(const std::filesystem::path& file, const std::vector<double>& spacing) {
  for (std::size_t node = 0; node < spacing.size(); ++node) {
    if (!(spacing[node] > 0 && std::isfinite(spacing[node]))) {
      refuse(file, "node " + std::to_string(node) + " has spacing " + std::to_string(spacing[node]) +
                       "; a positive length in mm is expected.");
    }
  }
}

Points prescribed(const std::filesystem::path& file, vtkPointData& data, std::size_t nodes) {
  const std::vector<double> values = vtu::array(file, data, "prescribed_displacement", nodes, 3);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isinf(values[i])) {
      refuse(file, "the prescribed_displacement of node " + std::to_string(i / 3) +
                       " is infinite; a length in mm, or NaN for a free component, is expected.");
    }
  }
  return Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

Points forces(const std::filesystem::path& file, vtkPointData& data, std::size_t nodes) {
  const std::vector<double> values = vtu::array(file, data, "force", nodes, 3);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      refuse(file, "the force on node " + std::to_string(i / 3) + " is not finite; newtons are expected, 0 for none.");
    }
  }
  return Eigen::Map<const Points>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

void add_vectors(vtkPointData& data, const char* name, const Points& values) {
  if (values.rows() > 0) {
    vtu::add_array(data, name, {values.data(), static_cast<std::size_t>(values.size())}, 3);
  }
}

}  // namespace

NodeCloud read_node_cloud(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  NodeCloud cloud;
  cloud.positions = vtu::points(file, *grid, "node");
  const std::size_t nodes = cloud.size();
  if (nodes < 2) {
    refuse(file, "there are " + std::to_string(nodes) + " nodes; a cloud has at least two.");
  }
  const NearestNeighbours neighbours = nearest_neighbours(cloud.positions, 6);
  const std::vector<double> mean_distance = mean_neighbour_distance(neighbours);
  check_distinct(file, neighbours, mean_distance);

  vtkPointData& data = *grid->GetPointData();
  cloud.spacing = vtu::array(file, data, "spacing", nodes);
  if (cloud.spacing.empty()) {
    cloud.spacing = mean_distance;
  }
  check_spacing(file, cloud.spacing);
  cloud.on_surface.assign(nodes, 0);
  const std::vector<double> on_surface = vtu::array(file, data, "on_surface", nodes);
  for (std::size_t node = 0; node < on_surface.size(); ++node) {
    cloud.on_surface[node] = on_surface[node] != 0 ? 1 : 0;
  }
  cloud.label = vtu::whole_number_array(file, data, "label", nodes, "node");
  if (cloud.label.empty()) {
    cloud.label.assign(nodes, 1);
  }
  cloud.prescribed_displacement = prescribed(file, data, nodes);
  cloud.force = forces(file, data, nodes);
  return cloud;
}

void write_node_cloud(const std::filesystem::path& file, const NodeCloud& cloud) {
  const auto grid = vtu::vertex_grid(cloud.positions);
  vtkPointData& data = *grid->GetPointData();
  vtu::add_array(data, "spacing", cloud.spacing);
  vtu::add_array(data, "on_surface", cloud.on_surface);
  vtu::add_array(data, "label", cloud.label);
  add_vectors(data, "prescribed_displacement", cloud.prescribed_displacement);
  add_vectors(data, "force", cloud.force);
  vtu::write(file, *grid);
}

}  // namespace brainshift
