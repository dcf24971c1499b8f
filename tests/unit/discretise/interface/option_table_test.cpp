// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/interface/option_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::discretise::option_table_test {

using test::refusal;

std::string fault(const DiscretiseOptions& options) {
  return refusal([&] { check_options(options); });
}

// A new member of the struct does not compile here. It goes into the table, or among those that the scene fills in.
TEST(DiscretiseOptions, AreAllInTheTable) {
  [[maybe_unused]] const auto& [spacing, nodes, minimum_distance, craniotomy, tumour_factor, tumour_label,
                                tissue_boundary_factor, alike, cells, cells_per_node, brain_labels, seed, resected] =
      DiscretiseOptions{};
  EXPECT_EQ(discretise_options().size() + 4, 13U)
      << "beside the craniotomy, the labels, which are alike and what is taken out";
  [[maybe_unused]] const auto& [centres, radius, factor, rim] = Refinement{};
  EXPECT_EQ(refinement_options().size() + 2, 4U) << "beside the centres and the rim";
}

TEST(DiscretiseOptions, AreAllowedAsTheyAreByDefaultAndAtTheirEnds) {
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({.spacing = 1e-6, .minimum_distance = 0.7}), "");
  EXPECT_EQ(fault({.nodes = 30, .tumour_factor = 0.1, .cells_per_node = 100}), "");
}

TEST(DiscretiseOptions, TakeASpacingOrANumberOfNodes) {
  EXPECT_EQ(fault({.spacing = 5.0, .nodes = 500}), "both spacing and nodes are given; give one of them");
}

TEST(DiscretiseOptions, OutOfRangeAreRefusedByTheirNames) {
  for (const double bad : {std::nan(""), -1.0, 0.0}) {
    EXPECT_TRUE(fault({.spacing = bad}).starts_with("spacing is '")) << bad;
    EXPECT_TRUE(fault({.tumour_factor = bad}).starts_with("tumour_factor is '")) << bad;
    EXPECT_TRUE(fault({.tissue_boundary_factor = bad}).starts_with("tissue_boundary_factor is '")) << bad;
    EXPECT_TRUE(fault({.cells_per_node = bad}).starts_with("cells_per_node is '")) << bad;
  }
  EXPECT_EQ(fault({.nodes = 5}), "nodes is '5', but must be a whole number from 30 to 20000000, or nothing");
  EXPECT_EQ(fault({.minimum_distance = 0.9}), "minimum_distance is '0.9', but must be a number from 0 to 0.7");
  EXPECT_EQ(fault({.minimum_distance = std::nan("")}), "minimum_distance is 'nan', but must be a number from 0 to 0.7");
  EXPECT_EQ(fault({.cells = CellKind::triangle}).substr(0, 8), "cells is") << "a body has no planar cells";
}

TEST(DiscretiseOptions, OfARefinementAreCheckedWhereThereIsOne) {
  EXPECT_EQ(fault({.craniotomy = Refinement{Points::Zero(1, 3), 20, 0.1}}), "");
  for (const double bad : {std::nan(""), -1.0, 0.0}) {
    EXPECT_TRUE(fault({.craniotomy = Refinement{Points::Zero(1, 3), 20, bad}}).starts_with("craniotomy_factor is '"));
    EXPECT_TRUE(fault({.craniotomy = Refinement{Points::Zero(1, 3), bad, 0.5}}).starts_with("craniotomy_radius is '"));
  }
  EXPECT_EQ(fault({.craniotomy = Refinement{Points::Constant(2, 3, std::nan("")), 20, 0.5}}),
            "a centre of the craniotomy's refinement is not finite");
}

}  // namespace brainshift::discretise::option_table_test
