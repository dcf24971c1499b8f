// SPDX-License-Identifier: GPL-3.0-or-later
//
// Drained fluid, swelling and resections at the ends of what they may be, through the program.
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/bad_input.hpp"

namespace brainshift::fluid_test {

class Fluid : public bad_input::BadInput {
 protected:
  static std::string with(const std::string& options) {
    return run_scene("scene.xml") + " --until solve --set solve.tolerance=0.01 " + options;
  }
  static Points moved(const std::string& options) {
    const ProgramResult result = run_shell(with(options));
    EXPECT_EQ(result.code, 0) << result.err;
    return read_solution(at("out/solve/solution.vtu")).displacement;
  }
  static double difference(const Points& a, const Points& b) { return (a - b).rowwise().norm().maxCoeff(); }
};

TEST_F(Fluid, AboveTheHeadMovesNothingAndBelowItIsAllOfTheHead) {
  const std::string down = "--set gravity.direction=0,0,-1 ";
  const Points without = moved("");
  EXPECT_LT(difference(moved(down + "--set gravity.fluid_level=-5000"), without), 1e-6) << "covered";
  const Points dry = moved(down + "--set gravity.drained=100");
  EXPECT_GT(difference(dry, without), 0.1);
  EXPECT_LT(difference(moved(down + "--set gravity.fluid_level=5000"), dry), 0.02) << "twice the tolerance";
}

TEST_F(Fluid, WithoutADirectionIsRefused) {
  expect_refused(with("--set gravity.direction=0,0,0 --set gravity.drained=30"), {"say which way things fall"});
}

TEST_F(Fluid, ATissueMayHalveAndNotVanish) {
  EXPECT_GT(moved("--set tissues.1.swelling=-0.5").rowwise().norm().maxCoeff(), 5);
  expect_refused(with("--set tissues.1.swelling=-1"), {"swelling is '-1'", "from -0.9 to 10"});
}

}  // namespace brainshift::fluid_test
