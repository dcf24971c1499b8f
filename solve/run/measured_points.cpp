// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/measured_points.hpp"

#include <algorithm>

#include "solve/load/openings.hpp"
#include "solve/load/spread_out.hpp"
#include "solve/measured/gaussian.hpp"

namespace brainshift::solve {

Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 3);
  both << above, below;
  return both;
}

Points within_sight(Points places, const NodeCloud& cloud) {
  constexpr double sight = 20, in_spacings = 2;  // mm, and of the nearest node
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    Eigen::Index nearest = 0;
    const double off = (cloud.positions.rowwise() - places.row(i)).rowwise().norm().minCoeff(&nearest);
    if (off > std::max(sight, in_spacings * cloud.spacing[static_cast<std::size_t>(nearest)])) {
      places.row(i) = cloud.positions.row(nearest);
    }
  }
  return places;
}

MeasuredPoints::MeasuredPoints(const ThinnedBody& body, const Conditions& all)
    : thinned(body), conditions(subset(all, body.node)), shape(body.shape()) {
  const Seen seen(*all.measured);
  row = spread_out(seen.positions, seen.positions.rows());
  positions = seen.positions(row, Eigen::all);
  displacement = seen.displacement(row, Eigen::all);
  sigma = seen.sigma(row, Eigen::all);
}

Response MeasuredPoints::response(const ShapeRows& rows, const Points& places) const {
  Response response = linear_response(thinned.stiff, conditions, rows);
  if (conditions.measured->registration_unknown) {
    response.rigid = rigid_motions(places, positions);
  }
  return response;
}

Response MeasuredPoints::response_and_motion(const ShapeRows& rows, const Points& places) const {
  Response response = this->response(rows, places);
  const Measurement& m = *conditions.measured;
  const bool all_rigid_is_registration = m.registration_unknown && response.free;
  if (all_rigid_is_registration || m.cortex.rows() == 0 || (m.weight > 0 && !m.registration_unknown)) {
    return response;
  }
  std::vector<Eigen::Index> on_cortex;  // rows
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] < m.cortex.rows()) {
      on_cortex.push_back(static_cast<Eigen::Index>(i));
    }
  }
  response.shortest = usual_distance(positions(on_cortex, Eigen::all));
  if (response.shortest == 0 && !m.registration_unknown) {
    return response;
  }
  const StiffBody& body = thinned.stiff;
  const ShapeRows at_nodes = shape.evaluate(body.cloud.positions, false);
  const Carried carried = carried_motion(body, conditions, at_nodes, rows);
  const auto own = static_cast<Eigen::Index>(on_cortex.size());
  response.sites = stacked(positions(on_cortex, Eigen::all), body.cloud.positions(carried.nodes, Eigen::all));
  if (openings({positions(on_cortex, Eigen::all), displacement(on_cortex, Eigen::all)}).size() == 1) {
    response.fading = fading_to_rim(response.sites);  // one ellipse is no shape of two
  }
  response.carry = Eigen::MatrixXd::Zero(response.compliance.rows(), 3 * response.sites.rows());
  response.carry.rightCols(carried.motion.cols()) = carried.motion;
  for (Eigen::Index i = 0; i < own; ++i) {
    auto its_rows = response.carry.middleRows<3>(3 * on_cortex[static_cast<std::size_t>(i)]);
    its_rows.setZero();
    its_rows.middleCols<3>(3 * i).setIdentity();
  }
  return response;
}

}  // namespace brainshift::solve
