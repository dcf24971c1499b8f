// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "discretise/discretise.hpp"
#include "discretise/interface/background_cells.hpp"
#include "tests/unit/discretise/bodies.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/shapes.hpp"

namespace brainshift::planar_test {

using test::refusal;

TEST(Discretise, FillsNoBodyWithPlanarCells) {
  for (const CellKind kind : {CellKind::quadrilateral, CellKind::triangle}) {
    discretise::DiscretiseOptions options;
    options.cells = kind;
    const std::string sentence = refusal([&] {
      discretise::discretise(test::box({0, 0, 0}, {20, 20, 20}), nullptr, options);
    });
    EXPECT_NE(sentence.find("hexahedra | tetrahedra"), std::string::npos) << sentence;
  }
}

}  // namespace brainshift::planar_test
