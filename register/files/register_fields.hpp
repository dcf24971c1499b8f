// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "register/field/nodal_values.hpp"
#include "segmentation/files/point_values.hpp"
#include "segmentation/image/image.hpp"
#include "solve/interface/solution.hpp"

namespace brainshift::registration {

/// Files of a register folder: the map of points and that of images.
inline constexpr const char* forward_name = "preop_to_intraop.nii.gz";
inline constexpr const char* resampling_name = "intraop_to_preop.nii.gz";

/// Another: 1 in the preop voxels of what a resection has taken out; absent where nothing was.
inline constexpr const char* removed_name = "removed.nii.gz";

/// Which brain things are taken to.
enum class Towards : std::uint8_t { intraop, preop };

/// The fields of a register folder, each read when it is first asked for. Points move with the map that goes their way,
/// images are resampled by the one that comes back. With the run's solution, and the uncertainty.vtu beside it, it
/// knows, too, how far the displacement may be off.
class RegisterFields {
 public:
  /// `solution`: the run's solution.vtu; where there is none, nothing is known of that. Throws
  /// std::invalid_argument when the folder lacks the fields.
  RegisterFields(std::filesystem::path folder, Towards towards, std::filesystem::path solution = {});

  Towards towards() const { return towards_; }
  const VectorImage& of_points() { return read(towards_ == Towards::intraop); }
  const VectorImage& of_images() { return read(towards_ == Towards::preop); }

  /// Whether a place, before it is moved, lies in what a resection has taken out: of the intraop brain, where the map
  /// of points takes it.
  bool is_removed(const Eigen::Vector3d& place);
  /// What is taken out of images on the way; nothing towards preop, where it is not in them.
  const std::optional<LabelMap>& removed();

  /// How far the displacement may be off, mm, at points (n × 3, LPS) before they are moved: what the run has of
  /// "estimated_error", for want of nodes, and "uncertainty", the standard deviation of its uncertainty.vtu; NaN
  /// outside the brain and in what was taken out, where nothing is known. Throws std::invalid_argument, naming the
  /// file, when one of both cannot be read.
  std::vector<PointValues> values_of_points(const Points& points);
  /// The same at the voxels of a warped image's grid; 0 outside.
  std::vector<std::pair<std::string, ScalarImage>> values_on(const ImageGeometry& grid);

 private:
  const VectorImage& read(bool forward);
  const std::optional<LabelMap>& taken_out();
  /// Reads what is known at the nodes, once.
  void read_nodes();

  std::filesystem::path folder_;
  Towards towards_;
  std::filesystem::path solution_file_;
  std::optional<VectorImage> forward_, resampling_;
  std::optional<LabelMap> removed_;
  bool looked_for_removed_ = false;
  std::optional<Solution> solution_;
  std::vector<PointValues> at_nodes_;
  NodalLookUp look_up_;
};

/// The array uncertainty of a solve stage's uncertainty.vtu, mm, one a node. Throws std::invalid_argument, naming the
/// file, when it is at fault.
std::vector<double> read_deviations(const std::filesystem::path& file);

}  // namespace brainshift::registration
