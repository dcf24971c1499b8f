// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a cloud of so many nodes costs: seconds of each part of the set-up, seconds a step, bytes held and the most that
// was held at once.
//
//   scale OUT.csv NODES       (appends a row; makes the file and its header where it is not)
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "segmentation/progress/stopwatch.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/force/internal_force.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "solve/shape/consistent_derivatives.hpp"
#include "solve/shape/shape_functions.hpp"
#include "tests/benchmark/heap.hpp"
#include "tests/benchmark/problems.hpp"
#include "tests/benchmark/step_times.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::solve;

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
  const Stopwatch watch;
  auto result = part();
  row.emplace_back(name + "_s", watch.seconds());
  row.emplace_back(name + "_peak_bytes", process_bytes("VmHWM"));
  return result;
}

/// The least seconds of an evaluation of the internal force, at rest.
double force_seconds(const Prepared& prepared) {
  const NodalVectors parameters(4 * prepared.body.points.nodes(), 0.0);
  NodalVectors force(parameters.size(), 0.0);
  ForceScratch scratch(prepared.body.points, prepared.body.laws);
  double least = 1e9;
  for (int i = 0; i < 7; ++i) {
    const Stopwatch watch;
    internal_force(prepared.body.points, prepared.body.laws, parameters, scratch, force);
    least = std::min(least, watch.seconds());
  }
  return least;
}

/// The median seconds a step between two reports of the solver's progress.
double step_seconds(const bench::Problem& problem, Prepared prepared) {
  SolveOptions options = problem.options;
  options.max_steps = 60;
  bench::StepTimes times;
  const Stopwatch watch;
  step_to_end(problem.model, options, std::move(prepared), {}, {},
              [&](double, std::string_view what) { times.note(what, watch.seconds()); });
  std::vector<double> seconds = times.seconds();
  std::sort(seconds.begin(), seconds.end());
  return seconds.empty() ? 0 : seconds[seconds.size() / 2];
}

/// The bytes that the heap holds while a body is stepped, all of them and part by part. To be called after a first
/// prepare(), which leaves the threads their scratch.
void measure_held(const bench::Problem& problem, Row& row) {
  const double before = bench::heap_in_use();
  SolveMeasures measures;
  Prepared prepared = prepare(problem.model, problem.options, {}, measures, {});
  Motion motion(std::move(prepared.body), 0);
  motion.weigh(std::vector<double>(motion.body.nodes(), 1.0));
  const double held = bench::heap_in_use() - before;
  const double pressures = bench::freed(motion.body.points.mode);
  const double shapes =
      bench::freed(motion.body.points) + bench::freed(motion.body.nodal_rows) + bench::freed(motion.body.placed);
  const double conditions = bench::freed(motion.body.essential);
  row.emplace_back("held_shape_functions", shapes);
  row.emplace_back("held_nodal_vectors", held - shapes - pressures - conditions);
  row.emplace_back("held_pressure_patches", pressures);
  row.emplace_back("held_essential_conditions", conditions);
  row.emplace_back("held", held);
}

/// The parts of prepare() that cost most, one by one, as it runs them.
void measure_parts(const bench::Problem& problem, Row& row) {
  const OrderedCloud cloud =
      measured(row, "order_nodes", [&] { return order_nodes(problem.model.cloud, problem.model.conditions); });
  const IntegrationPoints points = measured(row, "integration_points", [&] {
    const BackgroundCells& cells = problem.model.cells;
    return integration_points(cells, points_per_cell(problem.options.points_per_cell, cells.kind, false), nullptr,
                              std::vector<std::int32_t>{1});
  });
  const ShapeFunctions shape(cloud.positions, cloud.spacing, problem.options.shape);
  ShapeRows rows = measured(row, "shape_functions", [&] { return shape.evaluate(points.positions, true); });
  const ShapeRows nodal =
      measured(row, "nodal_shape_functions", [&] { return shape.evaluate(cloud.positions, false); });
  measured(row, "correction", [&] {
    return make_derivatives_consistent(cloud.positions, surface_nodes(cloud), nodal, points.volume,
                                       problem.options.consistency_defect, rows);
  });
}

Row measure(std::size_t nodes) {
  Row row;
  bench::Problem problem =
      measured(row, "discretise", [&] { return bench::ellipsoid(nodes, bench::published_cells_per_node); });
  bench::as_published(problem.options);
  SolveMeasures measures;
  Prepared prepared =
      measured(row, "prepare", [&] { return prepare(problem.model, problem.options, {}, measures, {}); });
  row.emplace_back("nodes", measures.nodes);
  row.emplace_back("points", measures.integration_points);
  row.emplace_back("pairs", measures.pairs);
  row.emplace_back("bytes_read_a_step", bench::bytes_read(prepared.body.points));
  row.emplace_back("force_s", force_seconds(prepared));
  row.emplace_back("step_s", measured(row, "stepping", [&] { return step_seconds(problem, std::move(prepared)); }));
  row.emplace_back("threads", omp_get_max_threads());
  measure_held(problem, row);
  measure_parts(problem, row);
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
