// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/archive.hpp"

#include <gtest/gtest.h>

namespace brainshift::solve::archive_test {

std::vector<char> written() {
  std::vector<char> bytes;
  ArchiveWriter writer(bytes);
  writer.plain(0.5);
  writer.many(std::vector<float>{1, 2, 3});
  writer.many(std::vector<int>());
  writer.points(Points(0, 3));
  writer.points(Points::Constant(2, 3, 7.0));
  writer.matrix(Eigen::MatrixXd(4, 0));
  return bytes;
}

TEST(Archive, GivesBackWhatWasPutIn) {
  const std::vector<char> bytes = written();
  ArchiveReader reader(bytes);
  double number = 0;
  std::vector<float> floats;
  std::vector<int> none = {1};
  Points points, no_points = Points::Zero(1, 3);
  reader.plain(number);
  reader.many(floats);
  reader.many(none);
  reader.points(no_points);
  reader.points(points);
  Eigen::MatrixXd no_columns;
  reader.matrix(no_columns);
  EXPECT_EQ(no_columns.rows(), 4);
  EXPECT_EQ(no_columns.cols(), 0);
  EXPECT_EQ(number, 0.5);
  EXPECT_EQ(floats, (std::vector<float>{1, 2, 3}));
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(no_points.rows(), 0);
  EXPECT_EQ(points, Points::Constant(2, 3, 7.0));
  EXPECT_TRUE(reader.at_end());
}

TEST(Archive, RefusesASizeThatTheBytesDoNotHold) {
  std::vector<char> bytes;
  ArchiveWriter writer(bytes);
  writer.plain(std::size_t{1} << 62);
  std::vector<double> values;
  EXPECT_THROW(ArchiveReader(bytes).many(values), std::length_error);
  writer.plain(1.0);
  Points points;
  EXPECT_THROW(ArchiveReader(bytes).points(points), std::length_error);
  double value = 0;
  EXPECT_THROW(ArchiveReader(std::span(bytes).first(3)).plain(value), std::length_error);
}

}  // namespace brainshift::solve::archive_test
