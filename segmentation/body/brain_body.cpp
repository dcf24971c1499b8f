// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/body/brain_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace brainshift::segmentation {
namespace {

// The brain's size, checked.
double size_across(const Mask& brain) {
  const Eigen::Vector3d& spacing = brain.geometry.spacing;
  std::ostringstream advice;
  advice << "are the image's lengths in metres, centimetres or micrometres? Voxels of " << spacing.x() << " x "
         << spacing.y() << " x " << spacing.z() << " mm are what its header says; correct it";
  const double across = (cropped(brain, 0).geometry.size.cast<double>() * spacing.array()).maxCoeff();
  check_across(across, advice.str());
  return across;
}

// What of the tissue lies outside the body.
void count_loose(const Mask& tissue, BrainBody& body) {
  Mask loose = tissue;
  for (std::size_t i = 0; i < loose.voxels.size(); ++i) {
    loose.voxels[i] = tissue.voxels[i] != 0 && body.mask.voxels[i] == 0 ? 1 : 0;
  }
  body.loose_volume = volume(loose);
  body.loose_pieces = body.loose_volume > 0 ? components(loose).sizes.size() : 0;
}

// Faces of voxels between a body and what is around it; those of them behind which a label lies.
struct Faces {
  std::size_t all = 0;
  std::size_t to_label = 0;
};

Faces count_faces(const LabelMap& labels, std::uint16_t label, const Mask& body) {
  Faces faces;
  const Eigen::Array3i size = body.geometry.size;
  const std::array<Eigen::Array3i, 3> steps = {Eigen::Array3i(1, 0, 0), Eigen::Array3i(0, 1, 0),
                                               Eigen::Array3i(0, 0, 1)};
  for (const Eigen::Array3i& step : steps) {
    for (int k = 0; k + step.z() < size.z(); ++k) {
      for (int j = 0; j + step.y() < size.y(); ++j) {
        for (int i = 0; i + step.x() < size.x(); ++i) {
          const std::size_t here = body.geometry.offset(i, j, k);
          const std::size_t next = body.geometry.offset(i + step.x(), j + step.y(), k + step.z());
          if (body.voxels[here] != body.voxels[next]) {
            ++faces.all;
            faces.to_label += labels.voxels[body.voxels[here] != 0 ? next : here] == label ? 1 : 0;
          }
        }
      }
    }
  }
  return faces;
}

// The part of an open space that hangs together with the brain.
Mask reached(Mask open, const Mask& brain) {
  const Components parts = components(open);
  const auto seed =
      static_cast<std::size_t>(std::find(brain.voxels.begin(), brain.voxels.end(), 1) - brain.voxels.begin());
  for (std::size_t i = 0; i < open.voxels.size(); ++i) {
    open.voxels[i] = parts.number[i] == parts.number[seed] && parts.number[i] != 0 ? 1 : 0;
  }
  return open;
}

// Of the holes in tissue, before it is closed, that are worth saying, mm³: a head has many of a few voxels, and closing
// seals fluid between folds.
double large_holes(const Mask& tissue) {
  constexpr double worth_saying = 1000;  // mm³
  const double voxel = tissue.geometry.voxel_volume();
  Mask holes = holes_filled(tissue);
  for (std::size_t i = 0; i < holes.voxels.size(); ++i) {
    holes.voxels[i] = holes.voxels[i] != 0 && tissue.voxels[i] == 0 ? 1 : 0;
  }
  if (volume(holes) < worth_saying) {
    return 0;
  }
  double large = 0;
  for (const std::size_t size : components(holes).sizes) {
    const double hole = static_cast<double>(size) * voxel;
    large += hole >= worth_saying ? hole : 0;
  }
  return large;
}

// What can be reached from the brain without crossing the skull.
Mask within(const LabelMap& labels, std::uint16_t skull, const Mask& brain) {
  return reached(complement(mask_of(labels, std::array{skull})), brain);
}

// Of a voxel's face across the axis, mm².
double face_area(const ImageGeometry& geometry, int axis) {
  return geometry.voxel_volume() / geometry.spacing[axis];
}

// Also of places outside the image.
bool is_inside(const Mask& body, const Eigen::Array3i& voxel) {
  return (voxel >= 0).all() && (voxel < body.geometry.size).all() && body.at(voxel.x(), voxel.y(), voxel.z()) != 0;
}

// Of all faces of voxels between the body and what is around it, the image's outside too, mm².
double surface_area(const Mask& body) {
  double area = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Array3i step = Eigen::Vector3i::Unit(axis).array();
    for_each_inside(body, [&](const Eigen::Array3i& voxel) {
      area += face_area(body.geometry, axis) *
              ((is_inside(body, voxel - step) ? 0 : 1) + (is_inside(body, voxel + step) ? 0 : 1));
    });
  }
  return area;
}

// A face of the image's border.
struct Border {
  int axis;
  bool upper;
};

// Whether another grid goes on beyond the border there, by one of its voxels at least.
bool goes_on(const ImageGeometry& beyond, const ImageGeometry& grid, const Border& border,
             const Eigen::Array3i& voxel) {
  Eigen::Vector3d index = voxel.cast<double>().matrix();
  const double step = 0.5 + 0.5 * beyond.spacing.minCoeff() / grid.spacing[border.axis];
  index[border.axis] = border.upper ? grid.size[border.axis] - 1 + step : -step;
  const Eigen::Array3d there = beyond.to_index(grid.to_world(index)).array();
  return (there >= -0.5).all() && (there <= beyond.size.cast<double>() - 0.5).all();
}

// The body's section so many voxels within the border, mm²; of it what lies where the other grid, if any, goes on.
double section_area(const Mask& body, const Border& border, int within, const ImageGeometry* beyond) {
  const ImageGeometry& grid = body.geometry;
  const int axis = border.axis, first = (axis + 1) % 3, second = (axis + 2) % 3;
  Eigen::Array3i voxel;
  voxel[axis] = border.upper ? grid.size[axis] - 1 - within : within;
  double area = 0;
  for (voxel[second] = 0; voxel[second] < grid.size[second]; ++voxel[second]) {
    for (voxel[first] = 0; voxel[first] < grid.size[first]; ++voxel[first]) {
      const bool counts = is_inside(body, voxel) && (beyond == nullptr || goes_on(*beyond, grid, border, voxel));
      area += counts ? face_area(grid, axis) : 0;
    }
  }
  return area;
}

// A field of view cuts off a stem or a vertex; a mask that lies on more of the border is of something else, or inside
// out.
BorderCut checked_cut(const Mask& body) {
  constexpr double largest_share = 0.2;
  const BorderCut cut = border_cut(body);
  if (const double share = cut.area > 0 ? cut.area / surface_area(body) : 0; share > largest_share) {
    std::ostringstream text;
    text << "the image's border cuts the brain off over " << std::lround(100 * share)
         << " % of its surface; is the mask or the label inside out? If not, take an image that shows the brain whole";
    throw std::invalid_argument(text.str());
  }
  return cut;
}

}  // namespace

void check_across(double across, const std::string& advice) {
  // Lengths in metres make a brain of a fifth of a millimetre, and everything after this would go on in earnest.
  constexpr double smallest = 20, largest = 500;  // mm
  if (!(across >= smallest && across <= largest)) {
    std::ostringstream text;
    text << "the brain is " << across << " mm across, where " << smallest << " to " << largest
         << " mm are expected: " << advice;
    throw std::invalid_argument(text.str());
  }
}

void check_edge_length(double edge_length, double across) {
  // To collapse a fine contour to longer edges takes minutes, then hours, and what is left is not the brain's shape.
  constexpr double largest_share = 1.0 / 6;
  const double longest = std::max(SegmentOptions{}.edge_length, std::floor(10 * largest_share * across) / 10);
  if (edge_length > longest) {
    std::ostringstream text;
    text << "edge_length is '" << edge_length << "', but must be at most " << longest << " (mm) for a brain " << across
         << " mm across: longer edges do not show its shape";
    throw std::invalid_argument(text.str());
  }
}

BorderCut border_cut(const Mask& body, const ImageGeometry* beyond) {
  // A brain that ends at the border has a small face there, and a much larger section one voxel further in.
  constexpr double large = 200, large_share = 0.01, still_growing = 0.6;  // mm²; of the surface; of the next section
  double least = large;
  BorderCut cut;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const double face = section_area(body, {axis, upper}, 0, beyond);
      if (face > 0 && cut.area == 0) {
        least = std::min(large, large_share * surface_area(body));
      }
      cut.area += face;
      cut.off = cut.off || (face > least && face > still_growing * section_area(body, {axis, upper}, 1, beyond));
    }
  }
  return cut;
}

std::string cut_sentence(const BorderCut& cut, const std::string& border) {
  if (cut.area == 0) {
    return {};
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  if (cut.off) {
    text << "warning: " << border << " cuts the brain off over " << cut.area / 100
         << " cm2; the cut counts as its surface, and as skull where none is given. What moves near it is not to be "
            "trusted";
  } else {
    text << border << " touches the brain over " << cut.area / 100 << " cm2, as where an image is cropped to the brain";
  }
  return text.str();
}

BrainBody brain_body(const Mask& tissue, double closing) {
  if (count(tissue) == 0) {
    throw std::invalid_argument("no voxel is brain: the mask, or what the brain's labels name, is empty");
  }
  BrainBody body;
  body.mask = holes_filled(largest_component(closing > 0 ? closed(tissue, closing) : tissue));
  body.hole_volume = large_holes(tissue);
  body.across = size_across(body.mask);
  body.cut = checked_cut(body.mask);
  count_loose(tissue, body);
  return body;
}

bool encloses(const LabelMap& labels, std::uint16_t skull, const Mask& brain) {
  return !touches_border(within(labels, skull, brain));
}

Mask skull_cavity(const LabelMap& labels, std::uint16_t skull, const Mask& brain) {
  if (!has_label(labels, skull)) {
    throw std::invalid_argument("label " + std::to_string(skull) +
                                " is named but no voxel of the label map carries it; correct the label or the image");
  }
  Mask open = within(labels, skull, brain);
  if (touches_border(open)) {
    throw std::invalid_argument("the skull's label " + std::to_string(skull) +
                                " does not enclose the brain; close its gaps, or leave the skull's label out");
  }
  return open;
}

Mask fluid_space(const LabelMap& labels, std::uint16_t fluid, const Mask& brain, double reach) {
  const Faces faces = count_faces(labels, fluid, brain);
  if (2 * faces.to_label < faces.all) {
    return {};
  }
  Mask space = grown(brain, reach);
  for (std::size_t i = 0; i < space.voxels.size(); ++i) {
    space.voxels[i] = brain.voxels[i] != 0 || (space.voxels[i] != 0 && labels.voxels[i] == fluid) ? 1 : 0;
  }
  return holes_filled(largest_component(closed(space, reach / 2)));
}

Mask bounded_space(const LabelMap& labels, std::uint16_t outer, const Mask& brain, double reach) {
  constexpr double enough = 0.8;
  Mask space = grown(brain, reach);
  for (std::size_t i = 0; i < space.voxels.size(); ++i) {
    space.voxels[i] = brain.voxels[i] != 0 || (space.voxels[i] != 0 && labels.voxels[i] != outer) ? 1 : 0;
  }
  space = holes_filled(reached(std::move(space), brain));
  const Faces faces = count_faces(labels, outer, space);
  const bool bounded = static_cast<double>(faces.to_label) >= enough * static_cast<double>(faces.all);
  return bounded ? holes_filled(largest_component(closed(space, reach / 2))) : Mask{};
}

}  // namespace brainshift::segmentation
