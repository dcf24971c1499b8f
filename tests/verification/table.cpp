// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/figures.hpp"
#include "tests/verification/table_program.hpp"

namespace brainshift::verification {

namespace {

std::string number(double value) {
  return table_number("%.3g", value);
}

std::string bound_of(const Figure& figure) {
  std::string text = figure.least ? "≥ " + number(*figure.least) : "";
  if (figure.most) {
    text += (text.empty() ? "≤ " : ", ≤ ") + number(*figure.most);
  }
  return text.empty() ? "–" : text;
}

}  // namespace

std::string markdown_table(const std::vector<Row>& rows) {
  std::string text =
      "| case | quantity | published | ours | bound | holds | reference and its own error | s |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const auto& [name, f] : rows) {
    text += "| " + name + " | " + f.quantity + " | " + (f.published.empty() ? "–" : f.published) + " | " +
            number(f.ours) + ' ' + f.unit + " | " + bound_of(f) + " | " +
            (f.most || f.least ? (f.holds() ? "yes" : "**no**") : "–") + " | " + f.reference + " | " +
            table_number("%.1f", f.seconds) + " |\n";
  }
  return text;
}

std::string csv_table(const std::vector<Row>& rows) {
  std::string text = "case,quantity,published,ours,unit,bound,holds,reference,seconds\n";
  for (const auto& [name, f] : rows) {
    text += table_quoted(name) + ',' + table_quoted(f.quantity) + ',' + table_quoted(f.published) + ',' +
            number(f.ours) + ',' + table_quoted(f.unit) + ',' + table_quoted(bound_of(f)) + ',' +
            (f.holds() ? "yes" : "no") + ',' + table_quoted(f.reference) + ',' + table_number("%.1f", f.seconds) + '\n';
  }
  return text;
}

}  // namespace brainshift::verification
