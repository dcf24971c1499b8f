// SPDX-License-Identifier: GPL-3.0-or-later
//
// No load, hardly any, far too much; a turn by half a circle; nothing to do.
#include <cmath>
#include <sstream>

#include "tests/extremes/brain.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/models.hpp"

namespace brainshift::extremes::loads_cases {

namespace {

Row no_load(const solve::Model& model, const std::string& what, const solve::SolveOptions& options) {
  const Ending ending = run(model, options);
  const auto& m = ending.result.measures;
  const Points& u = ending.result.solution.displacement;
  return judge(
      what, Must::answer, ending,
      {{"largest displacement", u.rows() > 0 ? u.cwiseAbs().maxCoeff() : std::nan(""), 0, "mm"},
       {"largest reaction", u.rows() > 0 ? ending.result.solution.reaction_force.cwiseAbs().maxCoeff() : 0, 0, "N"},
       {"steps", static_cast<double>(m.steps), 600, ""}},
      "rest");
}

/// The answer of a tiny load against that of one a thousand times larger, both too small for large strains to show.
Row scaling(std::size_t nodes) {
  constexpr double tiny = 1e-6, larger = 1e-3;  // mm
  const Ending one = run(brain_model(nodes, tiny), {}), other = run(brain_model(nodes, larger), {});
  const Points wanted = tiny / larger * other.result.solution.displacement;
  std::ostringstream name;
  name << "a load of " << larger << " mm and one of " << tiny << " mm";
  return judge(name.str(), Must::answer, one,
               {{"not in proportion by", 100 * largest_difference(one.result.solution.displacement, wanted) / tiny, 1,
                 "% of the load"}},
               "each other");
}

/// 60 mm, twice: run through the load's curve four times as slowly the answer must be the same, unless the run says
/// itself that its tissue is pressed so far that it creases.
Row far_too_much(std::size_t nodes) {
  solve::SolveOptions options, slowly;
  slowly.load_steps = 4 * options.load_steps;
  const solve::Model model = brain_model(nodes, 60);
  const Ending ending = run(model, options);
  double off = std::nan("");
  if (ending.exit == 0) {
    const Ending other = run(model, slowly);
    off = largest_difference(ending.result.solution.displacement, other.result.solution.displacement);
  }
  const bool said = ending.result.measures.compressed_share > 0.01;
  return judge("the top of a brain pressed by 60 mm", Must::answer_or_stop, ending,
               {{"displacement off by", 100 * off / 60, said ? 30.0 : 1.0, "% of the imposed"},
                {"−(smallest J)", -ending.result.measures.smallest_jacobian, 0, ""}},
               "the same load, applied in four times the steps");
}

/// Displacements of a turn by 180° about an axis.
Points half_turn(const Points& positions, const Eigen::RowVector3d& through, const Eigen::Vector3d& along) {
  const Eigen::Vector3d axis = along.normalized();
  return 2 * (positions.rowwise() - through) * (axis * axis.transpose() - Eigen::Matrix3d::Identity());
}

Eigen::Index nearest_node(const NodeCloud& cloud, const Eigen::RowVector3d& x) {
  Eigen::Index node = 0;
  (cloud.positions.rowwise() - x).rowwise().squaredNorm().minCoeff(&node);
  return node;
}

/// A column whose ends are held at the axis; a node beside it is pulled through the axis to the other side. There is
/// one state without stress that does so, the column turned by half a circle.
Row turned_column(int n) {
  constexpr double side = 20, height = 60;
  solve::Model model;
  model.cloud = test::irregular_box(n, height);
  model.conditions = test::all_free(model.cloud);
  model.cloud.positions.leftCols(2) *= side / height;
  model.cloud.positions.leftCols(2).array() -= side / 2;
  model.cells = test::box_cells({n - 1, n - 1, 2 * (n - 1)}, {side, side, height});
  model.cells.vertices.leftCols(2).array() -= side / 2;
  model.materials[1] = {3000, 0.45, 1000};
  const Eigen::Index bottom = nearest_node(model.cloud, {0, 0, 0});
  const Eigen::Index top = nearest_node(model.cloud, {0, 0, height});
  const Eigen::Index beside = nearest_node(model.cloud, {side / 2, 0, height / 2});
  const Points wanted = half_turn(model.cloud.positions, model.cloud.positions.row(bottom), {0, 0, 1});
  for (const Eigen::Index node : {bottom, top, beside}) {
    model.conditions.displacement.row(node) = wanted.row(node);
  }
  solve::SolveOptions options;
  options.tolerance = 1e-4;
  options.load_steps = 2000;
  options.max_steps = 200000;
  const Ending ending = run(model, options);
  double peak = 0;
  for (const solve::HistoryRow& row : ending.result.history) {
    peak = std::max(peak, row.strain_energy);
  }
  const double left = peak > 0 ? ending.result.history.back().strain_energy / peak : std::nan("");
  return judge("a column turned by 180° by three of its nodes", Must::answer, ending,
               {{"displacement off by", largest_difference(ending.result.solution.displacement, wanted), 0.01, "mm"},
                {"strain energy left", 100 * left, 0.01, "% of the largest on the way"}},
               "a rigid turn, without stress");
}

/// A cube held at three corners of its base alone, which turn by half a circle: each goes straight through the axis,
/// where the body is pressed to a line or a point. With what the program takes of itself.
Row turned_cube(const std::string& about, const Eigen::RowVector3d& through, const Eigen::Vector3d& along) {
  constexpr int n = 8;
  constexpr double side = solve::model_side;
  solve::Model model = solve::box_model(test::box_cells(n - 1, side), n);
  const Points wanted = half_turn(model.cloud.positions, through, along);
  for (const Eigen::RowVector3d& corner :
       {Eigen::RowVector3d(0, 0, 0), Eigen::RowVector3d(side, 0, 0), Eigen::RowVector3d(0, side, 0)}) {
    const Eigen::Index node = nearest_node(model.cloud, corner);
    model.conditions.displacement.row(node) = wanted.row(node);
  }
  solve::SolveOptions options;
  options.start = solve::Start::coarse;
  options.precision = solve::Precision::single_precision;
  const Ending ending = run(model, options);
  return judge("a cube of 512 nodes turned by 180° by three corners about " + about, Must::answer_or_stop, ending,
               {{"displacement off by", largest_difference(ending.result.solution.displacement, wanted), 0.05, "mm"}},
               "a rigid turn, without stress");
}

}  // namespace

std::vector<Row> loads(bool small) {
  const std::size_t nodes = small ? 500 : 2000;
  return {no_load(brain_model(nodes, 0), "a load of 0", {}), scaling(nodes), far_too_much(nodes)};
}

std::vector<Row> rotation(bool small) {
  constexpr double half = solve::model_side / 2;
  return {turned_column(small ? 3 : 5), turned_cube("an oblique axis through one of them", {0, 0, 0}, {1, 2, 3}),
          turned_cube("the axis upright in the middle", {half, half, 0}, {0, 0, 1})};
}

std::vector<Row> rest(bool) {
  solve::Model model = solve::uniaxial(0.8, 4);
  model.curve = solve::LoadCurve({0, 1}, {0, 0}, solve::LoadCurve::Join::smooth);
  solve::SolveOptions in_time = solve::in_time();
  const Row relaxed = no_load(model, "a load whose curve stays 0, to rest", {});
  const Ending transient = run(model, in_time);
  solve::SolveOptions no_increments;
  no_increments.load_steps = 1;
  const Ending at_once = run(solve::uniaxial(0.98, 4), no_increments), usual = run(solve::uniaxial(0.98, 4), {});
  return {relaxed,
          judge("the same, in time", Must::answer, transient,
                {{"largest displacement", transient.result.measures.largest_displacement, 0, "mm"}}, "rest"),
          judge("one load step: all of 1.2 mm at once", Must::answer_or_stop, at_once,
                {{"displacement off by",
                  largest_difference(at_once.result.solution.displacement, usual.result.solution.displacement), 0.02,
                  "mm"}},
                "the same load in 400 steps")};
}

}  // namespace brainshift::extremes::loads_cases
