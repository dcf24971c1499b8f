// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the cases at the extremes and prints their table.
//
//   extremes [--small] [--out DIR] [CASE ...]
//
// Writes DIR/extremes.md and DIR/extremes.csv when --out is given. Exit 1 when a row does not do what it must.
#include <utility>

#include "tests/extremes/row.hpp"
#include "tests/verification/table_program.hpp"

namespace {

using namespace brainshift::extremes;

const std::pair<const char*, Case> cases[] = {
    {"compression", compression_cases::compression},
    {"incompressible", stiffness_cases::incompressible},
    {"stiffness_ratio", stiffness_cases::stiffness_ratio},
    {"clouds", clouds_cases::clouds},
    {"slivers", clouds_cases::slivers},
    {"far_away", places_cases::far_away},
    {"metres", places_cases::metres},
    {"time_step", steps_cases::time_step},
    {"free_vibration", steps_cases::free_vibration},
    {"precision", precision_cases::precision},
    {"loads", loads_cases::loads},
    {"rotation", loads_cases::rotation},
    {"rest", loads_cases::rest},
};

std::vector<Row> rows_of(const std::string&, Case run_case, const brainshift::TableArguments& arguments) {
  return run_case(arguments.small);
}

}  // namespace

int main(int argc, char** argv) {
  return brainshift::run_table_program({"extremes", "extremes", "rows do not do what they must"},
                                       {argv + 1, argv + argc}, cases, rows_of,
                                       [](const Row& row) { return row.holds; });
}
