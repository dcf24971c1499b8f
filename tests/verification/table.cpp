// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "tests/verification/figures.hpp"

namespace brainshift::verification {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string bound_of(const Figure& figure) {
  std::string text = figure.least ? "≥ " + number(*figure.least) : "";
  if (figure.most) {
    text += (text.empty() ? "≤ " : ", ≤ ") + number(*figure.most);
  }
  return text.empty() ? "–" : text;
}

std::string seconds_of(const Figure& figure) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", figure.seconds);
  return text;
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

}  // namespace

std::string markdown_table(const std::vector<Row>& rows) {
  std::string text =
      "| case | quantity | published | ours | bound | holds | reference and its own error | s |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const auto& [name, f] : rows) {
    text += "| " + name + " | " + f.quantity + " | " + (f.published.empty() ? "–" : f.published) + " | " +
            number(f.ours) + ' ' + f.unit + " | " + bound_of(f) + " | " +
            (f.most || f.least ? (f.holds() ? "yes" : "**no**") : "–") + " | " + f.reference + " | " + seconds_of(f) +
            " |\n";
  }
  return text;
}

std::string csv_table(const std::vector<Row>& rows) {
  std::string text = "case,quantity,published,ours,unit,bound,holds,reference,seconds\n";
  for (const auto& [name, f] : rows) {
    text += quoted(name) + ',' + quoted(f.quantity) + ',' + quoted(f.published) + ',' + number(f.ours) + ',' +
            quoted(f.unit) + ',' + quoted(bound_of(f)) + ',' + (f.holds() ? "yes" : "no") + ',' + quoted(f.reference) +
            ',' + seconds_of(f) + '\n';
  }
  return text;
}

}  // namespace brainshift::verification
