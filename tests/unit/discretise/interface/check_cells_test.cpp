// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells that a program made itself; files go the same way, background_cells_test.
#include "discretise/interface/background_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::check_cells_test {

using Change = std::function<void(BackgroundCells&)>;

std::string fault_of(const Change& change) {
  BackgroundCells cells = test::box_cells(3, 30);
  change(cells);
  return test::refusal([&] { check_cells(cells); });
}

TEST(CheckCells, TakesSoundOnes) {
  EXPECT_EQ(fault_of([](BackgroundCells&) {}), "");
}

TEST(CheckCells, NamesTheCellThatIsWrong) {
  using Cells = BackgroundCells;
  const std::pair<Change, const char*> faults[] = {
      {[](Cells& c) { c.connectivity[17] = 64; }, "cell 2 has a corner that is no vertex"},
      {[](Cells& c) { c.connectivity[17] = -1; }, "cell 2 has a corner that is no vertex"},
      {[](Cells& c) { c.inside_fraction[4] = std::nan(""); }, "cell 4 has inside_fraction"},
      {[](Cells& c) { c.inside_fraction[4] = 2; }, "cell 4 has inside_fraction"},
      {[](Cells& c) { c.cut_index.assign(27, 0); }, "cell 0 has a cut_index"},
      {[](Cells& c) { std::swap_ranges(&c.connectivity[8], &c.connectivity[12], &c.connectivity[12]); },
       "cell 1 is inverted or flat"},
  };
  for (const auto& [change, sentence] : faults) {
    EXPECT_NE(fault_of(change).find(sentence), std::string::npos) << sentence << ": " << fault_of(change);
  }
}

TEST(CheckCells, WantsArraysOfOneLength) {
  using Cells = BackgroundCells;
  for (const Change& change :
       {Change([](Cells& c) { c.connectivity.pop_back(); }), Change([](Cells& c) { c.label.clear(); }),
        Change([](Cells& c) { c.cut_index.assign(3, -1); })}) {
    EXPECT_NE(fault_of(change).find("of 27 background cells"), std::string::npos) << fault_of(change);
  }
  EXPECT_NE(fault_of([](Cells& c) { c = {}; }).find("there is no background cell"), std::string::npos);
  EXPECT_NE(fault_of([](Cells& c) { c.vertices(5, 1) = INFINITY; }).find("not finite"), std::string::npos);
}

TEST(CheckCells, RefusesOctantsOfAnythingButHexahedra) {
  BackgroundCells cells = test::box_tetrahedra(test::irregular_box(2, 10), 2);
  EXPECT_EQ(test::refusal([&] { check_cells(cells); }), "");
  cells.cut_index.assign(cells.size(), 0);
  cells.cut_parts.resize(1);
  EXPECT_NE(test::refusal([&] { check_cells(cells); }).find("hexahedra alone"), std::string::npos);
}

TEST(CheckCells, TakesAWedgeOfWhichTwoEdgesOfAHexahedronMeetAndNothingFlat) {
  const auto lift = [](double z) {
    return [z](BackgroundCells& cells) {
      cells = test::box_cells(1, 10);
      for (const int corner : {4, 5, 6, 7}) {
        cells.vertices(cells.connectivity[static_cast<std::size_t>(corner)], 2) = corner < 6 ? 0 : z;
      }
    };
  };
  EXPECT_EQ(fault_of(lift(10)), "");
  EXPECT_NE(fault_of(lift(0)).find("cell 0 is inverted or flat"), std::string::npos);
}

TEST(CheckCells, TakesTwoPartsOfOneCell) {
  BackgroundCells cells = test::box_cells(1, 10);
  for (std::size_t k = 0; k < 8; ++k) {
    cells.connectivity.push_back(cells.connectivity[k]);
  }
  cells.inside_fraction = {0.4, 0.6};
  cells.label = {1, 2};
  EXPECT_EQ(test::refusal([&] { check_cells(cells); }), "");
}

TEST(CheckCells, RefusesACellThatIsThereTwice) {
  const std::string fault = fault_of([](BackgroundCells& cells) {
    for (std::size_t k = 0; k < 8; ++k) {
      cells.connectivity.push_back(cells.connectivity[40 + (k / 4 * 4) + (k + 1) % 4]);  // turned
    }
    cells.inside_fraction.push_back(1);
    cells.label.push_back(1);
  });
  EXPECT_NE(fault.find("cells 5 and 27 are in one place"), std::string::npos) << fault;
}

}  // namespace brainshift::check_cells_test
