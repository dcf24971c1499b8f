// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "segmentation/image/image.hpp"

namespace brainshift::registration {

/// Which brain things are taken to.
enum class Towards : std::uint8_t { intraop, preop };

/// The fields of a register folder, each read when it is first asked for. Points move with the map that goes their way,
/// images are resampled by the one that comes back.
class RegisterFields {
 public:
  /// Throws std::invalid_argument when the folder lacks them.
  RegisterFields(std::filesystem::path folder, Towards towards);

  const VectorImage& of_points() { return read(towards_ == Towards::intraop); }
  const VectorImage& of_images() { return read(towards_ == Towards::preop); }

 private:
  const VectorImage& read(bool forward);

  std::filesystem::path folder_;
  Towards towards_;
  std::optional<VectorImage> forward_, resampling_;
};

}  // namespace brainshift::registration
