// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a GPU makes of relaxation, with the processor of the same machine beside it.
//
//   device run SCENE RUN [REPEATS]
//
// The scene from prepared to converged: seconds, steps, how far apart the two end. RUN is a folder of a run of it.
//
//   device step NODES COPIES
//
// A step of an ellipsoid of so many nodes, so many of them side by side; on the processor only where there is one.
//
//   device update SCENE RUN COUNT
//
// The run kept in memory, as `brainshift live` does, and so many loads by chance as tests/benchmark/live.py has them:
// from a load's file to the nodes' displacements, on both.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/runner/jobs.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "segmentation/progress/stopwatch.hpp"
#include "solve/body/nodal_order.hpp"
#include "solve/device/device_body.hpp"
#include "solve/device/kept_on_device.hpp"
#include "solve/device/relax_on_device.hpp"
#include "solve/dynamics/motion.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/force/largest_eigenvalue.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/run/attempt.hpp"
#include "solve/run/coarse.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/prepare.hpp"
#include "solve/update/kept_run.hpp"
#include "tests/benchmark/problems.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::solve;
using bench::Problem;

/// The median time of a call, s.
template <class Call>
double median_seconds(int repeats, const Call& call) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    call();
    seconds.push_back(watch.seconds());
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repeats / 2)];
}

Body prepared_body(const Problem& problem, SolveOptions& options) {
  options = completed(problem.options, problem.model);
  SolveMeasures measures;
  return prepare(problem.model, options, {}, measures, {}).body;
}

/// Bodies side by side that do not touch.
PointBlocks copies_of(const PointBlocks& one, std::int32_t count) {
  PointBlocks all = one;
  const auto nodes = static_cast<std::int32_t>(one.nodes()), points = static_cast<std::int32_t>(one.points());
  const auto patches = static_cast<std::int32_t>(one.patches.size());
  const auto slots = static_cast<std::int64_t>(one.slots());
  const std::int64_t pairs = one.pair_begin.back();
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (std::int32_t k = 1; k < count; ++k) {
    for (Block block : one.blocks) {
      block.first_patch += k * patches;
      block.last_patch += k * patches;
      block.first_slot += k * slots;
      all.blocks.push_back(block);
    }
    for (Patch patch : one.patches) {
      patch.first_point += k * points;
      patch.last_point += k * points;
      patch.first_slot += k * slots;
      all.patches.push_back(patch);
    }
    append(all.volume, one.volume);
    append(all.mode, one.mode);
    append(all.support, one.support);
    append(all.pair_slot, one.pair_slot);
    append(all.pair_single, one.pair_single);
    append(all.pair_derivative, one.pair_derivative);
    for (std::size_t p = 1; p < one.pair_begin.size(); ++p) {
      all.pair_begin.push_back(one.pair_begin[p] + k * pairs);
    }
    for (const std::int32_t node : one.slot_node) {
      all.slot_node.push_back(node + k * nodes);
    }
    for (std::size_t a = 1; a < one.node_begin.size(); ++a) {
      all.node_begin.push_back(one.node_begin[a] + k * slots);
    }
    for (const std::int32_t slot : one.node_slot) {
      all.node_slot.push_back(slot + static_cast<std::int32_t>(k * slots));
    }
  }
  all.felt.clear();
  return all;
}

std::int64_t pairs_of(const PointBlocks& points) {
  std::int64_t pairs = 0;
  for (const std::uint16_t support : points.support) {
    pairs += support;
  }
  return pairs;
}

/// Of the state at rest moved a little; the order's steps are stable.
template <class Scalar>
double seconds_a_step(const device::Backend& backend, const Body& body, std::size_t& bytes) {
  const device::DeviceBody<Scalar> on(backend, body);
  bytes = on.bytes();
  device::Order order;
  order.alpha = relaxation_alpha;
  order.mass_margin = mass_margin;
  on.perform(device::Task::follow, order);
  on.perform(device::Task::weigh, order);
  order.steps = device::most_steps;
  order.beta = critical_beta(1e-3);
  order.halt_below = -1e9;
  std::fill_n(order.fraction, device::most_steps + 1, 0.01);
  const auto many = [&] {
    for (int i = 0; i < 20; ++i) {
      on.perform(device::Task::step, order);
      order.first = (order.first + order.steps) % 3;
      order.parity = (order.parity + order.steps) % 2;
    }
    on.record();
  };
  many();
  return median_seconds(9, many) / (20 * device::most_steps);
}

/// What the parts of a relaxation take, each with its launch.
template <class Scalar>
void time_parts(const device::Backend& backend, const Body& body) {
  const device::DeviceBody<Scalar> on(backend, body);
  device::Order order;
  order.alpha = relaxation_alpha;
  order.mass_margin = mass_margin;
  order.mode_size = 1e-7;
  order.iterations = 100;
  on.write(rough_mode(on.nodes()), on.view().mode_of_body);
  const auto time = [&](const char* what, device::Task task, int each) {
    on.perform(task, order);
    on.record();
    const double seconds = median_seconds(9, [&] {
      on.perform(task, order);
      on.record();
    });
    std::printf("  %s %.1f us\n", what, 1e6 * seconds / each);
  };
  time("follow", device::Task::follow, 1);
  time("weigh", device::Task::weigh, 1);
  time("look", device::Task::look, 1);
  time("hold", device::Task::hold, 1);
  time("force (power iteration)", device::Task::measure_tightness, 100);
  order.halt_below = -1e9;
  for (const int steps : {1, 20}) {
    order.steps = steps;
    time("steps", device::Task::step, 1);
  }
  std::printf("  conditions %d, touching %d, clusters %d of at most %d points and %d slots\n",
              on.view().condition[0].count, on.view().contact.count, on.view().clusters, on.view().most_points,
              on.view().most_slots);
}

double seconds_a_step_on_processor(Body body) {
  Motion motion(std::move(body), 0);
  const PointLaws laws = motion.body.laws;
  internal_force(motion.body.points, laws, motion.now, motion.scratch, motion.force);
  std::vector<double> mass = stiffness_bound(motion.body.points, laws, motion.scratch);
  for (double& m : mass) {
    m *= mass_margin;
  }
  motion.weigh(mass, relaxation_alpha);
  const auto many = [&] {
    for (int i = 0; i < 20; ++i) {
      motion.step(laws, mass, relaxation_alpha, critical_beta(1e-3), 1, 0.01);
    }
  };
  many();
  return median_seconds(5, many) / 20;
}

void time_steps(const device::Backend& backend, std::size_t nodes, std::int32_t copies) {
  Problem problem = bench::ellipsoid(nodes, bench::published_cells_per_node);
  bench::as_published(problem.options);
  problem.options.precision = Precision::single_precision;
  SolveOptions options;
  Body body = prepared_body(problem, options);
  const double processor = copies == 1 ? seconds_a_step_on_processor(body) : 0;
  if (copies > 1) {
    body.points = copies_of(body.points, copies);
    body.original.resize(body.points.nodes());
  }
  std::size_t bytes = 0;
  const double seconds = seconds_a_step<float>(backend, body, bytes);
  const auto pairs = static_cast<double>(pairs_of(body.points));
  std::printf(
      "%zu nodes, %zu points, %.0f pairs: %.2f us a step on the GPU, %.4f ns a pair, %.0f GB/s of pairs; %.1f us on "
      "the processor; %.0f MB on the GPU\n",
      body.nodes(), body.points.points(), pairs, 1e6 * seconds, 1e9 * seconds / pairs,
      2e-9 * sizeof(device::Pair<float>) * pairs / seconds, 1e6 * processor, 1e-6 * static_cast<double>(bytes));
}

/// From where the body lies on the GPU to its rest.
template <class Scalar>
double seconds_to_rest(const device::Backend& backend, const Body& body, const Course& course,
                       const SolveOptions& options, int repeats, SteppingResult& result) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    Body copy = body;
    device::DeviceBody<Scalar> on(backend, body);
    on.record();  // all of it is there
    const Stopwatch watch;
    result = device::relax(on, copy, course, options, false, {}).result;
    seconds.push_back(watch.seconds());
    std::printf("  %.2f ms\n", 1e3 * seconds.back());
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  return seconds[static_cast<std::size_t>(repeats / 2)];
}

void time_run(const device::Backend& backend, const Problem& problem, int repeats) {
  SolveOptions options;
  Body body = prepared_body(problem, options);
  Course course{.curve = problem.model.curve};
  const bool coarse = starts_coarse(problem.model, options);
  if (coarse) {
    const std::optional<Points> start = coarse_displacement(problem.model, of_coarse_start(options), {});
    course.start = start ? in_body_order(*start, body.original) : NodalVectors();
  }
  SteppingResult on_processor, on_gpu;
  Body again = body;
  const double processor = median_seconds(1, [&] { on_processor = relax(std::move(again), course, options, {}); });
  const double setup = median_seconds(repeats, [&] {
    if (body.points.precision() == Precision::single_precision) {
      device::DeviceBody<float>(backend, body).record();
    } else {
      device::DeviceBody<double>(backend, body).record();
    }
  });
  const double gpu = body.points.precision() == Precision::single_precision
                         ? seconds_to_rest<float>(backend, body, course, options, repeats, on_gpu)
                         : seconds_to_rest<double>(backend, body, course, options, repeats, on_gpu);
  if (body.points.precision() == Precision::single_precision) {
    time_parts<float>(backend, body);
  } else {
    time_parts<double>(backend, body);
  }
  std::printf(
      "%zu nodes, %zu points, %lld pairs, %s start: processor %.1f ms, %d steps; GPU %.2f ms after "
      "%.2f ms set-up, %d steps; %.2g mm apart; bounds %.4f, %.4f mm %s\n",
      body.nodes(), body.points.points(), static_cast<long long>(pairs_of(body.points)),
      course.start.empty() ? "rest" : "coarse", 1e3 * processor, on_processor.steps, 1e3 * gpu, 1e3 * setup,
      on_gpu.steps, largest_difference(on_gpu.parameters, on_processor.parameters), on_processor.error_bound,
      on_gpu.error_bound, on_gpu.failure.c_str());
}

/// Gentle changes that fade to the rim as the displacement does; the largest is 1 mm or less.
CraniotomyLoad changed(const CraniotomyLoad& own, std::mt19937& chance) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share;
  const Eigen::VectorXd length = own.displacement.rowwise().norm();
  const Points about = own.positions.rowwise() - own.positions.colwise().mean();
  const double reach = about.rowwise().norm().maxCoeff();
  const Eigen::RowVector3d shift(normal(chance), normal(chance), normal(chance));
  const Eigen::Vector3d tilt(normal(chance), normal(chance), normal(chance));
  Points change(own.positions.rows(), 3);
  for (Eigen::Index p = 0; p < change.rows(); ++p) {
    const Eigen::RowVector3d along = length[p] > 0 ? Eigen::RowVector3d(own.displacement.row(p) / length[p])
                                                   : Eigen::RowVector3d(Eigen::RowVector3d::Zero());
    change.row(p) = length[p] / length.maxCoeff() * (shift + about.row(p).dot(tilt) / reach * along);
  }
  CraniotomyLoad load = own;
  load.displacement += share(chance) / change.rowwise().norm().maxCoeff() * change;
  return load;
}

/// Milliseconds of an answer, and what they went to.
struct AnswerTimes {
  std::vector<double> whole, file, nodes, to_first_look, steps, after_last_look;
  int most_steps = 0;
  double all_steps = 0;

  void print(const char* where) {
    std::printf("%s: %.1f steps in the mean, at most %d\n", where, all_steps / static_cast<double>(whole.size()),
                most_steps);
    for (auto& [what, values] :
         {std::pair("from the file to the nodes", &whole), std::pair("  reading", &file),
          std::pair("  to the surface's nodes", &nodes), std::pair("  to the first look", &to_first_look),
          std::pair("  further steps", &steps), std::pair("  the rest", &after_last_look)}) {
      std::sort(values->begin(), values->end());
      const auto last = static_cast<double>(values->size() - 1);
      std::printf("  %-28s median %8.2f ms, 99 %% %8.2f ms, largest %8.2f ms\n", what,
                  (*values)[static_cast<std::size_t>(0.5 * last)], (*values)[static_cast<std::size_t>(0.99 * last)],
                  values->back());
    }
  }
};

void answer(KeptRun& run, const std::filesystem::path& file, const OpeningOptions& opening, AnswerTimes& times) {
  const Stopwatch watch;
  const CraniotomyLoad load = read_craniotomy_csv(file);
  const double read = watch.seconds();
  const NodeCloud cloud{
      .positions = run.fine.body.positions, .spacing = run.fine.body.spacing, .on_surface = run.on_surface};
  const Points prescribed = prescribed_on_surface_nodes(cloud, load, opening);
  const double there = watch.seconds();
  double first = 0, last = 0;
  const SolveResult result = update(run, prescribed, [&](double, std::string_view) {
    last = watch.seconds();
    first = first > 0 ? first : last;
  });
  const double end = watch.seconds();
  if (!result.failure.empty()) {
    throw std::runtime_error(result.failure);
  }
  constexpr double ms = 1e3;
  times.whole.push_back(ms * end);
  times.file.push_back(ms * read);
  times.nodes.push_back(ms * (there - read));
  times.to_first_look.push_back(ms * (first - there));
  times.steps.push_back(ms * (last - first));
  times.after_last_look.push_back(ms * (end - last));
  times.most_steps = std::max(times.most_steps, result.measures.steps);
  times.all_steps += result.measures.steps;
}

void time_updates(const device::Backend& backend, const std::filesystem::path& scene, const std::filesystem::path& run,
                  int count) {
  const Problem problem = bench::problem_of_run(scene, run);
  const OpeningOptions opening = pipelines::solve_job(pipelines::parse_scene(scene), run).load->opening;
  const Stopwatch watch;
  KeptRun here = keep(problem.model, problem.options, read_solution(run / "solve" / "solution.vtu").displacement);
  std::printf("kept in %.1f s: %zu nodes, %zu waves\n", watch.seconds(), here.fine.body.nodes(),
              here.responses.count());
  here.options.device = Device::cpu;
  KeptRun there = here;
  there.options.device = Device::cuda;
  there.on_device = std::make_shared<device::KeptOnDevice>(&backend);
  for (KeptRun* first : {&here, &there}) {  // as live does before it watches
    update(*first, first->origin.prescribed);
  }
  const CraniotomyLoad own = read_craniotomy_csv(run / "solve" / "load.csv");
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "device_update.csv";
  std::mt19937 chance(1);
  AnswerTimes on_processor, on_gpu;
  double apart = 0;
  for (int i = 0; i < count; ++i) {
    write_craniotomy_csv(file, changed(own, chance));
    answer(here, file, opening, on_processor);
    answer(there, file, opening, on_gpu);
    apart = std::max(apart, (here.displacement - there.displacement).rowwise().norm().maxCoeff());
  }
  std::filesystem::remove(file);
  on_processor.print("processor");
  on_gpu.print("GPU");
  std::printf("at most %.2g mm apart, of which the bounds allow each %.2g mm; %d answers\n", apart,
              here.options.tolerance, count);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    const device::Backend* backend = device::gpu();
    if (backend == nullptr) {
      throw std::runtime_error(device::why_no_gpu());
    }
    if (what == "run" && argc > 3) {
      time_run(*backend, bench::problem_of_run(argv[2], argv[3]), argc > 4 ? std::atoi(argv[4]) : 5);
    } else if (what == "update" && argc > 4) {
      time_updates(*backend, argv[2], argv[3], std::atoi(argv[4]));
    } else if (what == "step" && argc > 3) {
      time_steps(*backend, static_cast<std::size_t>(std::atoll(argv[2])), std::atoi(argv[3]));
    } else {
      throw std::invalid_argument(
          "device run SCENE RUN [REPEATS] | device step NODES COPIES | device update SCENE RUN COUNT");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "device: %s\n", error.what());
    return 1;
  }
}
