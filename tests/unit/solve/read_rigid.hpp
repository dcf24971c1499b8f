// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sstream>
#include <string>

#include "segmentation/files/text_lines.hpp"
#include "solve/load/rigid_fit.hpp"

namespace brainshift::test {

/// The twelve numbers of an ITK text transform, row by row.
inline solve::RigidMotion read_rigid(const std::filesystem::path& file) {
  const std::string text = read_text(file), before_numbers = "AffineTransform_double_3_3\nParameters: ";
  std::istringstream numbers(text.substr(text.find(before_numbers) + before_numbers.size()));
  solve::RigidMotion motion;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      numbers >> motion.rotation(row, column);
    }
  }
  numbers >> motion.translation[0] >> motion.translation[1] >> motion.translation[2];
  return motion;
}

}  // namespace brainshift::test
