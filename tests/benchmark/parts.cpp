// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a part of a model costs that is there, and one that is not: bytes of the heap while stepping and seconds of
// processor time a step, all threads together, on an ellipsoid as large as a brain. Prints a table in Markdown and
// writes it as CSV.
//
//   parts OUT.csv [nodes [repeats]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "discretise/discretise.hpp"
#include "solve/cut/walled_resection.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "tests/benchmark/heap.hpp"
#include "tests/benchmark/problems.hpp"
#include "tests/benchmark/step_times.hpp"
#include "tests/unit/discretise/bodies.hpp"

using namespace brainshift;
using namespace brainshift::solve;

namespace {

constexpr int steps = 200;

/// Adds the part to a model without it, or to one and its options.
using Add = std::function<void(Model&, SolveOptions&)>;

/// One row of the table. What `with` and `without` share, both are given.
struct Part {
  std::string name;
  Add shared;
  Add with;
};

void nothing(Model&, SolveOptions&) {}

void in_time(Model& model, SolveOptions& options) {
  options.dynamics = Dynamics::transient;
  options.damping = 20;
  model.curve = LoadCurve({0, 0.2}, {0, 1}, LoadCurve::Join::smooth);
}

/// A sheet from the side to the middle, beside what sinks.
Cut sheet() {
  Cut cut;
  cut.name = "sheet";
  cut.vertices.resize(4, 3);
  cut.vertices << 35, -70, -30, 35, 70, -30, 35, 70, 70, 35, -70, 70;
  cut.triangles.resize(2, 3);
  cut.triangles << 0, 1, 2, 0, 2, 3;
  return cut;
}

void cut_open(Model& model, SolveOptions&) {
  model.cuts = {sheet()};
}

/// To be cut long after the steps that are timed.
void to_be_cut(Model& model, SolveOptions&) {
  model.cuts = {sheet()};
  model.cuts[0].time = {0.9, 0.9, 1, 1};
}

/// A cavity of 30 mm beside what sinks.
Surface cavity() {
  return test::ball(15, {35, 0, -15}, 4);
}

void know_the_cavity(Model& model, SolveOptions&) {
  model = bench::ellipsoid(model.cloud.size(), discretise::DiscretiseOptions().cells_per_node, cavity()).model;
  model.boundary = bench::ellipsoid_surface(0);
}

void three_materials(Model& model, SolveOptions&) {
  model.materials[2] = model.materials[3] = model.materials[1];
  for (std::size_t i = 0; i < model.cells.size(); ++i) {
    const auto corner = static_cast<Eigen::Index>(model.cells.connectivity[i * 8]);
    model.cells.label[i] =
        1 + static_cast<std::int32_t>(std::clamp(model.cells.vertices(corner, 0) / 50 + 1.5, 0.0, 2.9));
  }
}

std::vector<Part> parts() {
  return {
      {"contact", nothing, [](Model& m, SolveOptions&) { m.skull = bench::ellipsoid_surface(0.5); }},
      {"viscosity, two Prony terms (transient)", in_time,
       [](Model& m, SolveOptions&) {
         m.materials[1].prony = {{0.450, 0.50}, {0.365, 50}};
       }},
      {"gravity", nothing,
       [](Model& m, SolveOptions&) {
         m.gravity = {0, 0, -9.81};
       }},
      {"drained fluid", nothing,
       [](Model& m, SolveOptions&) {
         m.fluid = DrainedFluid{.gravity = {0, 0, -9.81}, .gravity_of_image = {0, 0, -9.81}};
       }},
      {"swelling", nothing, [](Model& m, SolveOptions&) { m.materials[1].swelling = 0.05; }},
      {"forces at nodes", nothing,
       [](Model& m, SolveOptions&) { m.conditions.force = Points::Constant(m.cloud.positions.rows(), 3, 1e-6); }},
      {"pressure patches (absent: pointwise)", [](Model&, SolveOptions& o) { o.volumetric = Volumetric::pointwise; },
       [](Model&, SolveOptions& o) { o.volumetric = Volumetric::mean_dilatation; }},
      {"a cut", nothing, cut_open},
      {"a cut that goes on", nothing, to_be_cut},
      {"a septum", nothing,
       [](Model& m, SolveOptions&) {
         m.septum = Septum{"sheet", {sheet().vertices, sheet().triangles}};
       }},
      {"a resection with a wall", know_the_cavity,
       [](Model& m, SolveOptions&) { m.resection = Resection{.labels = {2}, .wall = cavity()}; }},
      {"three materials (absent: one of the same constants)", nothing, three_materials}};
}

/// Bytes that the heap holds while a body is stepped. To be called after a first prepare(), which leaves the threads
/// their scratch.
double held_bytes(const Model& model, const SolveOptions& options) {
  const double before = bench::heap_in_use();
  SolveMeasures measures;
  Prepared prepared = prepare(model, options, {}, measures, {});
  Motion motion(std::move(prepared.body), 0);
  motion.weigh(std::vector<double>(motion.body.nodes(), 1.0));
  return bench::heap_in_use() - before;
}

struct Case {
  Model model;
  SolveOptions options;
  SolveMeasures measures;
  Prepared prepared;
  double bytes;                 ///< of the heap, while it is stepped
  std::vector<double> seconds;  ///< a step, between one report of progress and the next

  Case(const Model& base, const Part& part, bool with) : model(base) {
    options.max_steps = steps;
    part.shared(model, options);
    if (with) {
      part.with(model, options);
    }
    if (model.resection) {
      Resected resected = resect_within_wall(model);
      model = std::move(resected.rest);
      measures.resection = resected.measures;
    }
    prepared = prepare(model, options, {}, measures, {});
    bytes = held_bytes(model, options);
  }

  /// Once through the steps.
  void run() {
    bench::StepTimes times;
    const SolveResult result = step_to_end(model, options, prepared, measures, {}, [&](double, std::string_view what) {
      times.note(what, static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    });
    std::ranges::copy(times.seconds(), std::back_inserter(seconds));
    if (seconds.empty()) {
      throw std::runtime_error("too few steps to be timed: " + result.failure);
    }
  }
  double median() {
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "usage: parts OUT.csv [nodes [repeats]]\n");
    return 2;
  }
  const std::size_t nodes = argc > 2 ? static_cast<std::size_t>(std::atoi(argv[2])) : 10000;
  const Model base = bench::ellipsoid(nodes, discretise::DiscretiseOptions().cells_per_node).model;
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 5;
  std::ofstream csv(argv[1]);
  csv.precision(12);
  csv << "part,bytes_absent,bytes_present,seconds_a_step_absent,seconds_a_step_present,ratio\n";
  std::printf(
      "| part | bytes, absent | present | processor ms a step, absent | present | ratio |\n| --- | --- | --- | --- | "
      "--- | --- "
      "|\n");
  for (const Part& part : parts()) {
    Case without(base, part, false), with(base, part, true);
    for (int i = 0; i < repeats; ++i) {  // in turn, so that what else the machine does falls on both
      without.run();
      with.run();
    }
    const double absent = without.median(), present = with.median();
    csv << '"' << part.name << "\"," << without.bytes << ',' << with.bytes << ',' << absent << ',' << present << ','
        << present / absent << '\n';
    std::printf("| %s | %.0f | %.0f | %.2f | %.2f | %.2f |\n", part.name.c_str(), without.bytes, with.bytes,
                1e3 * absent, 1e3 * present, present / absent);
    std::fflush(stdout);
  }
  return csv.flush() ? 0 : 1;
}
