// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/stress_strain.hpp"

#include <fstream>
#include <iomanip>
#include <numeric>
#include <optional>

#include "segmentation/files/not_written.hpp"
#include "solve/dynamics/relaxation.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/quadrature/integration_points.hpp"

namespace brainshift::solve {

namespace {

/// Of the loaded nodes, which all go one way; absent where they do not: of a body that is pulled at both ends the sum
/// of reactions is no force on a section.
std::optional<Eigen::Vector3d> mean_pull(const Points& prescribed) {
  constexpr double one_way = 0.99;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double loaded = 0, ways = 0;
  for (Eigen::Index a = 0; a < prescribed.rows(); ++a) {
    const Eigen::Vector3d u = prescribed.row(a).array().isNaN().select(0.0, prescribed.row(a));
    sum += u;
    ways += u.norm();
    loaded += u.isZero(0) ? 0 : 1;
  }
  return loaded > 0 && sum.norm() >= one_way * ways ? std::optional<Eigen::Vector3d>(sum / loaded) : std::nullopt;
}

}  // namespace

std::vector<StressStrainRow> stress_strain(const Model& model, Dynamics dynamics,
                                           const std::vector<HistoryRow>& history) {
  const std::optional<Eigen::Vector3d> mean = mean_pull(model.conditions.displacement);
  if (!mean) {
    return {};
  }
  const Eigen::Vector3d pull = *mean, along = pull.normalized();
  const Eigen::VectorXd places = model.cloud.positions * along;
  const double length = places.maxCoeff() - places.minCoeff();
  const std::vector<double> volume =
      integration_points(model.cells, most_points_per_cell(model.cells.kind), nullptr, {}).volume;
  const double section = std::accumulate(volume.begin(), volume.end(), 0.0) / length;  // mm²
  constexpr double pascal = 1e6;                                                       // N/mm² to Pa
  std::vector<StressStrainRow> rows;
  int calm = 0;
  for (const HistoryRow& h : history) {
    calm = calm_rows(calm, h.residual);
    if (dynamics == Dynamics::relaxation && calm < rows_of_rest && &h != &history.back()) {
      continue;
    }
    const double time = dynamics == Dynamics::transient ? h.time : h.time * model.curve.duration();
    rows.push_back({h.time, model.curve.at(time) * pull.norm() / length, pascal * h.reaction.dot(along) / section});
  }
  return rows;
}

void write_stress_strain(const std::filesystem::path& file, const std::vector<StressStrainRow>& rows) {
  std::ofstream out(file);
  out << "time,elongation,stress_Pa\n" << std::setprecision(12);
  for (const StressStrainRow& r : rows) {
    out << r.time << ',' << r.elongation << ',' << r.stress << '\n';
  }
  if (!out.flush()) {
    fail_to_write(file);
  }
}

}  // namespace brainshift::solve
