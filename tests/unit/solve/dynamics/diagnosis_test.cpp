// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/diagnosis.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "solve/dynamics/soundness.hpp"
#include "solve/run/prepare.hpp"
#include "solve/run/step.hpp"
#include "tests/unit/solve/models.hpp"
#include "tests/unit/solve/specimen.hpp"

namespace brainshift::solve::diagnosis_test {

constexpr double side = model_side;

/// The node that a sentence names, after having found that its place is the cloud's.
Eigen::Index named_node(const std::string& sentence, const NodeCloud& cloud) {
  long node = 0;
  double x = 0, y = 0, z = 0;
  const std::size_t at = sentence.rfind("node ");
  if (at == std::string::npos ||
      std::sscanf(sentence.c_str() + at, "node %ld, (%lf, %lf, %lf) mm", &node, &x, &y, &z) != 4) {
    ADD_FAILURE() << sentence;
    return 0;
  }
  const Eigen::RowVector3d place(x, y, z);
  EXPECT_LE((cloud.positions.row(node) - place).norm(), 1e-3) << sentence;
  return node;
}

TEST(Diagnosis, NamesTheNodeNextToAPointThatTurnedInsideOut) {
  const Model model = uniaxial(-0.5, 5);
  const SolveResult result = solve(model, {});
  ASSERT_NE(result.failure.find("likely cause: "), std::string::npos) << result.failure;
  EXPECT_NE(result.failure.find("tried twice"), std::string::npos) << result.failure;
  named_node(result.failure, model.cloud);
  EXPECT_TRUE(result.solution.displacement.allFinite());
  EXPECT_GT(result.measures.smallest_jacobian, 0);
}

/// Of a body at rest and one in time, which alone remembers J.
TEST(Diagnosis, FindsThePointThatTurnedInsideOut) {
  for (const bool in_time : {false, true}) {
    Specimen body{test::irregular_box(5, side), test::box_cells(4, side), {Material{}}, SpecimenOptions{}};
    body.laws.in_time = in_time;
    body.scratch = ForceScratch(body.points, body.laws);
    constexpr std::size_t pushed = 62;  // an inner node
    NodalVectors u = body.rest();
    u[4 * pushed + 2] = side;
    body.force(u);
    const Fault fault = broken_point(body.points, body.scratch, {u, u, u});
    ASSERT_GE(fault.point, 0);
    const auto patch = std::find_if(body.points.patches.begin(), body.points.patches.end(),
                                    [&](const Patch& p) { return fault.point < p.last_point; });
    const auto gradients = gradients_of(body.points, *patch, body.scratch);
    const double found = gradients[static_cast<std::size_t>(fault.point - patch->first_point)].determinant();
    EXPECT_LT(found, 0);
    EXPECT_NEAR(found, jacobian_range(body.scratch).smallest, 1e-12) << "in time " << in_time;
  }
}

TEST(Diagnosis, NamesTheSoftTissueBesideAStiffOne) {
  Model model = uniaxial(-0.5, 5);
  model.materials[2] = {3e6, 0.3, 1000};
  model.materials[7] = {10, 0.3, 1000};
  model.materials.erase(1);
  test::label_cells(model.cells, [](const Eigen::RowVector3d& low) { return low[2] > 1 ? 2 : 7; });
  const SolveResult result = solve(model, {});
  EXPECT_NE(result.failure.find("tissue 7 is 300000 times softer than tissue 2"), std::string::npos) << result.failure;
  EXPECT_LE(model.cloud.positions(named_node(result.failure, model.cloud), 2), side / 2) << result.failure;
}

TEST(Diagnosis, NamesASwellingThatMayHaveNoRoom) {
  Model model = uniaxial(1, 4);
  const auto told = [&](double swelling) {
    model.materials[1].swelling = swelling;
    SolveMeasures measures;
    const Prepared prepared = prepare(model, {}, {}, measures, {}, false);
    return describe(Fault{.node = 0}, prepared.body);
  };
  EXPECT_NE(told(0.5).find("swells by more than what is around it makes room for"), std::string::npos) << told(0.5);
  EXPECT_EQ(told(0.1).find("swells"), std::string::npos) << told(0.1);
}

/// As the last sound state had more energy of motion than of strain.
TEST(Diagnosis, TellsALoadThatComesTooFastFromOneThatIsTooLarge) {
  const Model model = uniaxial(0.9, 4);
  for (const double kinetic : {0.5, 2.0}) {
    SolveMeasures measures;
    SteppingResult result{};
    result.body = prepare(model, {}, {}, measures, {}, false).body;
    result.history.push_back({.strain_energy = 1, .kinetic_energy = kinetic});
    mark_unstable("it folded", 0.5, 0.5, Fault{.node = 7}, result);
    ASSERT_TRUE(result.unstable && result.fault);
    const std::string told = describe(*result.fault, result.body);
    const char* cause = kinetic > 1 ? "the load comes too fast; spread it over more steps" : "the load is too large";
    EXPECT_NE(told.find(cause), std::string::npos) << told;
    EXPECT_EQ(named_node(told, model.cloud), result.body.original[7]);
  }
}

/// Over 400 steps it comes to rest. Not tried again more slowly, as solve() would.
TEST(Diagnosis, SaysOfALoadInFiveStepsThatItComesTooFast) {
  const Model model = uniaxial(0.5, 5);
  SolveOptions options;
  options.load_steps = 5;
  SolveMeasures measures;
  Prepared prepared = prepare(model, options, {}, measures, {});
  const SolveResult result = step_to_end(model, options, std::move(prepared), measures, {}, {});
  ASSERT_TRUE(result.unstable) << result.measures.steps << " steps, smallest J " << result.measures.smallest_jacobian;
  EXPECT_NE(result.failure.find("the load comes too fast"), std::string::npos) << result.failure;
}

TEST(Diagnosis, NamesTheNodeThatIsNotYetAtRest) {
  Model model = uniaxial(0.9, 4);
  SolveOptions options;
  options.max_steps = 420;
  options.tolerance = 1e-9;
  const SolveResult result = solve(model, options);
  EXPECT_NE(result.failure.find("it moves most at node"), std::string::npos) << result.failure;
  named_node(result.failure, model.cloud);
}

TEST(Diagnosis, FindsTheNodeThatSwingsFromStepToStep) {
  NodalVectors now(40, 0.0), before(40, 0.0), earlier(40, 0.0);
  for (std::size_t a = 0; a < 10; ++a) {
    now[4 * a] = 3;  // all move evenly
    before[4 * a] = 2;
    earlier[4 * a] = 1;
  }
  now[4 * 7 + 1] = 0.5;
  before[4 * 7 + 1] = -4;
  earlier[4 * 7 + 1] = 0.4;
  Fault fault = restless_node({now, before, earlier});
  EXPECT_EQ(fault.node, 7);
  EXPECT_TRUE(fault.swings);
  before[4 * 7 + 1] = 0.45;
  now[4 * 7 + 1] = 6;
  fault = restless_node({now, before, earlier});
  EXPECT_EQ(fault.node, 7);
  EXPECT_FALSE(fault.swings);
  now[4 * 3 + 2] = std::nan("");
  EXPECT_EQ(restless_node({now, before, earlier}).node, 3);
}

}  // namespace brainshift::solve::diagnosis_test
