// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/each_force.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

#include "tests/unit/solve/ensemble/members.hpp"
#include "tests/unit/solve/material_cases.hpp"

namespace brainshift::solve::each_force_test {

using test::box_cells;
using test::irregular_box;

constexpr double side = 50;
constexpr std::size_t there = 11;  // members; the others are padding
const Material soft{.youngs_modulus = 10, .poisson_ratio = 0.1};

struct Case {
  Material material;
  double nodes_per_patch;
  Precision precision;
};

/// What GoogleTest calls it.
void PrintTo(const Case& tested, std::ostream* out) {
  PrintTo(tested.material, out);
}

class EachForceOf : public testing::TestWithParam<Case> {
 protected:
  Specimen body{irregular_box(6, side, 0.3),
                box_cells(4, side),
                {GetParam().material, soft},
                SpecimenOptions{.nodes_per_patch = GetParam().nodes_per_patch, .precision = GetParam().precision}};
  std::vector<PointLaws> laws = differing_laws({GetParam().material, soft}, there);
  EachForce force{body.points, laws};
  EachVectors parameters = differing_parameters(body, 0.8, there);

  double rounding() const { return GetParam().precision == Precision::single_precision ? 3e-6 : 1e-12; }
  /// internal_force() of one member alone.
  NodalVectors alone(std::size_t member) {
    body.laws = laws[member];
    return body.force(member_of(parameters, member));
  }
};

std::string name_of_case(const testing::TestParamInfo<Case>& tested) {
  const auto& [material, per_patch, precision] = tested.param;
  return name_of(material) + (per_patch > 0 ? "_patches" : "_pointwise") +
         (precision == Precision::single_precision ? "_single" : "_double");
}

INSTANTIATE_TEST_SUITE_P(Cases, EachForceOf,
                         testing::Values(Case{every_law.front(), 6, Precision::single_precision},
                                         Case{every_law.front(), 6, Precision::double_precision},
                                         Case{every_law.front(), 0, Precision::double_precision},
                                         Case{finite_strain_laws[3], 6, Precision::double_precision},
                                         Case{finite_strain_laws[4], 6, Precision::double_precision},
                                         Case{every_law.back(), 6, Precision::single_precision}),
                         name_of_case);

TEST_P(EachForceOf, IsThatOfEachMemberAlone) {
  EachVectors found(parameters.size());
  force.find(parameters, found);
  const Numbers smallest = force.smallest_jacobian();
  for (std::size_t m = 0; m < there; ++m) {
    const NodalVectors expected = alone(m), of_member = member_of(found, m);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_NEAR(of_member[i], expected[i], rounding() * largest(expected)) << "member " << m;
    }
    EXPECT_NEAR(smallest[static_cast<Eigen::Index>(m)], jacobian_range(body.scratch).smallest, 1e-5);
  }
}

/// A member does not feel the others: not their number, nor that one of them is inside out.
TEST_P(EachForceOf, DoesNotDependOnTheOthers) {
  EachVectors found(parameters.size()), beside(parameters.size());
  force.find(parameters, found);
  EachVectors wild = parameters;
  set_member(body.linear(-2 * Eigen::Matrix3d::Identity()), 3, wild);
  force.find(wild, beside);
  EXPECT_EQ(member_of(beside, 2), member_of(found, 2));
  EXPECT_EQ(member_of(beside, 4), member_of(found, 4));
  EXPECT_FALSE(force.smallest_jacobian()[3] > 0);
  EXPECT_GT(force.smallest_jacobian()[4], 0);
}

TEST_P(EachForceOf, IsTheSameBitForBitForAnyNumberOfThreads) {
  EachVectors one(parameters.size()), three(parameters.size());
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  force.find(parameters, one);
  omp_set_num_threads(3);
  force.find(parameters, three);
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof one[0]), 0);
  omp_set_num_threads(threads);
}

}  // namespace brainshift::solve::each_force_test
