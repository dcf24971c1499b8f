// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "register/files/out_stream.hpp"
#include "register/warp/point_mover.hpp"

namespace brainshift::registration {

/// MRtrix's track scalar files (.tsf) of the values that go along with the points of a .tck: beside it, a file a value,
/// none where nothing goes along.
class TrackScalars {
 public:
  /// header: the lines of the .tck's header but the first and END; by its timestamp and count MRtrix knows that files
  /// belong together.
  TrackScalars(const std::filesystem::path& tck, const std::string& header, const PointMover& mover);

  /// The next point of a tract, mm, LPS, before it is moved.
  void add(const Eigen::Vector3d& place);
  void end_tract();
  /// Throws std::runtime_error when one could not be written whole.
  void finish();

 private:
  void write(std::size_t file, float value);

  const PointMover& mover_;
  std::vector<std::unique_ptr<OutStream>> files_;
  std::vector<Eigen::Vector3d> places_;  ///< of this tract
};

}  // namespace brainshift::registration
