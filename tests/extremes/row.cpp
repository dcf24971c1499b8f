// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/extremes/row.hpp"

#include <cstdio>
#include <stdexcept>

#include "segmentation/progress/stopwatch.hpp"
#include "tests/verification/table_program.hpp"

namespace brainshift::extremes {

namespace {

std::string number(double value) {
  return table_number("%.2g", value);
}

std::string listed(const std::vector<Measured>& measured, bool bounds) {
  std::string text;
  for (const Measured& m : measured) {
    text += (text.empty() ? "" : "; ") + m.quantity + (bounds ? " ≤ " : " ") + number(bounds ? m.most : m.value) +
            (m.unit.empty() ? "" : " ") + m.unit;
  }
  return text;
}

std::string wanted(Must must, const std::vector<Measured>& measured) {
  switch (must) {
    case Must::answer:
      return listed(measured, true);
    case Must::answer_or_stop:
      return listed(measured, true) + "; or exit 3 that names the node";
    case Must::stop:
      return "exit 3 that names the node";
    case Must::refuse:
      return "exit 2 with a sentence";
  }
  return {};
}

bool within(const std::vector<Measured>& measured) {
  bool all = true;
  for (const Measured& m : measured) {
    all = all && m.value <= m.most;  // not a NaN
  }
  return all;
}

bool right(Must must, const Ending& ending, const std::vector<Measured>& measured, const std::string& words) {
  const bool says = ending.says.find(words) != std::string::npos;
  switch (ending.exit) {
    case 0:
      return (must == Must::answer || must == Must::answer_or_stop) && within(measured) &&
             ending.result.solution.displacement.allFinite();
    case 3:  // keeps the last good state
      return (must == Must::stop || must == Must::answer_or_stop) && says &&
             ending.says.find(" node ") != std::string::npos && ending.result.solution.displacement.allFinite();
    default:
      return must == Must::refuse && says;
  }
}

}  // namespace

Ending run(const solve::Model& model, const solve::SolveOptions& options) {
  Ending ending;
  const Stopwatch watch;
  try {
    ending.result = solve::solve(model, options);
    ending.says = ending.result.failure;
    ending.exit = ending.says.empty() ? 0 : 3;
  } catch (const std::invalid_argument& refusal) {
    ending.says = refusal.what();
    ending.exit = 2;
  }
  ending.seconds = watch.seconds();
  std::fprintf(stderr, "  %zu nodes, %d steps, exit %d, %.1f s\n", model.cloud.size(), ending.result.measures.steps,
               ending.exit, ending.seconds);
  return ending;
}

Row judge(const std::string& what, Must must, const Ending& ending, const std::vector<Measured>& measured,
          const std::string& reference, const std::string& words) {
  const std::string did =
      ending.exit == 0 ? listed(measured, false) : "exit " + std::to_string(ending.exit) + ": " + ending.says;
  return {what, wanted(must, measured), did, reference, right(must, ending, measured, words), ending.seconds};
}

std::string markdown_table(const std::vector<Row>& rows) {
  std::string text =
      "| case | what must happen | what did happen | holds | measured against | s |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const Row& row : rows) {
    text += "| " + row.what + " | " + row.must + " | " + row.did + " | " + (row.holds ? "yes" : "**no**") + " | " +
            row.reference + " | " + table_number("%.1f", row.seconds) + " |\n";
  }
  return text;
}

std::string csv_table(const std::vector<Row>& rows) {
  std::string text = "case,must,did,holds,reference,seconds\n";
  for (const Row& row : rows) {
    text += table_quoted(row.what) + ',' + table_quoted(row.must) + ',' + table_quoted(row.did) + ',' +
            (row.holds ? "yes" : "no") + ',' + table_quoted(row.reference) + ',' + table_number("%.1f", row.seconds) +
            '\n';
  }
  return text;
}

}  // namespace brainshift::extremes
