// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a GPU makes of register's fields and images, with the processor of the same machine beside it.
//
//   device_warp [VOXELS ALONG AN AXIS = 192] [NODES = 12000] [REPEATS = 9]
//
// A brain of an ellipsoid in an image of 1 mm voxels sinks under an opening and waves a little. `--alone` first: on one
// thread of the processor in place of a GPU.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "register/device/fields_on_device.hpp"
#include "register/field/forward_field.hpp"
#include "register/field/resampling_field.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/progress/stopwatch.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/unit/register/builders.hpp"

namespace {

using namespace brainshift;
using namespace brainshift::registration;

constexpr double fade = 20, tolerance = 0.01;
const Eigen::Vector3d half_axes(66, 82, 60);  // mm

template <class Call>
double seconds_of(const Call& call) {
  const Stopwatch watch;
  call();
  return watch.seconds();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
  return values[values.size() / 2];
}

Surface brain() {
  Surface surface = builders::ball(Eigen::Vector3d::Zero(), 1, 48);
  surface.vertices = surface.vertices * half_axes.asDiagonal();
  return surface;
}

Eigen::Vector3d moved(const Eigen::Vector3d& x) {
  const Eigen::Vector3d opening(20, 10, 58);
  const Eigen::Vector3d sunken =
      8 * std::exp(-(x - opening).squaredNorm() / (2 * 30 * 30)) * Eigen::Vector3d(-0.2, 0.1, -0.97);
  return sunken + Eigen::Vector3d(std::sin(0.05 * x.y()), std::sin(0.06 * x.z() + 1), std::cos(0.04 * x.x()));
}

/// Jittered in the ellipsoid, and as dense on its surface.
Solution solution(double wanted) {
  const double volume = 4 * std::numbers::pi / 3 * half_axes.prod(), spacing = std::cbrt(volume / wanted);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-0.25 * spacing, 0.25 * spacing);
  std::vector<Eigen::Vector3d> nodes;
  for (double z = -half_axes.z(); z < half_axes.z(); z += spacing) {
    for (double y = -half_axes.y(); y < half_axes.y(); y += spacing) {
      for (double x = -half_axes.x(); x < half_axes.x(); x += spacing) {
        const Eigen::Vector3d node(x + jitter(random), y + jitter(random), z + jitter(random));
        if (node.cwiseQuotient(half_axes).norm() < 1 - 0.5 * spacing / half_axes.minCoeff()) {
          nodes.push_back(node);
        }
      }
    }
  }
  const double area = 4 * std::numbers::pi * std::pow(half_axes.prod(), 2.0 / 3);
  const int on_surface = static_cast<int>(area / (spacing * spacing));
  for (int n = 0; n < on_surface; ++n) {
    const double z = 1 - (2 * n + 1.0) / on_surface, turn = n * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - z * z);
    nodes.push_back(half_axes.cwiseProduct(Eigen::Vector3d(flat * std::cos(turn), flat * std::sin(turn), z)));
  }
  return builders::solution_at(nodes, spacing, moved);
}

ImageGeometry grid(int size) {
  ImageGeometry g;
  g.size.setConstant(size);
  g.origin.setConstant(-(size - 1) / 2.0);
  return g;
}

/// What register works on.
struct Problem {
  RegisterInput input;
  BrainZones zones;
  Points parameters;

  Problem(int size, double nodes)
      : input{.solution = solution(nodes),
              .brain = brain(),
              .t1 = builders::image(grid(size), builders::texture),
              .labels = builders::label_map(grid(size),
                                            [](const Eigen::Vector3d& x) {
                                              const double r = x.cwiseQuotient(half_axes).norm();
                                              return r < 0.3 ? 2 : r < 1 ? 1 : 0;
                                            })},
        zones(brain_zones(input.brain, input.t1.geometry, fade)),
        parameters(solve::parameters_from_displacement(shape_functions(input.solution), input.solution.positions,
                                                       input.solution.displacement)) {}
};

/// The fields and both images.
struct Result {
  VectorImage forward;
  InvertedField inverse;
  ScalarImage image;
  LabelMap labels;
};

Result on_processor(const Problem& problem) {
  Result result;
  const auto& [input, zones, parameters] = problem;
  const double forward =
      seconds_of([&] { result.forward = forward_field(input.solution, zones, input.t1.geometry, fade, {}); });
  const double inverse = seconds_of([&] { result.inverse = resampling_field(result.forward, tolerance); });
  const double images = seconds_of([&] {
    result.image = warp(input.t1, result.inverse.field, Interpolation::linear);
    result.labels = warp(*input.labels, result.inverse.field);
  });
  std::printf("processor: forward field %.1f ms, resampling field %.1f ms, both images %.1f ms\n", 1e3 * forward,
              1e3 * inverse, 1e3 * images);
  return result;
}

Result on_device(const device::Backend& backend, const Problem& problem, int repeats) {
  const auto& [input, zones, parameters] = problem;
  const solve::ShapeFunctions shape = shape_functions(input.solution);
  std::vector<double> forward, inverse, images, all, with_transfers;
  Result result;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Stopwatch watch;
    device::FieldsOnDevice on(backend, input.solution, parameters, zones, input.t1.geometry, fade, tolerance);
    on.take(input.t1);
    on.take(*input.labels);
    on.wait();
    const double there = watch.seconds();
    on.find_forward(shape);
    on.wait();
    const double with_forward = watch.seconds();
    on.find_resampling();
    on.wait();
    const double with_inverse = watch.seconds();
    on.warp_image();
    on.warp_labels();
    on.wait();
    const double end = watch.seconds();
    result = {on.forward(), on.resampling(), on.warped(), on.warped_labels()};
    forward.push_back(with_forward - there);
    inverse.push_back(with_inverse - with_forward);
    images.push_back(end - with_inverse);
    all.push_back(end - there);
    with_transfers.push_back(watch.seconds());
    if (repeat == 0) {
      std::printf("%d voxels at the second try\n", on.grown());
    }
  }
  std::printf(
      "device: forward field %.2f ms, resampling field %.2f ms, both images %.2f ms, together %.2f ms; with transfers "
      "%.1f ms\n",
      1e3 * median(forward), 1e3 * median(inverse), 1e3 * median(images), 1e3 * median(all),
      1e3 * median(with_transfers));
  return result;
}

void compare(const char* what, const VectorImage& a, const VectorImage& b) {
  double largest = 0;
  std::size_t apart = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    const double distance = (builders::at(a, v) - builders::at(b, v)).norm();
    largest = std::max(largest, distance);
    apart += distance > 0 ? 1 : 0;
  }
  std::printf("%s: %zu of %zu voxels differ, by %.2g mm at most\n", what, apart, a.voxels.size(), largest);
}

template <class T>
void compare(const char* what, const Image<T>& a, const Image<T>& b) {
  double largest = 0;
  std::size_t apart = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    const double difference = std::abs(double{1} * a.voxels[v] - double{1} * b.voxels[v]);
    largest = std::max(largest, difference);
    apart += difference > 0 ? 1 : 0;
  }
  std::printf("%s: %zu of %zu voxels differ, by %.2g at most\n", what, apart, a.voxels.size(), largest);
}

void run(const device::Backend& backend, int size, double nodes, int repeats) {
  const Problem problem(size, nodes);
  const auto near = std::count_if(problem.zones.zone.begin(), problem.zones.zone.end(),
                                  [](Zone zone) { return zone >= Zone::shell; });
  std::printf("%zu voxels, %td of them in the brain and near it, %td nodes\n", problem.zones.zone.size(), near,
              problem.input.solution.positions.rows());
  const Result there = on_processor(problem), here = on_device(backend, problem, repeats);
  compare("forward field", here.forward, there.forward);
  compare("resampling field", here.inverse.field, there.inverse.field);
  compare("image", here.image, there.image);
  compare("labels", here.labels, there.labels);
  std::printf("not inverted: %zu, %zu\n", here.inverse.not_inverted, there.inverse.not_inverted);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> words(argv + 1, argv + argc);
    const bool alone = !words.empty() && words.front() == "--alone";
    words.erase(words.begin(), words.begin() + (alone ? 1 : 0));
    const auto number = [&](std::size_t n, int usual) {
      return words.size() > n ? std::atoi(words[n].c_str()) : usual;
    };
    const device::Backend* backend = alone ? &device::one_thread() : device::gpu();
    if (backend == nullptr) {
      throw std::runtime_error(solve::device::why_no_gpu());
    }
    run(*backend, number(0, 192), number(1, 12000), number(2, 9));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "device_warp: %s\n", error.what());
    return 1;
  }
}
