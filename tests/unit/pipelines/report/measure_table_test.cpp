// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/measure_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(MeasureTable, WithoutAMeasuredDisplacementThereIsNoneToMiss) {
  for (const int loaded : {0, 3}) {
    const nlohmann::json record = {
        {"stages", {{"solve", {{"sizes", {{"loaded_nodes", loaded}}}, {"measures", {{"constraint_error_mm", 0.0}}}}}}}};
    EXPECT_EQ(quality_measures(record).size(), loaded > 0 ? 1U : 0U);
  }
}

TEST(MeasureTable, ComparesVolumesAndFlagsAndLeavesOutWhatIsNotThere) {
  const nlohmann::json record = nlohmann::json::parse(R"({"stages": {"segment": {"measures": {"brain":
      {"closed": true, "self_intersecting": true, "volume_mm3": 98, "label_volume_mm3": 100}}}}})");
  const auto rows = quality_measures(record);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].verdict, Verdict::within);
  EXPECT_EQ(rows[1].verdict, Verdict::outside) << "the surface cuts itself";
  EXPECT_EQ(rows[2].verdict, Verdict::outside) << "2 % where 1 % is allowed";
  EXPECT_EQ(rows[2].value, "-2 %");
}

TEST(MeasureTable, NumbersHaveThreeFiguresAndWholeOnesAll) {
  EXPECT_EQ(readable(0.012345), "0.0123");
  EXPECT_EQ(readable(12), "12");
  EXPECT_EQ(readable(-1234567), "-1,234,567");
  EXPECT_EQ(readable(1234.6), "1,235");
  EXPECT_EQ(readable(999.7), "1,000");
  EXPECT_EQ(readable(999.4), "999");
  EXPECT_EQ(readable(std::nan("")), "not known");
}

}  // namespace brainshift::pipelines::measure_table_test
