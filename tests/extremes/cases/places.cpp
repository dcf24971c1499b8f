// SPDX-License-Identifier: GPL-3.0-or-later
//
// The brain where nobody expects it: ten metres from the origin, and in metres instead of millimetres.

#include "segmentation/segment.hpp"
#include "tests/extremes/brain.hpp"

namespace brainshift::extremes::places_cases {

namespace {

constexpr double sink = 8;  // mm

/// Lengths in other units than they should be.
solve::Model scaled(solve::Model model, double factor) {
  model.cloud.positions *= factor;
  model.conditions.displacement *= factor;
  for (double& spacing : model.cloud.spacing) {
    spacing *= factor;
  }
  model.cells.vertices *= factor;
  for (InsideOctants& part : model.cells.cut_parts) {
    for (int i = 0; i < 8; ++i) {
      part.volume[i] *= factor * factor * factor;
      for (double& x : part.centroid[i]) {
        x *= factor;
      }
    }
  }
  return model;
}

solve::Model moved(solve::Model model, const Eigen::RowVector3d& by) {
  model.cloud.positions.rowwise() += by;
  model.cells.vertices.rowwise() += by;
  for (InsideOctants& part : model.cells.cut_parts) {
    for (auto& centroid : part.centroid) {
      Eigen::Map<Eigen::RowVector3d>(centroid) += by;
    }
  }
  return model;
}

/// A ball of a brain as an image whose header gives metres for millimetres.
Row image_in_metres() {
  segmentation::SegmentInput input;
  LabelMap labels;
  labels.geometry.size = {60, 60, 60};
  labels.geometry.spacing = Eigen::Vector3d::Constant(0.003);
  labels.voxels.resize(labels.geometry.voxel_count());
  for (int k = 0; k < 60; ++k) {
    for (int j = 0; j < 60; ++j) {
      for (int i = 0; i < 60; ++i) {
        labels.at(i, j, k) = (Eigen::Vector3d(i, j, k).array() - 29.5).matrix().norm() < 25 ? 1 : 0;
      }
    }
  }
  input.labels = labels;
  segmentation::SegmentOptions options;
  options.brain_labels = {1};
  Row row{"a label map in metres, through segment", "exit 2 with a sentence", "accepted", "", false, 0};
  try {
    segmentation::segment(input, options);
  } catch (const std::invalid_argument& refusal) {
    row.did = "exit 2: " + std::string(refusal.what());
    row.holds = row.did.find("in metres") != std::string::npos;
  }
  return row;
}

}  // namespace

std::vector<Row> far_away(bool small) {
  const solve::Model here = brain_model(small ? 600 : 3000, sink);
  const Ending near = run(here, {}), far = run(moved(here, {6000, -5000, 6245}), {});
  return {judge("a brain ten metres from the origin", Must::answer, far,
                {{"displacement off by",
                  largest_difference(far.result.solution.displacement, near.result.solution.displacement), 1e-6, "mm"}},
                "the same at the origin, " + std::to_string(here.cloud.size()) + " nodes")};
}

std::vector<Row> metres(bool small) {
  const solve::Model right = brain_model(small ? 600 : 3000, sink);
  const Ending millimetres = run(right, {}), thousandth = run(scaled(right, 1e-3), {});
  const Points wanted = 1e-3 * millimetres.result.solution.displacement;
  const double off = largest_difference(thousandth.result.solution.displacement, wanted);
  return {
      judge("a brain in metres, through solve, the same options", Must::answer, thousandth,
            {{"displacement off by", 100 * off / (1e-3 * sink), 2, "% of the imposed"}}, "the answer in millimetres"),
      image_in_metres()};
}

}  // namespace brainshift::extremes::places_cases
