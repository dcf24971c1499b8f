// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/measure_table.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines::measure_table_test {

TEST(MeasureTable, JudgesByTheBound) {
  const auto verdict_of = [](double error) {
    const nlohmann::json record = {{"stages", {{"solve", {{"measures", {{"constraint_error_mm", error}}}}}}}};
    return quality_measures(record).at(0).verdict;
  };
  EXPECT_EQ(verdict_of(0.05), Verdict::within);
  EXPECT_EQ(verdict_of(0.051), Verdict::outside);
  EXPECT_EQ(verdict_of(std::nan("")), Verdict::outside);
}

}  // namespace brainshift::pipelines::measure_table_test
