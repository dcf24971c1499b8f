// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/phantom.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "segmentation/image/voxels.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {

namespace {

using Eigen::Vector3d;

constexpr double natural_extent = 192;  // mm, of the image of a head of scale 1

Eigen::Matrix3d direction_of(PhantomFrame frame) {
  if (frame == PhantomFrame::oblique) {
    return Eigen::AngleAxisd(25 * std::numbers::pi / 180, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  }
  Eigen::Matrix3d exchanged;
  exchanged << 0, 0, -1,  //
      0, 1, 0,            //
      -1, 0, 0;
  return exchanged;
}

ImageGeometry grid_around(const Vector3d& centre, const PhantomOptions& options) {
  ImageGeometry geometry;
  geometry.size.setConstant(options.size);
  geometry.spacing.setConstant(options.spacing);
  geometry.direction = direction_of(options.frame);
  const double half = 0.5 * (options.size - 1) * options.spacing;
  geometry.origin = centre - geometry.direction * Vector3d::Constant(half);
  return geometry;
}

std::vector<Landmark> make_landmarks(const Head& head, const Opening& opening) {
  const auto inward = [&](double depth) -> Vector3d { return opening.centre - depth * head.scale * opening.normal; };
  return {{"cortex", inward(4)},
          {"tumour", head.tumour.centre},
          {"deep", inward(35)},
          {"left ventricle", head.ventricles[0].centre},
          {"right ventricle", head.ventricles[1].centre},
          {"opposite", head.brain.centre - head.scale * Vector3d(40, 0, 10)}};
}

// Calls set(offset, index) for every voxel.
template <class Set>
void for_each_index(const ImageGeometry& geometry, const Set& set) {
  for_each_voxel_in_parallel(geometry.size,
                             [&](int i, int j, int k) { set(geometry.offset(i, j, k), Vector3d(i, j, k)); });
}

}  // namespace

const OptionTable<PhantomOptions>& phantom_options() {
  using Options = PhantomOptions;
  static const OptionTable<Options> table = {
      number_option<Options>("size", &Options::size, {.low = 24, .high = 1024}, "", "voxels along each axis"),
      number_option<Options>("spacing", &Options::spacing, {.low = 0.1, .high = 10, .low_allowed = false}, "mm",
                             "of the voxels"),
      number_option<Options>("csf_gap", &Options::csf_gap, {.low = 0, .high = 4}, "mm",
                             "fluid between brain and skull"),
      number_option<Options>("seed", &Options::seed, not_negative, "", "of the texture")};
  return table;
}

Phantom make_phantom(const PhantomOptions& options) {
  check_table(phantom_options(), options);
  constexpr double smallest = 28;  // mm across: brains from 20 mm on are taken
  if (!(options.size * options.spacing >= smallest)) {
    throw std::invalid_argument("size times spacing is " + write_number(options.size * options.spacing) +
                                " mm, at least " + write_number(smallest) + " are needed; give more or larger voxels");
  }
  const Vector3d centre(-11, 23, 37);  // away from the origin, as scanners have it
  const Head head = make_head(centre, options.size * options.spacing / natural_extent, options.csf_gap);
  const Opening opening = make_opening(head);
  return {.head = head,
          .geometry = grid_around(centre, options),
          .opening = opening,
          .load = measured_load(head, opening),
          .landmarks = make_landmarks(head, opening)};
}

LabelMap sample_labels(const Phantom& phantom) {
  LabelMap labels{.geometry = phantom.geometry, .voxels = std::vector<std::uint16_t>(phantom.geometry.voxel_count())};
  for_each_index(phantom.geometry, [&](std::size_t offset, const Vector3d& index) {
    labels.voxels[offset] = tissue_at(phantom.head, phantom.geometry.to_world(index));
  });
  return labels;
}

ScalarImage sample_t1(const Phantom& phantom, std::uint64_t seed) {
  ScalarImage t1{.geometry = phantom.geometry, .voxels = std::vector<float>(phantom.geometry.voxel_count())};
  for_each_index(phantom.geometry, [&](std::size_t offset, const Vector3d& index) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d shift((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5, ((corner >> 2) & 1) - 0.5);
      sum += t1_intensity(phantom.head, phantom.geometry.to_world(index + 0.5 * shift), seed);
    }
    t1.voxels[offset] = static_cast<float>(sum / 8);
  });
  return t1;
}

}  // namespace brainshift::pipelines
