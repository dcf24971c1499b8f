// SPDX-License-Identifier: GPL-3.0-or-later
//
// Derivatives kept in single precision: the same answer where single serves, and a bound of the error that holds.
#include <sstream>

#include "tests/extremes/block.hpp"
#include "tests/extremes/brain.hpp"
#include "tests/unit/solve/all_free.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift::extremes::precision_cases {

namespace {

constexpr double side = 50;  // mm

/// Tissue 2 is where a cell's lowest corner says so.
template <class IsStiff>
solve::Model two_tissues(int n, const solve::Material& soft, const solve::Material& stiff, const IsStiff& is_stiff) {
  const Block block{Eigen::Vector3d::Constant(side), 0.8, soft};
  solve::Model model = block.model(test::irregular_box(n, side), test::box_cells(n, side));
  test::label_cells(model.cells, [&](const Eigen::RowVector3d& low) { return is_stiff(low) ? 2 : 1; });
  model.materials[2] = stiff;
  return model;
}

/// The upper half is `contrast` times as stiff.
solve::Model layers(int n, double poisson_ratio, double contrast) {
  return two_tissues(n, {3000, poisson_ratio, 1000}, {contrast * 3000, poisson_ratio, 1000},
                     [](const Eigen::RowVector3d& low) { return low[2] >= side / 2 - 1e-6; });
}

/// A core in the middle third, `contrast` times as stiff, that soft tissue alone holds: it moves as a rigid body,
/// slowly.
solve::Model core(int n, double contrast) {
  return two_tissues(n, {3000, 0.45, 1000}, {contrast * 3000, 0.49, 1000}, [&](const Eigen::RowVector3d& low) {
    return ((low.array() - side / 2 + side / (2 * n)).abs() < side / 6).all();
  });
}

/// A plate a cell thick that bends under its weight, held at one end: so slow a motion that rounding of the forces
/// leaves it farther off than is wanted.
solve::Model plate() {
  solve::Model model;
  model.cells = test::box_cells({20, 12, 1}, {60, 36, 3});
  model.cloud.positions = model.cells.vertices;
  model.cloud.on_surface.assign(static_cast<std::size_t>(model.cells.vertices.rows()), 1);
  model.cloud.spacing.assign(model.cloud.on_surface.size(), 3);
  model.conditions = test::all_free(model.cloud);
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 0) < 1e-6) {
      model.conditions.displacement.row(a).setZero();
    }
  }
  model.materials[1] = {30000, 0.3, 1000};
  model.gravity = {0, 0, -0.5};
  return model;
}

/// Default options but single precision, against twenty times tighter from rest in double.
Row honest_bound(const std::string& what, const solve::Model& model) {
  solve::SolveOptions options;
  options.precision = solve::Precision::single_precision;
  const Ending answer = run(model, options);
  options.precision = solve::Precision::double_precision;
  options.tolerance = 0.0005;
  const Ending reference = run(model, options);
  const Points &u = answer.result.solution.displacement, &wanted = reference.result.solution.displacement;
  const double bounds = answer.result.measures.error_bound + reference.result.measures.error_bound;
  return judge("single precision asked, " + what, Must::answer, answer,
               {{"error over its bound", largest_difference(u, wanted) / bounds, 1, ""}},
               "double precision, tolerance 0.0005 mm");
}

}  // namespace

std::vector<Row> precision(bool small) {
  std::vector<Row> rows;
  for (const auto& [what, sink, most] : {std::tuple{"8 mm on a brain", 8.0, 1e-3}, {"30 mm on a brain", 30.0, 0.03}}) {
    const solve::Model model = brain_model(small ? 600 : 3000, sink);
    solve::SolveOptions options;
    const Ending kept_double = run(model, options);
    options.precision = solve::Precision::single_precision;
    const Ending kept_single = run(model, options);
    const Points &u = kept_single.result.solution.displacement, &wanted = kept_double.result.solution.displacement;
    rows.push_back(judge(std::string("derivatives in single precision, ") + what, Must::answer, kept_single,
                         {{"displacement off by", largest_difference(u, wanted), most, "mm"}},
                         "the same in double precision"));
  }
  const int n = small ? 6 : 8;
  for (const double poisson_ratio : {0.49, 0.4985, 0.499, 0.4999}) {
    std::ostringstream what;
    what << "ν = " << poisson_ratio;
    rows.push_back(honest_bound(what.str(), layers(n, poisson_ratio, 1)));
  }
  for (const double contrast : {100, 990, 10000}) {
    std::ostringstream what;
    what << "layers 1 : " << contrast;
    rows.push_back(honest_bound(what.str(), layers(n, 0.45, contrast)));
  }
  for (const double contrast : {100, 467, 990}) {
    std::ostringstream what;
    what << "a core 1 : " << contrast;
    rows.push_back(honest_bound(what.str(), core(9, contrast)));
  }
  rows.push_back(honest_bound("a plate a cell thick under its weight", plate()));
  return rows;
}

}  // namespace brainshift::extremes::precision_cases
