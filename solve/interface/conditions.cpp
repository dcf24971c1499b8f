// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/interface/conditions.hpp"

#include <vtkPointData.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "segmentation/files/naming.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"

namespace brainshift::solve {

namespace {

Eigen::SparseMatrix<double> rows_of(const Eigen::SparseMatrix<double>& matrix, const std::vector<std::int32_t>& rows) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = matrix;
  Eigen::SparseMatrix<double, Eigen::RowMajor> some(static_cast<Eigen::Index>(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    some.row(static_cast<Eigen::Index>(i)) = by_row.row(rows[i]);
  }
  return some;
}

}  // namespace

bool Conditions::is_prescribed(Eigen::Index node, int axis) const {
  return displacement.rows() > 0 && !std::isnan(displacement(node, axis));
}

bool Conditions::is_prescribed(Eigen::Index node) const {
  return displacement.rows() > 0 && !displacement.row(node).array().isNaN().all();
}

bool Conditions::is_held(Eigen::Index node) const {
  return displacement.rows() > 0 && !displacement.row(node).array().isNaN().any();
}

bool Conditions::is_pushed(Eigen::Index node) const {
  return force.rows() > 0 && !force.row(node).isZero();
}

void check_conditions(const Conditions& conditions, std::size_t nodes) {
  for (const Points* const rows : {&conditions.displacement, &conditions.force}) {
    if (rows->rows() > 0 && static_cast<std::size_t>(rows->rows()) != nodes) {
      throw std::invalid_argument("the conditions have " + std::to_string(rows->rows()) + " rows for " +
                                  std::to_string(nodes) + " nodes; one a node is expected.");
    }
  }
  for (Eigen::Index a = 0; a < conditions.displacement.rows(); ++a) {
    if (conditions.displacement.row(a).array().isInf().any()) {
      throw std::invalid_argument("the prescribed_displacement of node " + std::to_string(a) +
                                  " is infinite; a length in mm, or NaN for a free component, is expected.");
    }
  }
  for (Eigen::Index a = 0; a < conditions.force.rows(); ++a) {
    if (!conditions.force.row(a).allFinite()) {
      throw std::invalid_argument("the force on node " + std::to_string(a) +
                                  " is not finite; newtons are expected, 0 for none.");
    }
  }
}

std::vector<std::int32_t> prescribed_nodes(const Conditions& conditions) {
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < conditions.displacement.rows(); ++a) {
    if (conditions.is_prescribed(a)) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

std::size_t count_loaded(const Conditions& conditions) {
  std::size_t loaded = 0;
  for (Eigen::Index a = 0; a < std::max(conditions.displacement.rows(), conditions.force.rows()); ++a) {
    loaded += conditions.is_pushed(a) || conditions.is_prescribed(a) ? 1 : 0;
  }
  return loaded;
}

Conditions subset(const Conditions& conditions, const std::vector<std::int32_t>& nodes) {
  Conditions part;
  part.at_nodes_alone = conditions.at_nodes_alone;
  if (conditions.displacement.rows() > 0) {
    part.displacement = conditions.displacement(nodes, Eigen::all);
  }
  if (conditions.force.rows() > 0) {
    part.force = conditions.force(nodes, Eigen::all);
  }
  if (conditions.measured) {
    part.measured = conditions.measured;
    part.measured->spread = rows_of(conditions.measured->spread, nodes);
    part.measured->extend = {};
  }
  return part;
}

Conditions read_conditions(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  const auto nodes = static_cast<std::size_t>(grid->GetNumberOfPoints());
  vtkPointData& data = *grid->GetPointData();
  const Conditions conditions{.displacement = vtu::vectors(file, data, "prescribed_displacement", nodes),
                              .force = vtu::vectors(file, data, "force", nodes)};
  naming(file.string(), [&] { check_conditions(conditions, nodes); });
  return conditions;
}

void write_nodes(const std::filesystem::path& file, const NodeCloud& cloud, const Conditions& conditions) {
  std::vector<NodeVectors> vectors;
  if (conditions.displacement.rows() > 0) {
    vectors.push_back({"prescribed_displacement", conditions.displacement});
  }
  if (conditions.force.rows() > 0) {
    vectors.push_back({"force", conditions.force});
  }
  write_node_cloud(file, cloud, vectors);
}

}  // namespace brainshift::solve
