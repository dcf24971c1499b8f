// SPDX-License-Identifier: GPL-3.0-or-later
//
// Derivatives kept in single precision.
#include "tests/extremes/brain.hpp"

namespace brainshift::extremes {

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
  return rows;
}

}  // namespace brainshift::extremes
