// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipelines/report/colour_scale.hpp"
#include "pipelines/report/run_data.hpp"
#include "pipelines/report/slice_plane.hpp"

namespace brainshift::pipelines {

struct Figure {
  std::string name;  ///< of the file, without its ending, and the id of the picture's element
  int width;         ///< pixels
  int height;        ///< pixels
  std::string svg;
};

/// How far the planes lie under the opening's centre, mm: at the surface itself a plane would only graze the brain.
constexpr double depth_of_planes = 12;

/// A plane and what it cuts.
struct Slice {
  SlicePlane plane;
  std::vector<Segment> outline;     ///< of the brain before, pixels
  std::vector<std::size_t> inside;  ///< pixels whose centres lie in tissue of it that is not taken out
  std::vector<float> t1;            ///< one value a pixel; none where there is no T1
};

/// What all pictures of a run share.
struct View {
  Points opening;                     ///< loaded nodes, mm; no row where none or all around are loaded
  Eigen::Vector3d opening_centre;     ///< on the surface; the brain's centre without an opening
  Eigen::Vector3d inward;             ///< unit vector from the opening into the brain
  double opening_reach;               ///< a place nearer than this to a loaded node is in the opening, mm
  Eigen::Vector3d focus;              ///< under the opening's centre
  std::array<Slice, 3> slices;        ///< through the focus
  double darkest = 0;                 ///< shown black
  double brightest = 1;               ///< shown white
  Surface deformed;                   ///< the brain's surface, intraop
  std::vector<double> surface_shift;  ///< |u| at its vertices, mm
  ColourScale shift;                  ///< colours of |u|
};

/// The run must have a brain surface and a solution.
View make_view(const RunData& run);

/// The displacement at places in the brain before, mm: the register stage's field or, where there is none, between the
/// nodes of the solution.
Points displacement_at(const RunData& run, const Points& places);

/// Before, after and difference in a plane; the run must have a T1 and a warped image.
std::vector<Figure> comparison_figures(const RunData& run, const View& view, const Slice& slice);

/// The labels as the stages understood them, as colours over the T1 where there is one, and what closing took in; the
/// run must have labels.
Figure labels_figure(const RunData& run, const View& view, const Slice& slice);

/// The displacement in a plane as colours and arrows, over the T1 where there is one.
Figure displacement_figure(const RunData& run, const View& view, const Slice& slice);

/// How far the displacement in a plane may be off, as colours over the T1 where there is one; the run must have a
/// deviation at its nodes.
Figure uncertainty_figure(const RunData& run, const View& view, const Slice& slice);

/// How many times too long the arrows are drawn.
double arrow_factor(const View& view);

}  // namespace brainshift::pipelines
