// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/register_on_device.hpp"

#include <limits>
#include <string>
#include <utility>

#include "register/device/fields_on_device.hpp"
#include "register/warp/warp.hpp"
#include "solve/device/where_asked.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::registration::device {

namespace {

/// What of this a GPU cannot do; empty: nothing.
std::string why_not_on_gpu(const RegisterInput& input) {
  constexpr std::size_t most_voxels = std::numeric_limits<std::int32_t>::max();
  if (gpu() == nullptr) {
    return solve::device::why_no_gpu();
  }
  if (!input.solution.cut.empty()) {
    return "a GPU does not register a body that is cut";
  }
  if (input.solution.shape.planar) {
    return "a GPU does not register a planar body";
  }
  return input.t1.geometry.voxel_count() > most_voxels ? "the image has more voxels than a GPU counts here" : "";
}

void warp_images(FieldsOnDevice& on, const Images& images, const RegisterOptions& options, Registration& result) {
  const bool linear = options.interpolation == Interpolation::linear;
  if (images.t1 != nullptr && linear) {
    on.take(*images.t1);
    on.warp_image();
  }
  if (images.labels != nullptr) {
    on.take(*images.labels);
    on.warp_labels();
    result.warped_labels = on.warped_labels();
  }
  if (images.t1 != nullptr) {
    result.warped = linear ? on.warped() : warp(*images.t1, result.resampling, options.interpolation);
  }
}

}  // namespace

void register_on(const Backend& backend, const RegisterInput& input, const Images& images,
                 const RegisterOptions& options, const BrainZones& zones, const Progress& progress,
                 Registration& result) {
  const Solution& solution = input.solution;
  const solve::ShapeFunctions shape = shape_functions(solution);
  const Points parameters = solve::parameters_from_displacement(shape, solution.positions, solution.displacement);
  FieldsOnDevice on(backend, solution, parameters, zones, input.t1.geometry, options.fade, options.inverse_tolerance);
  report(progress, 0.3, "displacement at the voxels");
  on.find_forward(shape);
  on.find_resampling();
  result.forward = on.forward();
  InvertedField inverted = on.resampling();
  result.resampling = std::move(inverted.field);
  result.measures.not_inverted = inverted.not_inverted;
  report(progress, 0.8, "warping the images");
  warp_images(on, images, options, result);
}

bool register_if_asked(const RegisterInput& input, const Images& images, const RegisterOptions& options,
                       const BrainZones& zones, const Progress& progress, Registration& result) {
  const auto on_gpu = [&] {
    register_on(*gpu(), input, images, options, zones, progress, result);
    return true;
  };
  return solve::device::where_asked(
             options.device, "register's device", [&] { return why_not_on_gpu(input); }, progress, on_gpu)
      .has_value();
}

}  // namespace brainshift::registration::device
