// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/run/outliers.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "solve/load/noisy_load.hpp"
#include "solve/measured/inner_rows.hpp"
#include "solve/measured/surprise.hpp"
#include "solve/run/measured.hpp"
#include "solve/run/measured_points.hpp"

namespace brainshift::solve {

std::vector<Outlier> outliers(const ThinnedBody& thinned, const Conditions& conditions) {
  if (conditions.measured->cortex.rows() == 0) {
    return {};
  }
  const MeasuredPoints measured(thinned, conditions);
  // Without a smooth motion: one alike over short lengths takes a wrong point for one of its own.
  const Response response = measured.response(inner_rows(measured.shape, measured.positions), measured.positions);
  const Trust trust = robust_trust(response, measured.displacement, measured.sigma, conditions.measured->weight);
  std::vector<Outlier> found;
  for (Eigen::Index i = 0; i < trust.surprise.size(); ++i) {
    if (trust.surprise[i] > surprising) {
      found.push_back({measured.positions.row(i), trust.surprise[i]});
    }
  }
  std::ranges::sort(found, std::greater(), &Outlier::deviations);
  return found;
}

LessenedPoints lessen_outliers(Model& model, const SolveOptions& options, const OpeningOptions& opening) {
  check_measured(model, options);
  if (model.conditions.measured->cortex.rows() == 0) {
    throw std::invalid_argument(
        "robust weights need points on the cortex: of points inside alone, a wrong one cannot be told from one that is "
        "nearer than the others to what moves; leave robust out");
  }
  const ThinnedBody thinned = thinned_body(model, options.shape);
  const Seen seen(*model.conditions.measured);
  const double weight = model.conditions.measured->weight;
  const Response response = linear_response(thinned.stiff, subset(model.conditions, thinned.node),
                                            inner_rows(thinned.shape(), seen.positions));
  const Eigen::VectorXd trust = robust_trust(response, seen.displacement, seen.sigma, weight).weight;
  std::vector<Eigen::Index> kept, lessened;
  for (Eigen::Index i = 0; i < trust.size(); ++i) {
    if (trust[i] > least_trust) {
      kept.push_back(i);
    }
    if (trust[i] < 0.5) {
      lessened.push_back(i);
    }
  }
  const Points raised = seen.sigma.array().colwise() / trust.array().sqrt();
  Conditions weighed = noisy_conditions(
      model.cloud, {seen.positions(kept, Eigen::all), seen.displacement(kept, Eigen::all), raised(kept, Eigen::all)},
      opening);
  weighed.force = std::move(model.conditions.force);
  weighed.at_nodes_alone = model.conditions.at_nodes_alone;
  weighed.measured->weight = weight;
  model.conditions = std::move(weighed);
  return {seen.positions(lessened, Eigen::all), trust.size()};
}

}  // namespace brainshift::solve
