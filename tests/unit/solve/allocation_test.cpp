// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <new>

#include "solve/dynamics/motion.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "solve/run/completed.hpp"
#include "solve/run/prepare.hpp"
#include "tests/unit/segmentation/shapes.hpp"
#include "tests/unit/solve/models.hpp"

// The linker turns every call of malloc, calloc and the operators new in this program into one of these
// (CMakeLists.txt).
namespace {
std::atomic<int> allocations = 0;
}

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real__Znwm(std::size_t size);
void* __real__ZnwmSt11align_val_t(std::size_t size, std::align_val_t alignment);

void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __real_calloc(count, size);
}
void* __wrap__Znwm(std::size_t size) {
  ++allocations;
  return __real__Znwm(size);
}
void* __wrap__ZnwmSt11align_val_t(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  return __real__ZnwmSt11align_val_t(size, alignment);
}
}

namespace brainshift::solve::allocation_test {

/// A cube that is stretched within a ball which it touches, with forces, so that all that a step has is there.
Model everything() {
  Model model = uniaxial(1.2);
  const double half = model_side / 2;
  model.skull = test::sphere(Eigen::Vector3d::Constant(half), 1.75 * half, 4);
  model.gravity = {0, 0, -9.81};
  return model;
}

int allocated_in_steps(const Model& model, SolveOptions options) {
  SolveMeasures measures;
  Prepared p = prepare(model, completed(options, model), {}, measures, {});
  Motion motion(std::move(p.body), 0);
  const Body& body = motion.body;
  internal_force(body.points, body.laws, motion.now, motion.scratch, motion.force);
  const std::vector<double> mass = stiffness_bound(body.points, body.laws, motion.scratch);
  motion.weigh(mass);
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      motion.step(body.laws, mass, 1, 0.9, 1, 1);
    }
  };
  steps(2);
  const int before = allocations;
  steps(10);
  return allocations - before;
}

TEST(Step, AllocatesNothing) {
  const int before = allocations;
  const std::vector<double> by_new(7);
  const std::vector<TensorLanes> by_aligned_new(7);
  const Eigen::VectorXd by_malloc = Eigen::VectorXd::Zero(7);
  asm volatile("" : : "r"(by_new.data()), "r"(by_aligned_new.data()), "r"(by_malloc.data()) : "memory");  // needed
  ASSERT_EQ(allocations - before, 3) << "the count is of all that this program allocates";
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    for (const Imposition imposition : {Imposition::exact, Imposition::simplified}) {
      SolveOptions options;
      options.precision = precision;
      options.imposition = imposition;
      EXPECT_EQ(allocated_in_steps(everything(), options), 0);
    }
  }
}

}  // namespace brainshift::solve::allocation_test
