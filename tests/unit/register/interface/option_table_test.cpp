// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/interface/option_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::registration::option_table_test {

using test::refusal;

std::string fault(const RegisterOptions& options) {
  return refusal([&] { check_options(options); });
}

// A new member of the struct does not compile here: it goes into the table.
TEST(RegisterOptions, AreAllInTheTable) {
  [[maybe_unused]] const auto& [fade, interpolation, inverse_tolerance, cavity_label, cavity_value, device] =
      RegisterOptions{};
  EXPECT_EQ(register_options().size(), 6U);
}

TEST(RegisterOptions, AreAllowedAsTheyAreByDefaultAndWithinTheirRanges) {
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({.fade = 999, .interpolation = Interpolation::bspline, .inverse_tolerance = 1e-9}), "");
}

TEST(RegisterOptions, OutOfRangeAreRefusedWithTheirUnit) {
  EXPECT_EQ(fault({.inverse_tolerance = 0}), "inverse_tolerance is '0', but must be a number > 0 (mm)");
  for (const double bad : {0.0, 1000.0, -1.0, std::nan("")}) {
    EXPECT_TRUE(fault({.fade = bad}).starts_with("fade is '")) << bad;
    EXPECT_TRUE(fault({.fade = bad}).ends_with("(mm)")) << bad;
  }
}

TEST(RegisterOptions, AreReadIntoTheMembersOfTheirNames) {
  RegisterOptions options;
  for (const auto& [name, text] : {std::pair("fade", "3"),
                                   {"interpolation", "bspline"},
                                   {"inverse_tolerance", "2"},
                                   {"cavity_label", "24"},
                                   {"cavity_value", "-5"},
                                   {"device", "auto"}}) {
    ASSERT_TRUE(set_option(*find_option(register_options(), name), options, text)) << name;
  }
  EXPECT_EQ(options.fade, 3);
  EXPECT_EQ(options.interpolation, Interpolation::bspline);
  EXPECT_EQ(options.inverse_tolerance, 2);
  EXPECT_EQ(options.cavity_label, 24);
  EXPECT_EQ(options.cavity_value, -5);
  EXPECT_EQ(options.device, solve::Device::automatic);
}

}  // namespace brainshift::registration::option_table_test
