// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels of the solve stage, each alone, on one and more threads.
//
//   kernels [--runs SCENE PUBLISHED USUAL] [options of Google Benchmark]
//
// PUBLISHED and USUAL are folders of runs of the scene, discretised with two cells a node and as usual; without them
// small ellipsoids, to see that all runs. seconds_a_pair is time over the pairs of a point and a node of its support
// that were handled.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "solve/force/internal_force.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"
#include "solve/run/prepare.hpp"
#include "solve/shape/consistent_derivatives.hpp"
#include "solve/shape/moving_least_squares.hpp"
#include "solve/shape/node_supports.hpp"
#include "solve/shape/support_search.hpp"
#include "tests/benchmark/problems.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::solve;
using bench::bytes;
using bench::Problem;
using ::benchmark::State;

/// Parameters of a smooth deformation of a few per cent.
NodalVectors bent(const Points& positions) {
  NodalVectors parameters(4 * static_cast<std::size_t>(positions.rows()), 0.0);
  for (Eigen::Index a = 0; a < positions.rows(); ++a) {
    const Eigen::Vector3d x = positions.row(a);
    at(parameters, static_cast<std::size_t>(a)).head<3>() =
        Eigen::Vector3d(std::sin(x.y() / 20), std::cos(x.z() / 25), std::sin(x.x() / 15));
  }
  return parameters;
}

Points ordered_positions(const Model& model, const std::vector<std::int32_t>& original) {
  return model.cloud.positions(original, Eigen::all);
}

/// All that the table knows of the layout of the step: what is prepared, one evaluation, what it reads and handles.
struct Step {
  SolveMeasures measures = {};
  Prepared prepared;
  NodalVectors parameters, force;
  ForceScratch scratch;

  explicit Step(const Problem& problem)
      : prepared(prepare(problem.model, problem.options, {}, measures, {})),
        parameters(bent(ordered_positions(problem.model, prepared.body.original))),
        force(parameters.size(), 0.0),
        scratch(prepared.body.points, prepared.body.laws) {}

  void once() { internal_force(prepared.body.points, prepared.body.laws, parameters, scratch, force); }
  double pairs() const { return static_cast<double>(measures.pairs); }
  double bytes_read() const { return bench::bytes_read(prepared.body.points); }
};

/// What preparing a model makes first, for the kernels of the set-up.
struct SetUp {
  OrderedCloud cloud;
  ShapeOptions shape;
  IntegrationPoints points;

  explicit SetUp(const Problem& problem)
      : cloud(order_nodes(problem.model.cloud, problem.model.conditions)), shape(problem.options.shape) {
    std::vector<std::int32_t> tissues;
    for (const auto& [label, material] : problem.model.materials) {
      tissues.push_back(label);
    }
    const BackgroundCells& cells = problem.model.cells;
    points = integration_points(cells, points_per_cell(problem.options.points_per_cell, cells.kind, false),
                                problem.model.labels ? &*problem.model.labels : nullptr, tissues);
  }
  ShapeFunctions functions() const { return {cloud.positions, cloud.spacing, shape}; }
};

/// Settings of a problem, with what was made of it; made when first asked for.
struct Setting {
  std::string name;
  Problem problem;
  std::shared_ptr<Step> step = {};
  std::shared_ptr<SetUp> set_up = {};

  Step& stepping() {
    step = step ? step : std::make_shared<Step>(problem);
    return *step;
  }
  SetUp& setting_up() {
    set_up = set_up ? set_up : std::make_shared<SetUp>(problem);
    return *set_up;
  }
};

/// What the CSV has in its columns; Google Benchmark wants the same of all rows.
void count(State& state, double handled_pairs, double read) {
  using ::benchmark::Counter;
  const auto inverted = Counter::kIsIterationInvariantRate | Counter::kInvert;
  state.counters["threads"] = omp_get_max_threads();
  state.counters["pairs"] = handled_pairs;
  state.counters["seconds_a_pair"] = Counter(handled_pairs, inverted);
  state.counters["bytes_read"] = read;
  state.counters["bytes_a_second"] = Counter(read, Counter::kIsIterationInvariantRate);
}

void time_step(State& state, Setting& setting) {
  Step& step = setting.stepping();
  step.once();
  for (auto _ : state) {
    step.once();
  }
  count(state, step.pairs(), step.bytes_read());
}

void time_search(State& state, Setting& setting) {
  const SetUp& made = setting.setting_up();
  std::vector<double> radius(made.cloud.spacing);
  for (double& r : radius) {
    r *= dilatation(made.shape);
  }
  std::size_t found = 0;
  for (auto _ : state) {
    const SupportSearch search(made.cloud.positions, radius);
    found = 0;
#pragma omp parallel for schedule(dynamic, 256) reduction(+ : found)
    for (Eigen::Index p = 0; p < made.points.positions.rows(); ++p) {
      thread_local std::vector<std::int32_t> support;
      search.find(made.points.positions.row(p), 1, support);
      found += support.size();
    }
  }
  count(state, static_cast<double>(found), 0);
}

void time_shape_functions(State& state, Setting& setting) {
  const SetUp& made = setting.setting_up();
  ShapeRows rows;
  for (auto _ : state) {
    rows = made.functions().evaluate(made.points.positions, true);
  }
  count(state, static_cast<double>(rows.node.size()), 0);
}

void time_correction(State& state, Setting& setting) {
  const SetUp& made = setting.setting_up();
  const ShapeFunctions functions = made.functions();
  const ShapeRows nodal = functions.evaluate(made.cloud.positions, false);
  const ShapeRows plain = functions.evaluate(made.points.positions, true);
  const std::vector<std::int32_t> surface = surface_nodes(made.cloud);
  for (auto _ : state) {
    state.PauseTiming();
    ShapeRows rows = plain;
    state.ResumeTiming();
    make_derivatives_consistent(made.cloud.positions, surface, nodal, made.points.volume,
                                setting.problem.options.consistency_defect, rows);
  }
  count(state, static_cast<double>(plain.node.size()), 0);
}

void time_conditions(State& state, Setting& setting) {
  Step& step = setting.stepping();
  const std::vector<double> mass(step.prepared.body.points.nodes(), 1.0);
  step.prepared.body.essential.factorise(mass);
  NodalVectors parameters = step.parameters;
  for (auto _ : state) {
    step.prepared.body.essential.apply(0.5, parameters);
  }
  count(state, 0, 0);
}

void time_contact(State& state, Setting& setting) {
  Step& step = setting.stepping();
  const std::vector<double> mass(step.prepared.body.points.nodes(), 1.0);
  step.prepared.body.contact->weigh(mass);
  NodalVectors parameters(step.parameters.size(), 0.0);
  for (auto _ : state) {
    step.prepared.body.contact->apply(parameters);
  }
  count(state, 0, 0);
}

/// The floor: displacement gradients and a stress linear in them, scattered to the nodes, over rows of single-precision
/// derivatives and plain node numbers as a first program would have them.
struct PlainRows {
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> node;
  std::vector<float> derivative, volume, displacement;
  std::vector<std::vector<float>> force;  ///< one a thread

  explicit PlainRows(const SetUp& made) {
    const ShapeRows rows = made.functions().evaluate(made.points.positions, true);
    begin = rows.begin;
    node = rows.node;
    derivative.assign(rows.derivative.begin(), rows.derivative.end());
    volume.assign(made.points.volume.begin(), made.points.volume.end());
    const NodalVectors bend = bent(made.cloud.positions);
    displacement.assign(bend.begin(), bend.end());
  }

  /// Four floats a node, the last unused: a load of a vector register.
  using Node = Eigen::Map<Eigen::Vector4f, Eigen::Aligned16>;
  using ConstNode = Eigen::Map<const Eigen::Vector4f, Eigen::Aligned16>;

  void add_point(std::size_t p, std::vector<float>& to) const {
    constexpr float mu = 1000, lambda = 50000;
    const auto first = static_cast<std::size_t>(begin[p]), last = static_cast<std::size_t>(begin[p + 1]);
    Eigen::Vector4f column[3] = {Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero(), Eigen::Vector4f::Zero()};
    for (std::size_t k = first; k < last; ++k) {
      const ConstNode u(&displacement[4 * static_cast<std::size_t>(node[k])]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        column[axis] += derivative[3 * k + axis] * u;
      }
    }
    Eigen::Matrix3f gradient;
    gradient << column[0].head<3>(), column[1].head<3>(), column[2].head<3>();
    const Eigen::Matrix3f stress =
        volume[p] * (mu * (gradient + gradient.transpose()) + lambda * gradient.trace() * Eigen::Matrix3f::Identity());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      column[axis].head<3>() = stress.col(axis);
    }
    for (std::size_t k = first; k < last; ++k) {
      Node(&to[4 * static_cast<std::size_t>(node[k])]) +=
          derivative[3 * k] * column[0] + derivative[3 * k + 1] * column[1] + derivative[3 * k + 2] * column[2];
    }
  }

  void once() {
    force.resize(static_cast<std::size_t>(omp_get_max_threads()));
#pragma omp parallel
    {
      std::vector<float>& own = force[static_cast<std::size_t>(omp_get_thread_num())];
      own.assign(displacement.size(), 0.F);
#pragma omp for schedule(static)
      for (std::size_t p = 0; p < volume.size(); ++p) {
        add_point(p, own);
      }
#pragma omp for schedule(static)
      for (std::size_t i = 0; i < own.size(); ++i) {
        for (std::size_t other = 1; other < force.size(); ++other) {
          force[0][i] += force[other][i];
        }
      }
    }
  }
};

void time_plain_rows(State& state, Setting& setting) {
  PlainRows plain(setting.setting_up());
  plain.once();
  for (auto _ : state) {
    plain.once();
    ::benchmark::DoNotOptimize(plain.force[0].data());
  }
  count(state, static_cast<double>(plain.node.size()),
        bytes(plain.begin) + bytes(plain.node) + bytes(plain.derivative) + bytes(plain.volume) +
            bytes(plain.displacement));
}

/// The law of 1,024 points by one instruction set.
void time_law(State& state, const StepKernels& kernels) {
  constexpr std::size_t groups = 128;
  std::vector<TensorLanes> gradient(groups), stress(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::size_t k = 0; k < 9; ++k) {
      for (std::size_t l = 0; l < lanes; ++l) {
        gradient[g].entry[k][l] = (k % 4 == 0 ? 1.0 : 0.0) + 0.1 * std::sin(static_cast<double>(72 * g + 8 * k + l));
      }
    }
  }
  const std::vector<double> pressure(groups * lanes, 100), volume(pressure);
  std::vector<double> jacobian(groups * lanes);
  for (auto _ : state) {
    kernels.jacobian(gradient.data(), groups, jacobian.data());
    kernels.neo_hookean(gradient.data(), groups, 1000, pressure.data(), volume.data(), stress.data());
    ::benchmark::DoNotOptimize(stress.data());
  }
  count(state, groups * lanes, 0);
}

/// MMLS shape functions and their derivatives at eight points amid a lattice, by one instruction set.
void time_fit(State& state, const FitKernels& kernels) {
  constexpr int side = 6;
  constexpr double spacing = 2, radius = 4.4;
  Candidates candidates;
  for (int i = 0; i < side * side * side; ++i) {
    candidates.node.push_back(i);
    candidates.x.push_back(spacing * (i % side) + 0.4 * std::sin(i));
    candidates.y.push_back(spacing * (i / side % side) + 0.4 * std::cos(i));
    candidates.z.push_back(spacing * (i / side / side) + 0.4 * std::sin(2 * i));
    candidates.radius.push_back(radius);
  }
  PointLanes places{};
  for (int l = 0; l < lanes; ++l) {
    for (int axis = 0; axis < 3; ++axis) {
      places.at[axis][l] = spacing * (side - 1) / 2 + 0.5 * std::sin(3 * l + axis);
    }
  }
  places.ball = {Eigen::Vector3d::Constant(spacing * (side - 1) / 2), 1};
  std::vector<Neighbour> neighbours(candidates.node.size());
  std::vector<ShapeGradient> gradients(neighbours.size());
  const FitOptions options{3, 2, 1e-7, true};
  Fit fit;
  for (auto _ : state) {
    const std::span found(neighbours.data(), kernels.find(candidates, 1, places, neighbours.data()));
    kernels.fit(found, options, fit);
    kernels.slopes(found, {}, options, Derivatives::full, fit, gradients.data());
    ::benchmark::DoNotOptimize(gradients.data());
  }
  double pairs = 0;
  for (int l = 0; l < lanes; ++l) {
    pairs += static_cast<double>(fit.count[l]);
  }
  count(state, pairs, 0);
}

/// On one thread.
template <class Kernels>
void enrol_levels(const char* kernel, std::span<const Kernels> levels, void (*time)(State&, const Kernels&)) {
  for (const Kernels& level : levels) {
    ::benchmark::RegisterBenchmark((std::string(kernel) + "; " + level.name + "; 1").c_str(),
                                   [&level, time](State& state) {
                                     omp_set_num_threads(1);
                                     time(state, level);
                                   })
        ->Unit(::benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  }
}

/// As published in double and single precision, and the program's defaults, on a problem for each.
std::vector<Setting> settings(const Problem& published, const Problem& usual) {
  std::vector<Setting> all;
  for (const auto precision : {Precision::double_precision, Precision::single_precision}) {
    const std::string name = precision == Precision::double_precision ? "double" : "single";
    all.push_back({"linear, 1 point, " + name, published});
    bench::as_published(all.back().problem.options);
    all.back().problem.options.precision = precision;
    all.push_back({"MMLS, 8 points, " + name, usual});
    all.back().problem.options.precision = precision;
  }
  return all;
}

void enrol(Setting& setting, const std::string& kernel, void (*time)(State&, Setting&)) {
  for (int threads = 1; threads <= omp_get_num_procs(); threads *= 2) {
    ::benchmark::RegisterBenchmark((kernel + "; " + setting.name + "; " + std::to_string(threads)).c_str(),
                                   [&setting, time, threads](State& state) {
                                     omp_set_num_threads(threads);
                                     time(state, setting);
                                   })
        ->Unit(::benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  }
}

void enrol_all(std::vector<Setting>& all) {
  for (Setting& setting : all) {
    enrol(setting, "internal force", time_step);
  }
  enrol(all[0], "plain rows in single precision", time_plain_rows);
  for (const std::size_t i : {0U, 1U}) {
    enrol(all[i], "neighbour search", time_search);
    enrol(all[i], "shape functions, search included", time_shape_functions);
    enrol(all[i], "correction of the derivatives", time_correction);
  }
  enrol(all[0], "essential conditions", time_conditions);
  enrol_levels("neo-Hookean law", step_kernels(), time_law);
  enrol_levels("MMLS fit and derivatives", fit_kernels(), time_fit);
  if (all[0].problem.model.skull) {
    enrol(all[0], "contact", time_contact);
  }
}

Problem small_ellipsoid(double cells_per_node) {
  Problem problem = bench::ellipsoid(800, cells_per_node);
  problem.model.skull = bench::ellipsoid_surface(0.5);
  return problem;
}

std::vector<Setting> brains(char** argv) {
  return settings(bench::problem_of_run(argv[0], argv[1]), bench::problem_of_run(argv[0], argv[2]));
}

std::vector<Setting> small_ones() {
  return settings(small_ellipsoid(bench::published_cells_per_node), small_ellipsoid(0.75));
}

}  // namespace

int main(int argc, char** argv) {
  const bool of_runs = argc >= 5 && std::strcmp(argv[1], "--runs") == 0;
  std::vector<Setting> all = of_runs ? brains(argv + 2) : small_ones();
  if (of_runs) {
    std::copy(argv + 5, argv + argc, argv + 1);
    argc -= 4;
  }
  ::benchmark::Initialize(&argc, argv);
  if (::benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  enrol_all(all);
  ::benchmark::RunSpecifiedBenchmarks();
  return 0;
}
