// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/register_warnings.hpp"

namespace brainshift::pipelines {

Warnings warnings_of(const registration::RegisterMeasures& measures) {
  Warnings warnings;
  if (measures.folded_voxels > 0) {
    warnings.push_back("the field folds in " + std::to_string(measures.folded_voxels) + " voxels (Jacobian down to " +
                       with_digits(measures.field_jacobian_min) +
                       "), where the warped images mean nothing; look at the load, or solve with more nodes; "
                       "beside falx, tentorium and cuts a field cannot jump");
  }
  constexpr double usual_fit = 0.8;  // mm; of voxels up to 5 mm without cuts and septa it is 0.15 to 0.77
  if (measures.fit_error > usual_fit) {
    warnings.push_back("the field departs from the solution by up to " + with_digits(measures.fit_error) +
                       " mm at a node, as its voxels are coarse or it cannot jump at a cut, falx or tentorium: images, "
                       "landmarks and tracts there are off by as much; solution.vtu is not");
  }
  constexpr double many = 2e-4;  // of the brain's voxels; where nodes fill it none
  if (static_cast<double>(measures.without_nodes) > many * static_cast<double>(measures.brain_voxels)) {
    warnings.push_back("about " + std::to_string(measures.without_nodes) +
                       " voxels of the brain lie over 1.5 spacings from every node, where the field is made up from "
                       "afar; if tissue was taken out there, give register its wall (--wall, --resection)");
  }
  if (measures.landmarks_outside > 0) {
    warnings.push_back(std::to_string(measures.landmarks_outside) +
                       " landmarks lie outside the image and stay where they were; are they in its frame?");
  }
  if (measures.cavity_landmarks > 0) {
    warnings.push_back(std::to_string(measures.cavity_landmarks) +
                       (measures.cavity_landmarks == 1 ? " landmark lies" : " landmarks lie") +
                       " in what was taken out, where a displacement means nothing");
  }
  return warnings;
}

}  // namespace brainshift::pipelines
