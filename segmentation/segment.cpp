// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/segment.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <sstream>
#include <stdexcept>

#include "segmentation/image/mask.hpp"
#include "segmentation/interface/check_input.hpp"
#include "segmentation/surface/checked_surface.hpp"
#include "segmentation/surface/extract.hpp"
#include "segmentation/tissue/classify.hpp"

namespace brainshift::segmentation {
namespace {

// Lengths in metres make a brain of a fifth of a millimetre, and everything after this would go on in earnest.
void check_across(double across, const std::string& advice) {
  constexpr double smallest = 20, largest = 500;  // mm
  if (!(across >= smallest && across <= largest)) {
    std::ostringstream text;
    text << "the brain is " << across << " mm across, where " << smallest << " to " << largest
         << " mm are expected: " << advice;
    throw std::invalid_argument(text.str());
  }
}

void check_size(const Mask& brain) {
  const Eigen::Vector3d& spacing = brain.geometry.spacing;
  Eigen::Array3i low = brain.geometry.size, high = Eigen::Array3i::Zero();
  for (int k = 0; k < brain.geometry.size.z(); ++k) {
    for (int j = 0; j < brain.geometry.size.y(); ++j) {
      for (int i = 0; i < brain.geometry.size.x(); ++i) {
        if (brain.at(i, j, k) != 0) {
          low = low.min(Eigen::Array3i(i, j, k));
          high = high.max(Eigen::Array3i(i, j, k) + 1);
        }
      }
    }
  }
  std::ostringstream advice;
  advice << "are the image's lengths in metres, centimetres or micrometres? Voxels of " << spacing.x() << " x "
         << spacing.y() << " x " << spacing.z() << " mm are what its header says; correct it";
  check_across(((high - low).cast<double>() * spacing.array()).maxCoeff(), advice.str());
}

// The brain as one body. Throws when there is none, or when the image cuts it off.
Mask brain_body(const Mask& tissue) {
  if (count(tissue) == 0) {
    throw std::invalid_argument("no voxel is brain: the mask, or what the brain's labels name, is empty");
  }
  Mask body = holes_filled(largest_component(tissue));
  check_size(body);
  if (touches_border(body)) {
    throw std::invalid_argument(
        "the brain touches the image's border, so its surface cannot be closed; pad the images by a few voxels of 0");
  }
  return body;
}

void add_tumour(LabelMap& labels, const LabelMap& tumour_mask) {
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    if (tumour_mask.voxels[i] != 0) {
      labels.voxels[i] = default_label::tumour;
    }
  }
}

std::vector<std::int16_t> present_labels(const LabelMap& labels, const std::vector<std::int16_t>& wanted) {
  std::vector<std::int16_t> present;
  for (const std::int16_t label : wanted) {
    if (std::find(labels.voxels.begin(), labels.voxels.end(), label) != labels.voxels.end()) {
      present.push_back(label);
    }
  }
  return present;
}

void check_present(const LabelMap& labels, std::int16_t label) {
  if (std::find(labels.voxels.begin(), labels.voxels.end(), label) == labels.voxels.end()) {
    throw std::invalid_argument("label " + std::to_string(label) +
                                " is named but no voxel of the label map carries it; correct the label or the image");
  }
}

// What lies within the skull's label: its own inner surface bounds it.
Mask skull_cavity(const LabelMap& labels, std::int16_t skull, const Mask& brain) {
  check_present(labels, skull);
  Mask open = mask_of(labels, std::array{skull});
  for (std::uint8_t& voxel : open.voxels) {
    voxel = voxel == 0 ? 1 : 0;
  }
  const Components parts = components(open);
  const auto seed =
      static_cast<std::size_t>(std::find(brain.voxels.begin(), brain.voxels.end(), 1) - brain.voxels.begin());
  for (std::size_t i = 0; i < open.voxels.size(); ++i) {
    open.voxels[i] = parts.number[i] == parts.number[seed] && parts.number[i] != 0 ? 1 : 0;
  }
  if (touches_border(open)) {
    throw std::invalid_argument("the skull's label " + std::to_string(skull) +
                                " does not enclose the brain; close its gaps, or leave the skull's label out");
  }
  return open;
}

struct Body {
  std::string name;
  Mask mask;
};

// Each body on its own, side by side; a fault in one of them is thrown when all have ended.
std::vector<MeasuredSurface> extract_all(const std::vector<Body>& bodies, double edge_length) {
  std::vector<MeasuredSurface> surfaces(bodies.size());
  std::vector<std::exception_ptr> faults(bodies.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    try {
      surfaces[i] = extract_surface(bodies[i].mask, edge_length, bodies[i].name);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  }
  for (const auto& fault : faults) {
    if (fault) {
      std::rethrow_exception(fault);
    }
  }
  return surfaces;
}

std::vector<Body> bodies_of(const LabelMap& labels, const Mask& brain, const std::vector<std::int16_t>& tissues,
                            const SegmentOptions& options) {
  std::vector<Body> bodies = {{"brain", brain}};
  for (const std::int16_t label : tissues) {
    bodies.push_back({"tissue_" + std::to_string(label), mask_of(labels, std::array{label})});
  }
  if (options.skull_label) {
    bodies.push_back({"skull", skull_cavity(labels, *options.skull_label, brain)});
  }
  return bodies;
}

void make_surfaces(Segmentation& result, const Mask& brain, const std::vector<std::int16_t>& tissues,
                   const SegmentOptions& options) {
  const auto bodies = bodies_of(*result.labels, brain, tissues, options);
  auto surfaces = extract_all(bodies, options.edge_length);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    result.measures[bodies[i].name] = surfaces[i].measures;
  }
  result.brain = surfaces.front().surface;
  result.skull = options.skull_label ? surfaces.back().surface : result.brain;
  result.measures["skull"] = options.skull_label ? surfaces.back().measures : surfaces.front().measures;
  for (std::size_t t = 0; t < tissues.size(); ++t) {
    result.tissues[tissues[t]] = std::move(surfaces[t + 1].surface);
  }
}

Segmentation segment_labels(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  Segmentation result;
  result.labels = *input.labels;
  if (input.tumour_mask) {
    add_tumour(*result.labels, *input.tumour_mask);
  }
  for (const std::int16_t label : options.brain_labels) {
    check_present(*result.labels, label);
  }
  const Mask brain = brain_body(mask_of(*result.labels, options.brain_labels));
  report(progress, 0.1, "surfaces");
  make_surfaces(result, brain, options.brain_labels, options);
  return result;
}

Segmentation segment_t1(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  LabelMap mask = *input.brain_mask;
  if (input.tumour_mask) {
    add_tumour(mask, *input.tumour_mask);
  }
  const Mask brain = brain_body(mask_of(mask));
  report(progress, 0.1, "tissue classes");
  Classification classified = classify(*input.t1, brain, options);
  Segmentation result;
  result.labels = std::move(classified.labels);
  result.memberships = std::move(classified.memberships);
  if (input.tumour_mask) {
    add_tumour(*result.labels, *input.tumour_mask);
  }
  report(progress, 0.3, "surfaces");
  const std::vector<std::int16_t> classes = {default_label::parenchyma, default_label::ventricles,
                                             default_label::tumour};
  make_surfaces(result, brain, present_labels(*result.labels, classes), options);
  return result;
}

Segmentation segment_surface(const SegmentInput& input, const SegmentOptions& options) {
  if (input.surface->triangles.rows() > 0) {
    check_across(extent(*input.surface),
                 "is the surface in metres or micrometres, or has it a stray vertex? Scale it, or remove that vertex");
  }
  CheckedSurface checked = checked_surface(*input.surface, options.edge_length);
  Segmentation result;
  result.brain = std::move(checked.surface);
  result.skull = result.brain;
  result.measures["brain"] = checked.measures;
  result.measures["skull"] = checked.measures;
  return result;
}

}  // namespace

Segmentation segment(const SegmentInput& input, const SegmentOptions& options, const Progress& progress) {
  check_input(input, options);
  report(progress, 0.0, "checking the input");
  Segmentation result = input.surface  ? segment_surface(input, options)
                        : input.labels ? segment_labels(input, options, progress)
                                       : segment_t1(input, options, progress);
  report(progress, 1.0, "done");
  return result;
}

}  // namespace brainshift::segmentation
