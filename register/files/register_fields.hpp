// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// Which brain things are taken to.
enum class Towards : std::uint8_t { intraop, preop };

/// The fields of a register folder, each read when it is first asked for. Points move with the map that goes their way,
/// images are resampled by the one that comes back. With the run's solution it knows, too, how far the displacement may
/// be off, where that was estimated.
class RegisterFields {
 public:
  /// `solution`: the run's solution.vtu; where there is none, nothing is known of the error. Throws
  /// std::invalid_argument when the folder lacks the fields.
  RegisterFields(std::filesystem::path folder, Towards towards, std::filesystem::path solution = {});

  Towards towards() const { return towards_; }
  const VectorImage& of_points() { return read(towards_ == Towards::intraop); }
  const VectorImage& of_images() { return read(towards_ == Towards::preop); }

  /// The estimated error, mm, at points (n × 3, LPS) before they are moved; none where the run has no estimate.
  std::optional<std::vector<double>> error_of_points(const Points& points);
  /// The same at the voxels of a warped image's grid.
  std::optional<ScalarImage> error_on(const ImageGeometry& grid);

 private:
  const VectorImage& read(bool forward);
  /// Null where there is no estimate.
  const Solution* estimate();

  std::filesystem::path folder_;
  Towards towards_;
  std::filesystem::path solution_file_;
  std::optional<VectorImage> forward_, resampling_;
  std::optional<Solution> solution_;
};

}  // namespace brainshift::registration
