// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/kept_on_device.hpp"

#include <cmath>
#include <limits>

#include "solve/device/device_fault.hpp"
#include "solve/update/kept_run.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/device/backends.hpp"
#include "tests/unit/solve/measured_box.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/pressed.hpp"

namespace brainshift::solve::device {

namespace {

/// At rest under the load of its model, on the CPU.
KeptRun kept(const Model& model, SolveOptions options) {
  KeptRun run = keep(model, options, solve(model, options).solution.displacement);
  run.made_from = [model] { return model; };
  run.trusted = std::numeric_limits<double>::infinity();  // whose steps are those of an update, however far the load is
  return run;
}

SolveOptions with_tolerance(double tolerance, Precision precision = Precision::double_precision) {
  SolveOptions options;
  options.tolerance = tolerance;
  options.precision = precision;
  return options;
}

/// The same run, which a device answers.
KeptRun on_device(KeptRun run, const Backend* backend, Device device = Device::cuda) {
  run.options.device = device;
  run.on_device = std::make_shared<KeptOnDevice>(backend);
  return run;
}

/// The same run by the rules of a device, on the CPU.
KeptRun on_host(KeptRun run) {
  return on_device(std::move(run), nullptr, Device::automatic);
}

class UpdateOnDevice : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Of, UpdateOnDevice, testing::Values(On::one_thread, On::gpu), name_of_device);

/// Both answer a load; rounding: of û, mm. of_masses: the same of their scale, which a body that is laid out anew
/// measures anew.
void expect_same_answer(KeptRun& here, KeptRun& there, const Points& prescribed, double rounding,
                        double of_masses = 0) {
  const SolveResult expected = update(here, prescribed), answer = update(there, prescribed);
  ASSERT_EQ(answer.failure, "");
  ASSERT_EQ(expected.failure, "");
  EXPECT_EQ(answer.measures.steps, expected.measures.steps);
  EXPECT_LT(largest_difference(there.fine.parameters, here.fine.parameters), rounding);
  EXPECT_NEAR(answer.measures.error_bound, expected.measures.error_bound,
              0.01 * expected.measures.error_bound + rounding);
  EXPECT_EQ(answer.measures.contact_nodes, expected.measures.contact_nodes);
  const double force = expected.solution.reaction_force.cwiseAbs().maxCoeff();
  EXPECT_LT((answer.solution.reaction_force - expected.solution.reaction_force).cwiseAbs().maxCoeff(), 1e-3 * force);
  ASSERT_EQ(answer.history.size(), expected.history.size());
  EXPECT_EQ(answer.history.back().step, expected.history.back().step);
  EXPECT_NEAR(answer.history.back().strain_energy, expected.history.back().strain_energy,
              1e-6 * expected.history.back().strain_energy);
  const Settled &settled = there.fine.settled, &other = here.fine.settled;
  EXPECT_NEAR(settled.mass_scale, other.mass_scale, of_masses * other.mass_scale);
  EXPECT_NEAR(settled.lowest, other.lowest, 1e-3 * other.lowest);
  EXPECT_NEAR(settled.smallest_jacobian, other.smallest_jacobian, 1e-6);
  ASSERT_EQ(settled.mass.size(), other.mass.size());
  for (std::size_t a = 0; a < other.mass.size(); ++a) {
    ASSERT_NEAR(settled.mass[a], other.mass[a], 1e-6 * other.mass[a]) << "node " << a;
  }
}

/// Without the nodes of one edge of the far face.
Points without_an_edge(Points prescribed, const Points& places) {
  for (Eigen::Index a = 0; a < places.rows(); ++a) {
    if (places(a, 2) == places.col(2).maxCoeff() && places(a, 1) == places.col(1).maxCoeff()) {
      prescribed.row(a).setConstant(std::nan(""));
    }
  }
  return prescribed;
}

}  // namespace

/// The springs that noise leaves differ from load to load, at the same nodes.
TEST_P(UpdateOnDevice, HasNoSpringsOfAnEarlierLoad) {
  const Model own = measured_box(0.5);
  SolveOptions options = with_tolerance(1e-3);
  options.shape.basis = Basis::linear;
  KeptRun here = on_host(kept(own, options));
  KeptRun there = on_device(here, &backend());
  for (const Model& model : {with_inner(own, 1), with_inner(own, 2), own, with_weight(own, 0.05), with_weight(own, 0.2),
                             without_noise(own), with_inner(own, 2)}) {
    const SolveResult expected = update(here, model.conditions), answer = update(there, model.conditions);
    ASSERT_EQ(answer.failure, "");
    ASSERT_EQ(expected.failure, "");
    EXPECT_LT((answer.solution.displacement - expected.solution.displacement).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(UpdateOnDevice, IsThatOfTheHostLoadAfterLoad) {
  const Model own = uniaxial(0.9, 5);
  KeptRun here = on_host(kept(own, with_tolerance(1e-5)));
  KeptRun there = on_device(here, &backend());
  for (const double factor : {1.2, 0.7, 1.0, 1.21}) {
    expect_same_answer(here, there, factor * own.conditions.displacement, 1e-9);
  }
  EXPECT_EQ(there.on_device->fault(), "");
}

TEST_P(UpdateOnDevice, IsThatOfTheHostInContactAndWhereOtherNodesAreLoaded) {
  const Pressed pressed(1e-5);
  KeptRun here = on_host(kept(pressed.model, pressed.options));
  ASSERT_GT(here.fine.body.contact->measure(here.fine.parameters).touching, 10U);
  KeptRun there = on_device(here, &backend());
  const Points all = here.origin.prescribed, fewer = without_an_edge(all, pressed.model.cloud.positions);
  for (const Points& prescribed : {Points(0.95 * all), Points(1.05 * all)}) {
    expect_same_answer(here, there, prescribed, 1e-8);
  }
  for (const Points& prescribed : {fewer, Points(1.02 * fewer)}) {
    expect_same_answer(here, there, prescribed, 1e-8, 1e-6);
  }
  expect_same_answer(here, there, all, 1e-8);
}

/// So far from the run's own load that its masses are too small. Closer to the end the device would leave it to the
/// processor, as slow.
TEST_P(UpdateOnDevice, IsThatOfTheHostWhereTheBodyGetsStiffer) {
  KeptRun here = on_host(kept(uniaxial(0.95, 5), with_tolerance(1e-4)));
  KeptRun there = on_device(here, &backend());
  const std::vector<double> mass = here.fine.settled.mass;
  for (const double stretch : {0.55, 0.6, 0.9}) {
    expect_same_answer(here, there, uniaxial(stretch, 5).conditions.displacement, 1e-8);
  }
  EXPECT_NE(there.fine.settled.mass, mass);
}

TEST_P(UpdateOnDevice, IsTheSameBitsAgainAndKeepsTheDigitsOfSinglePrecision) {
  KeptRun here = on_host(kept(uniaxial(0.9, 5), with_tolerance(0.005, Precision::single_precision)));
  ASSERT_EQ(here.options.precision, Precision::single_precision);
  KeptRun first = on_device(here, &backend()), second = on_device(here, &backend());
  for (const double stretch : {0.8, 0.85}) {
    const Points prescribed = uniaxial(stretch, 5).conditions.displacement;
    update(here, prescribed);
    update(first, prescribed);
    update(second, prescribed);
    EXPECT_EQ(first.fine.parameters, second.fine.parameters) << "not the same bits";
    EXPECT_LT(largest_difference(first.fine.parameters, here.fine.parameters), 5e-4);
  }
}

/// A body that a copy of the run has moved since is put where it is to start.
TEST_P(UpdateOnDevice, MayServeTwoRunsInTurn) {
  const KeptRun own = kept(uniaxial(0.9, 5), with_tolerance(1e-5));
  KeptRun first = on_device(own, &backend());
  KeptRun second = first, here = on_host(own);
  expect_same_answer(here, first, uniaxial(0.8, 5).conditions.displacement, 1e-9);
  here = on_host(own);
  expect_same_answer(here, second, uniaxial(0.95, 5).conditions.displacement, 1e-9);
}

TEST(KeptOnDevice, LeavesToTheCpuWhatIsNotAskedForOrCannotBe) {
  const KeptRun own = kept(uniaxial(0.9, 4), with_tolerance(0.001));
  const Points prescribed = uniaxial(0.85, 4).conditions.displacement;
  KeptRun here = own;
  update(here, prescribed);
  for (const Device device : {Device::cpu, Device::automatic}) {
    KeptRun there = on_device(own, nullptr, device);
    EXPECT_EQ(update(there, prescribed).failure, "");
    EXPECT_LT(largest_difference(there.fine.parameters, here.fine.parameters), device == Device::cpu ? 1e-300 : 0.01);
  }
  KeptRun there = on_device(own, nullptr);
  const std::string refused = test::refusal([&] { update(there, prescribed); });
  EXPECT_TRUE(refused.starts_with("device cuda: ")) << refused;
}

/// One that fails after some work.
TEST(KeptOnDevice, LeavesAllToTheCpuOnceTheDeviceHasFailed) {
  static int tasks_left;
  tasks_left = 9;
  Backend failing = one_thread();
  failing.twofold = [](Task task, const View<double>& view, const Order& order) {
    if (--tasks_left < 0) {
      throw DeviceFault("the GPU is gone");
    }
    one_thread().perform(task, view, order);
  };
  const KeptRun own = kept(uniaxial(0.9, 4), with_tolerance(1e-5));
  KeptRun here = on_host(own), there = on_device(own, &failing, Device::automatic);
  std::string said;
  for (const double stretch : {0.85, 0.8}) {
    const Points prescribed = uniaxial(stretch, 4).conditions.displacement;
    update(here, prescribed);
    update(there, prescribed, [&](double, std::string_view what) { said += what; });
    EXPECT_EQ(there.fine.parameters, here.fine.parameters);
    EXPECT_EQ(tasks_left, -1) << "tried again";
  }
  EXPECT_EQ(there.on_device->fault(), "the GPU is gone");
  EXPECT_NE(said.find("once more on the processor: the GPU is gone"), std::string::npos) << said;
  KeptRun only = on_device(own, &failing);
  EXPECT_THROW(update(only, uniaxial(0.85, 4).conditions.displacement), DeviceFault);
}

}  // namespace brainshift::solve::device
