// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/fields_on_device.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "register/field/outside.hpp"
#include "register/field/span_cavity.hpp"
#include "solve/shape/node_supports.hpp"

namespace brainshift::registration::device {

namespace {

VoxelGrid voxel_grid(const ImageGeometry& g) {
  return {g.size, g.spacing, g.origin, g.direction, g.index_from_world()};
}

DistanceGrid put(const SignedDistance& distance, solve::device::Memory& memory) {
  DistanceGrid grid = distance.grid();
  grid.sample = memory.put(distance.samples().value);
  return grid;
}

FitRules rules_of(const ShapeOptions& shape) {
  return {shape.basis == Basis::linear ? 1 : 2, shape.basis == Basis::modified_quadratic ? shape.penalty : 0};
}

}  // namespace

FieldsOnDevice::FieldsOnDevice(const Backend& backend, const Solution& solution, const Points& parameters,
                               const BrainZones& zones, const ImageGeometry& geometry, double fade, double tolerance)
    : backend_(backend), zones_(zones), geometry_(geometry), memory_(backend.memory), view_{} {
  const std::size_t count = geometry.voxel_count();
  const NodeBins bins =
      node_bins(solution.positions, solve::support_radii(solution.spacing, solution.shape), parameters);
  view_.grid = voxel_grid(geometry);
  view_.nodes = view_of(bins, memory_.put(bins.node), memory_.put(bins.begin));
  view_.rules = rules_of(solution.shape);
  view_.outside = put(zones.outside, memory_);
  view_.wall = {1, Eigen::Vector3d::Zero(), Eigen::Array3i::Zero(), nullptr};
  if (zones.wall) {
    view_.wall = put(*zones.wall, memory_);
  }
  view_.reach = reach_of(zones.shell, least_spacing(solution.spacing));
  view_.fade = fade;
  view_.tolerance = tolerance;
  view_.zone = memory_.put(zones.zone);
  view_.part = memory_.room<std::uint8_t>(count);
  view_.field = memory_.room<Displacement>(count);
  view_.next = memory_.room<Displacement>(count);
  view_.resampling = memory_.room<Displacement>(count);
  view_.left = memory_.room<std::int32_t>(count);
  view_.counts = memory_.room<Counts>(1);
}

Counts FieldsOnDevice::read_counts() const {
  Counts counts{};
  backend_.memory.from_device(&counts, view_.counts, sizeof counts);
  return counts;
}

void FieldsOnDevice::find_forward(const solve::ShapeFunctions& shape) {
  backend_.memory.clear(view_.counts, sizeof(Counts));
  backend_.memory.clear(view_.field, geometry_.voxel_count() * sizeof(Displacement));
  perform(Task::part);
  evaluate(shape);
  if (zones_.wall) {
    span();
  }
  extend();
  smooth();
  perform(Task::fade);
}

void FieldsOnDevice::evaluate(const solve::ShapeFunctions& shape) {
  perform(Task::evaluate);
  grown_ = read_counts().left;
  if (grown_ > 0) {
    backend_.perform(Task::grow, view_, items(Task::grow, view_, grown_));
    if (read_counts().lost > 0) {
      throw_lost(shape, grown_);
    }
  }
}

/// Asks the processor, who says it.
void FieldsOnDevice::throw_lost(const solve::ShapeFunctions& shape, int left) const {
  std::vector<std::int32_t> voxels(static_cast<std::size_t>(left));
  backend_.memory.from_device(voxels.data(), view_.left, voxels.size() * sizeof(std::int32_t));
  const auto lost = static_cast<std::size_t>(-1 - *std::min_element(voxels.begin(), voxels.end()));
  const Eigen::Vector3d x = view_.grid.world(view_.grid.place(lost));
  const bool in_shell = zones_.zone[lost] == Zone::shell;
  Points place(1, 3);
  place.row(0) = in_shell ? place_in_shell(zones_.outside.grid(), x, view_.reach) : x;
  shape.evaluate(place, false);
  throw std::logic_error("a GPU finds no support where the processor finds one; register with device cpu");
}

/// By the processor, who solves for few voxels.
void FieldsOnDevice::span() {
  const std::vector<std::uint8_t> part = read(view_.part);
  std::vector<std::size_t> hollow;
  for (std::size_t v = 0; v < part.size(); ++v) {
    if ((part[v] & Part::hollow) != 0) {
      hollow.push_back(v);
    }
  }
  if (!hollow.empty()) {
    VectorImage field = forward();
    span_cavity(
        hollow, [&](std::size_t voxel) { return zones_.zone[voxel] >= Zone::shell; }, field);
    backend_.memory.to_device(view_.field, field.voxels.data(), field.voxels.size() * sizeof(Displacement));
  }
}

/// Afterwards `field` and `next` are the same.
void FieldsOnDevice::extend() {
  const std::size_t bytes = geometry_.voxel_count() * sizeof(Displacement);
  backend_.memory.copy(view_.next, view_.field, bytes);
  perform(Task::extend);
  backend_.memory.copy(view_.field, view_.next, bytes);
}

void FieldsOnDevice::smooth() {
  const double sweeps = smoothing_sweeps(geometry_.spacing);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    perform(Task::smooth);
    std::swap(view_.field, view_.next);
  }
}

void FieldsOnDevice::find_resampling() {
  backend_.memory.clear(view_.counts, sizeof(Counts));
  backend_.memory.clear(view_.resampling, geometry_.voxel_count() * sizeof(Displacement));
  perform(Task::invert);
}

void FieldsOnDevice::take(const ScalarImage& image) {
  view_.image = memory_.put(image.voxels);
  view_.warped = memory_.room<float>(image.voxels.size());
}

void FieldsOnDevice::take(const LabelMap& labels) {
  view_.labels = memory_.put(labels.voxels);
  view_.warped_labels = memory_.room<std::uint16_t>(labels.voxels.size());
}

void FieldsOnDevice::warp_image() {
  perform(Task::warp_image);
}

void FieldsOnDevice::warp_labels() {
  perform(Task::warp_labels);
}

InvertedField FieldsOnDevice::resampling() const {
  return {{geometry_, read(view_.resampling)}, static_cast<std::size_t>(read_counts().not_inverted)};
}

}  // namespace brainshift::registration::device
