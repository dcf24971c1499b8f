// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/material_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/chapter_critical_step.hpp"

namespace brainshift::solve::material_table_test {

const std::map<std::int32_t, Material> of_head = {
    {1, {.youngs_modulus = 3000, .poisson_ratio = 0.45, .density = 1040}},
    {2, {.youngs_modulus = 9000, .poisson_ratio = 0.4, .density = 1100}},
    {7, {.youngs_modulus = 10, .poisson_ratio = 0.1, .density = 1000}},
};

TEST(MaterialTable, HasARowForEachLabelThatOccurs) {
  const std::vector<std::int32_t> label = {2, 2, 1, 2, 1};
  const MaterialTable table = material_table(of_head, label);
  ASSERT_EQ(table.material.size(), 2U);
  EXPECT_EQ(table.row_of_point, (std::vector<std::int32_t>{0, 0, 1, 0, 1}));
  EXPECT_EQ(table.material[0].youngs_modulus, 9000);
  EXPECT_EQ(table.material[1].youngs_modulus, 3000);
  EXPECT_DOUBLE_EQ(table.density[0], 1.1e-3) << "g/mm³";
  EXPECT_TRUE(table.prony.empty()) << "nothing relaxes";
}

TEST(MaterialTable, ListsPronyTermsOfEveryRowWhereOneRelaxes) {
  std::map<std::int32_t, Material> materials = of_head;
  materials.at(1).prony = {{0.3, 2}, {0.2, 50}};
  const MaterialTable table = material_table(materials, std::vector<std::int32_t>{2, 1});
  ASSERT_EQ(table.prony.size(), 2U);
  EXPECT_TRUE(table.prony[0].empty());
  ASSERT_EQ(table.prony[1].size(), 2U);
  EXPECT_EQ(table.prony[1][1].time, 50);
}

TEST(MaterialTable, RefusesALabelWithoutAMaterialAndOneWithABadMaterial) {
  std::map<std::int32_t, Material> materials = of_head;
  const auto fault = [&](std::int32_t label) {
    return test::refusal([&] { material_table(materials, std::vector<std::int32_t>{1, label}); });
  };
  EXPECT_NE(fault(5).find("label 5"), std::string::npos) << fault(5);
  materials.at(7).poisson_ratio = 0.5;
  EXPECT_NE(fault(7).find("the material of label 7"), std::string::npos) << fault(7);
  EXPECT_EQ(fault(2), "") << "a bad material that does not occur does not matter";
}

/// At a Poisson's ratio of 0 the modulus λ + 2µ is E.
TEST(WaveSpeed, IsThatOfDilatationalWaves) {
  EXPECT_NEAR(wave_speed({.youngs_modulus = 4000, .poisson_ratio = 0, .density = 1000}), 2000, 1e-9) << "mm/s";
  const double nu = 0.45;
  const double modulus = 3000 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(wave_speed(of_head.at(1)), 1000 * std::sqrt(modulus / 1040), 1e-9 * 1000);
}

}  // namespace brainshift::solve::material_table_test
