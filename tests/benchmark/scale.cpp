// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a cloud of so many nodes costs: seconds of each part of the set-up, seconds a step, bytes held and the most that
// was held at once.
//
//   scale OUT.csv NODES       (appends a row; makes the file and its header where it is not)
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "solve/prepare.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/shape/consistent_derivatives.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/benchmark/bodies.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::solve;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Named figures in the order in which they were measured: a row of the CSV.
using Row = std::vector<std::pair<std::string, double>>;

/// Bytes of the process, "VmHWM" the most since forget_peak(), "VmRSS" now; 0 where the system does not say.
double process_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) {
      return 1024 * std::atof(line.c_str() + key.size() + 1);
    }
  }
  return 0;
}

void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// Runs a part; its seconds and the process's peak while it ran go into the row.
template <class Part>
auto measured(Row& row, const std::string& name, const Part& part) {
  forget_peak();
  const double start = now();
  auto result = part();
  row.emplace_back(name + "_s", now() - start);
  row.emplace_back(name + "_peak_bytes", process_bytes("VmHWM"));
  return result;
}

/// The least seconds of an evaluation of the internal force, at rest.
double force_seconds(const Prepared& prepared) {
  const NodalVectors parameters(4 * prepared.points.nodes(), 0.0);
  NodalVectors force(parameters.size(), 0.0);
  ForceScratch scratch(prepared.points, prepared.laws);
  double least = 1e9;
  for (int i = 0; i < 7; ++i) {
    const double start = now();
    internal_force(prepared.points, prepared.laws, parameters, scratch, force);
    least = std::min(least, now() - start);
  }
  return least;
}

/// The median seconds a step between two reports of the solver's progress.
double step_seconds(const bench::Body& body, Prepared prepared, Row& row) {
  SolveOptions options = body.options;
  options.max_steps = 60;
  std::vector<std::pair<int, double>> reports;
  const SolveResult result = step(body.model, options, std::move(prepared), {}, [&](double, std::string_view what) {
    if (what.starts_with("step ")) {
      reports.emplace_back(std::atoi(std::string(what).c_str() + 5), now());
    }
  });
  std::vector<double> seconds;
  for (std::size_t i = 1; i < reports.size(); ++i) {
    if (reports[i].first > reports[i - 1].first) {
      seconds.push_back((reports[i].second - reports[i - 1].second) / (reports[i].first - reports[i - 1].first));
    }
  }
  const HeldBytes& held = result.measures.bytes;
  row.emplace_back("held_shape_functions", held.shape_functions);
  row.emplace_back("held_nodal_vectors", held.nodal_vectors);
  row.emplace_back("held_pressure_patches", held.pressure_patches);
  row.emplace_back("held_essential_conditions", held.essential_conditions);
  row.emplace_back("held", held.total());
  std::sort(seconds.begin(), seconds.end());
  return seconds.empty() ? 0 : seconds[seconds.size() / 2];
}

/// The parts of prepare() that cost most, one by one, as it runs them.
void measure_parts(const bench::Body& body, Row& row) {
  const OrderedCloud cloud = measured(row, "order_nodes", [&] { return order_nodes(body.model.cloud); });
  const IntegrationPoints points = measured(row, "integration_points", [&] {
    return integration_points(body.model.cells, body.options.points_per_cell, nullptr, std::vector<std::int32_t>{1});
  });
  const ShapeFunctions shape(cloud.positions, cloud.spacing, body.options.shape);
  ShapeRows rows = measured(row, "shape_functions", [&] { return shape.evaluate(points.positions, true); });
  const ShapeRows nodal =
      measured(row, "nodal_shape_functions", [&] { return shape.evaluate(cloud.positions, false); });
  measured(row, "correction", [&] {
    return make_derivatives_consistent(cloud.positions, surface_nodes(cloud), nodal, points.volume,
                                       body.options.consistency_defect, rows);
  });
}

Row measure(std::size_t nodes) {
  Row row;
  bench::Body body =
      measured(row, "discretise", [&] { return bench::ellipsoid(nodes, bench::published_cells_per_node); });
  bench::as_published(body.options);
  SolveMeasures measures;
  Prepared prepared = measured(row, "prepare", [&] { return prepare(body.model, body.options, {}, measures, {}); });
  row.emplace_back("nodes", measures.nodes);
  row.emplace_back("points", measures.integration_points);
  row.emplace_back("pairs", measures.pairs);
  row.emplace_back("bytes_read_a_step", bench::bytes_read(prepared.points));
  row.emplace_back("force_s", force_seconds(prepared));
  row.emplace_back("step_s", measured(row, "stepping", [&] { return step_seconds(body, std::move(prepared), row); }));
  row.emplace_back("threads", omp_get_max_threads());
  measure_parts(body, row);
  return row;
}

bool append(const std::filesystem::path& file, const Row& row) {
  const bool is_new = !std::filesystem::exists(file);
  std::ofstream csv(file, std::ios::app);
  csv.precision(10);
  const char* separator = "";
  for (const auto& [name, value] : row) {
    if (is_new) {
      csv << separator << name;
      separator = ",";
    }
  }
  csv << (is_new ? "\n" : "");
  separator = "";
  for (const auto& [name, value] : row) {
    csv << separator << value;
    separator = ",";
  }
  return static_cast<bool>(csv << '\n' << std::flush);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: scale OUT.csv NODES\n");
    return 2;
  }
  const Row row = measure(static_cast<std::size_t>(std::atoi(argv[2])));
  for (const auto& [name, value] : row) {
    std::printf("%-32s %g\n", name.c_str(), value);
  }
  return append(argv[1], row) ? 0 : 1;
}
