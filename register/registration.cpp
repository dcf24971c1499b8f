// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/registration.hpp"

#include <stdexcept>

#include "register/field/brain_zones.hpp"
#include "register/field/forward_field.hpp"
#include "register/field/jacobian.hpp"
#include "register/field/measures.hpp"
#include "register/field/resampling_field.hpp"
#include "register/interface/option_table.hpp"
#include "register/warp/cavity_voxels.hpp"
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

void warp_images(const RegisterInput& input, const RegisterOptions& options, const BrainZones& zones,
                 Registration& result) {
  const LabelMap* labels = input.labels ? &*input.labels : nullptr;
  std::vector<std::size_t> empty;
  if (input.cavity) {
    empty = cavity_voxels(zones, *input.cavity, input.t1.geometry, labels);
    result.measures.cavity_voxels = empty.size();
  }
  if (!input.t1.voxels.empty()) {
    result.warped = empty.empty() ? warp(input.t1, result.resampling, options.interpolation)
                                  : warp(emptied(input.t1, empty, static_cast<float>(options.cavity_value)),
                                         result.resampling, options.interpolation);
  }
  if (labels != nullptr) {
    result.warped_labels =
        empty.empty()
            ? warp(*labels, result.resampling)
            : warp(emptied(*labels, empty, static_cast<std::uint16_t>(options.cavity_label)), result.resampling);
  }
}

std::size_t landmarks_in_cavity(const BrainZones& zones, const Points& landmarks) {
  std::size_t count = 0;
  for (Eigen::Index p = 0; zones.wall && p < landmarks.rows(); ++p) {
    const Eigen::Vector3d x = landmarks.row(p);
    count += zones.wall->value(x) < 0 && zones.outside.value(x) <= 0 ? 1 : 0;
  }
  return count;
}

Progress part_of(const Progress& progress, double begin, double end) {
  if (!progress) {
    return {};
  }
  return [=](double fraction, std::string_view what) { progress(begin + (end - begin) * fraction, what); };
}

}  // namespace

Registration register_images(const RegisterInput& input, const RegisterOptions& options, const Progress& progress) {
  check(input, options);
  const Stopwatch stopwatch;
  const ImageGeometry& grid = input.t1.geometry;
  report(progress, 0.0, "distance to the brain's surface");
  const BrainZones zones = brain_zones(input.brain, grid, options.fade, input.cavity ? &input.cavity->wall : nullptr);
  Registration result;
  result.forward = forward_field(input.solution, zones, grid, options.fade, part_of(progress, 0.1, 0.6));
  report(progress, 0.6, "inverting the field");
  InvertedField inverted = resampling_field(result.forward, options.inverse_tolerance);
  result.resampling = std::move(inverted.field);
  report(progress, 0.8, "warping the images");
  warp_images(input, options, zones, result);
  const double seconds = stopwatch.seconds();
  result.preop_landmarks = input.landmarks;
  result.landmarks = move_points(result.forward, input.landmarks);
  report(progress, 0.9, "measuring the fields");
  result.jacobian = jacobian(result.forward);
  const std::size_t cavity_voxels = result.measures.cavity_voxels;
  result.measures = measure_fields(result.forward, result.resampling, result.jacobian, zones.zone, input.solution);
  result.measures.cavity_voxels = cavity_voxels;
  result.measures.cavity_landmarks = landmarks_in_cavity(zones, input.landmarks);
  result.measures.not_inverted = inverted.not_inverted;
  result.measures.seconds = seconds;
  report(progress, 1.0, "done");
  return result;
}

}  // namespace brainshift::registration
