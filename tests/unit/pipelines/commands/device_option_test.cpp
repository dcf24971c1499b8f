// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <optional>

#include "pipelines/commands/commands.hpp"

namespace brainshift::pipelines::device_option_test {

std::optional<solve::Device> parsed(const std::string& arguments) {
  std::optional<solve::Device> device;
  CLI::App command;
  add_device_option(command, device);
  command.parse(arguments);
  return device;
}

TEST(DeviceOption, IsThatOfTheSolveStageOrAbsent) {
  EXPECT_EQ(parsed(""), std::nullopt);
  EXPECT_EQ(parsed("--device cpu"), solve::Device::cpu);
  EXPECT_EQ(parsed("--device auto"), solve::Device::automatic);
  EXPECT_THROW(parsed("--device gpu"), CLI::ValidationError);
}

}  // namespace brainshift::pipelines::device_option_test
