// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/registration.hpp"

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "register/device/register_on_device.hpp"
#include "register/field/brain_zones.hpp"
#include "register/field/covers_brain.hpp"
#include "register/field/forward_field.hpp"
#include "register/field/jacobian.hpp"
#include "register/field/measures.hpp"
#include "register/field/nodal_values.hpp"
#include "register/field/resampling_field.hpp"
#include "register/interface/option_table.hpp"
#include "register/warp/cavity_voxels.hpp"
#include "register/warp/point_mover.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/progress/stopwatch.hpp"

namespace brainshift::registration {

namespace {

template <class T>
void check_image(const Image<T>& image, const char* what) {
  if (image.geometry.voxel_count() == 0 || image.voxels.size() != image.geometry.voxel_count()) {
    throw std::invalid_argument(std::string(what) + " has no voxels");
  }
}

void check(const RegisterInput& input, const RegisterOptions& options) {
  check_options(options);
  if (!input.t1.voxels.empty() || !input.labels) {
    check_image(input.t1, "the T1");
  }
  if (input.labels) {
    check_image(*input.labels, "the label map");
    if (!same_geometry(input.labels->geometry, input.t1.geometry)) {
      throw std::invalid_argument("the labels and the T1 must lie on the same grid: the labels have " +
                                  described(input.labels->geometry) + ", the T1 " + described(input.t1.geometry) +
                                  ", or their directions differ; resample the labels to the T1");
    }
  }
  if (!input.solution.displacement.allFinite() || !input.solution.positions.allFinite()) {
    throw std::invalid_argument("the solution holds a number that is not finite; solve again");
  }
  if (!input.landmarks.allFinite()) {
    throw std::invalid_argument("a landmark's position is not finite");
  }
}

/// The images that are warped, without what was taken out.
struct Emptied {
  std::vector<std::size_t> voxels;  ///< of what was taken out
  std::optional<ScalarImage> t1;    ///< these: where something was
  std::optional<LabelMap> labels;
  device::Images images;

  Emptied(const RegisterInput& input, const RegisterOptions& options, const BrainZones& zones)
      : images{input.t1.voxels.empty() ? nullptr : &input.t1, input.labels ? &*input.labels : nullptr} {
    if (input.cavity) {
      voxels = cavity_voxels(zones, *input.cavity, input.t1.geometry, images.labels);
    }
    if (images.t1 != nullptr && !voxels.empty()) {
      images.t1 = &t1.emplace(emptied(input.t1, voxels, static_cast<float>(options.cavity_value)));
    }
    if (images.labels != nullptr && !voxels.empty()) {
      images.labels = &labels.emplace(emptied(*input.labels, voxels, static_cast<std::uint16_t>(options.cavity_label)));
    }
  }
  Emptied(const Emptied&) = delete;
  Emptied& operator=(const Emptied&) = delete;
};

void register_on_processor(const RegisterInput& input, const device::Images& images, const RegisterOptions& options,
                           const BrainZones& zones, const Progress& progress, Registration& result) {
  result.forward = forward_field(input.solution, zones, input.t1.geometry, options.fade, part_of(progress, 0.1, 0.6));
  report(progress, 0.6, "inverting the field");
  InvertedField inverted = resampling_field(result.forward, options.inverse_tolerance);
  result.resampling = std::move(inverted.field);
  result.measures.not_inverted = inverted.not_inverted;
  report(progress, 0.8, "warping the images");
  if (images.t1 != nullptr) {
    result.warped = warp(*images.t1, result.resampling, options.interpolation);
  }
  if (images.labels != nullptr) {
    result.warped_labels = warp(*images.labels, result.resampling);
  }
}

/// Counts the landmarks in what was taken out, of whose error nothing is known.
void look_at_cavity(const BrainZones& zones, Registration& result) {
  for (Eigen::Index p = 0; zones.wall && p < result.preop_landmarks.rows(); ++p) {
    const Eigen::Vector3d x = result.preop_landmarks.row(p);
    if (zones.wall->value(x) < 0 && zones.outside.value(x) <= 0) {
      ++result.measures.cavity_landmarks;
      if (!result.landmark_error.empty()) {
        result.landmark_error[static_cast<std::size_t>(p)] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
}

}  // namespace

Registration register_images(const RegisterInput& input, const RegisterOptions& options, const Progress& progress) {
  check(input, options);
  const Stopwatch stopwatch;
  const ImageGeometry& grid = input.t1.geometry;
  report(progress, 0.0, "distance to the brain's surface");
  const BrainZones zones = brain_zones(input.brain, grid, options.fade, input.cavity ? &input.cavity->wall : nullptr);
  check_covers(input, zones);
  Registration result;
  const Emptied emptied(input, options, zones);
  if (!device::register_if_asked(input, emptied.images, options, zones, progress, result)) {
    register_on_processor(input, emptied.images, options, zones, progress, result);
  }
  const double seconds = stopwatch.seconds();
  result.preop_landmarks = input.landmarks;
  PointMover mover(result.forward);
  result.landmarks = move_points(mover, input.landmarks);
  if (!input.solution.estimated_error.empty()) {
    result.landmark_error = estimated_error_at(input.solution, input.landmarks);
  }
  report(progress, 0.9, "measuring the fields");
  result.jacobian = jacobian(result.forward);
  const std::size_t not_inverted = result.measures.not_inverted;
  result.measures = measure_fields(result.forward, result.resampling, result.jacobian, zones.zone, input.solution);
  result.measures.cavity_voxels = emptied.voxels.size();
  if (!emptied.voxels.empty()) {
    const LabelMap nothing{grid, std::vector<std::uint16_t>(grid.voxel_count(), 0)};
    result.removed = registration::emptied(nothing, emptied.voxels, std::uint16_t{1});
  }
  result.measures.landmarks_outside = mover.moved().outside;
  look_at_cavity(zones, result);
  result.measures.not_inverted = not_inverted;
  result.measures.seconds = seconds;
  report(progress, 1.0, "done");
  return result;
}

}  // namespace brainshift::registration
