// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/reference.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "solve/output/field_difference.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::verification {

namespace {

std::ifstream open_reference(const std::string& file) {
  const std::string path = BRAINSHIFT_REFERENCES "/" + file;
  std::ifstream in(path);
  if (!in) {
    throw std::invalid_argument(path + ": cannot be read");
  }
  return in;
}

}  // namespace

std::vector<std::vector<double>> read_rows(const std::string& file) {
  std::ifstream in = open_reference(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || std::isalpha(static_cast<unsigned char>(line[0]))) {
      continue;
    }
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    rows.emplace_back();
    for (double value = 0; fields >> value;) {
      rows.back().push_back(value);
    }
  }
  return rows;
}

std::string comment_of(const std::string& file, const std::string& key) {
  std::ifstream in = open_reference(file);
  const std::string start = "# " + key;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(start)) {
      return line.substr(start.size());
    }
  }
  return {};
}

Reference read_reference(const std::string& name, const std::string& force_name) {
  Reference reference;
  const auto rows = read_rows(name + ".csv");
  const auto count = static_cast<Eigen::Index>(rows.size());
  reference.positions.resize(count, 3);
  reference.displacement.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::vector<double>& row = rows[static_cast<std::size_t>(i)];
    reference.positions.row(i) << row[0], row[1], row[2];
    reference.displacement.row(i) << row[3], row[4], row[5];
  }
  if (!force_name.empty()) {
    for (const std::vector<double>& row : read_rows(force_name + ".csv")) {
      reference.travel.push_back(row[0]);
      reference.force.push_back(row[1]);
    }
  }
  reference.converged_force = std::stod(comment_of(name + ".csv", "converged_force:"));
  reference.error = "CalculiX;" + comment_of(name + ".csv", "error:");
  return reference;
}

Points displacement_at(const Solution& solution, const Points& positions) {
  const solve::ShapeFunctions shape = shape_functions(solution);
  return shape.interpolate(positions,
                           solve::parameters_from_displacement(shape, solution.positions, solution.displacement));
}

Differences differences(const Solution& solution, const Points& positions, const Points& displacement) {
  const Eigen::VectorXd norms = (displacement_at(solution, positions) - displacement).rowwise().norm();
  std::vector<double> sorted(norms.begin(), norms.end());
  std::sort(sorted.begin(), sorted.end());
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  return {sorted.back(), sorted[sorted.size() * 95 / 100], sum / static_cast<double>(sorted.size())};
}

}  // namespace brainshift::verification
