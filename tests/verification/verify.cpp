// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the verification cases and prints their table.
//
//   verify [--small] [--out DIR] [CASE ...]
//
// Writes DIR/verification.md, DIR/verification.csv and the plots when --out is given. Exit 1 when a figure does not
// keep its bound.
#include <cmath>
#include <stdexcept>

#include "segmentation/files/write_text.hpp"
#include "tests/verification/figures.hpp"
#include "tests/verification/table_program.hpp"

namespace {

using namespace brainshift::verification;

/// A case that the solver gave up is a figure that does not hold; the others still run.
Outcome finished(const Case& run_case, bool small) {
  try {
    return run_case(small);
  } catch (const std::runtime_error& error) {
    return {{{std::string("not finished: ") + error.what(), "", std::nan(""), "", 0.0}}, {}};
  }
}

std::vector<Row> rows_of(const std::string& name, const Case& run_case, const brainshift::TableArguments& arguments) {
  const Outcome outcome = finished(run_case, arguments.small);
  if (!arguments.out.empty()) {
    for (const Plot& plot : outcome.plots) {
      draw(arguments.out, plot);
    }
    for (const Picture& picture : outcome.pictures) {
      brainshift::write_text(arguments.out / (picture.file + ".svg"), picture.svg);
    }
  }
  std::vector<Row> rows;
  for (const Figure& figure : outcome.figures) {
    rows.push_back({name, figure});
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  return brainshift::run_table_program({"verify", "verification", "figures do not keep their bound"},
                                       {argv + 1, argv + argc}, all_cases(), rows_of,
                                       [](const Row& row) { return row.figure.holds(); });
}
