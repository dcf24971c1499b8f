// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "register/device/backend.hpp"
#include "register/field/brain_zones.hpp"
#include "register/field/resampling_field.hpp"
#include "segmentation/image/image.hpp"
#include "solve/device/memory.hpp"
#include "solve/interface/solution.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::registration::device {

/// The fields of a grid and the images on it, in the memory of a device: what forward_field(), resampling_field() and
/// warp() do, in their order. What a device is given stays there, so that each may be asked for again.
class FieldsOnDevice {
 public:
  /// parameters: û at the nodes, (n × 3) mm. The zones are of this geometry. backend and zones must outlive it.
  FieldsOnDevice(const Backend& backend, const Solution& solution, const Points& parameters, const BrainZones& zones,
                 const ImageGeometry& geometry, double fade, double tolerance);

  /// The forward field. Throws as forward_field(); shape: the solution's, asked only to say where they do not reach.
  void find_forward(const solve::ShapeFunctions& shape);
  /// After find_forward().
  void find_resampling();
  /// After find_resampling(); images on the grid, T1 linearly.
  void take(const ScalarImage& image);
  void take(const LabelMap& labels);
  void warp_image();
  void warp_labels();

  VectorImage forward() const { return {geometry_, read(view_.field)}; }
  InvertedField resampling() const;
  ScalarImage warped() const { return {geometry_, read(view_.warped)}; }
  LabelMap warped_labels() const { return {geometry_, read(view_.warped_labels)}; }

  /// Voxels of the last find_forward() that were not found at the first try.
  int grown() const { return grown_; }
  /// Waits until all that was begun is done.
  void wait() const { read_counts(); }

 private:
  template <class Number>
  std::vector<Number> read(const Number* from) const {
    std::vector<Number> voxels(geometry_.voxel_count());
    backend_.memory.from_device(voxels.data(), from, voxels.size() * sizeof(Number));
    return voxels;
  }
  Counts read_counts() const;
  void perform(Task task) const { backend_.perform(task, view_, items(task, view_)); }
  void evaluate(const solve::ShapeFunctions& shape);
  void span();
  void extend();
  void smooth();
  [[noreturn]] void throw_lost(const solve::ShapeFunctions& shape, int left) const;

  const Backend& backend_;
  const BrainZones& zones_;
  ImageGeometry geometry_;
  solve::device::Memory memory_;
  View view_;
  int grown_ = 0;
};

}  // namespace brainshift::registration::device
