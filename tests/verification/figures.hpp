// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipelines/report/plot.hpp"

namespace brainshift::verification {

/// One row of the table: what was measured, beside what was published and the bound it must keep.
struct Figure {
  std::string quantity;
  std::string published;  ///< as Wittek et al. have it; empty: nothing
  double ours = 0;
  std::string unit;
  std::optional<double> most = {};   ///< bound from above
  std::optional<double> least = {};  ///< bound from below
  std::string reference = {};        ///< what it is measured against, with that reference's own error
  double seconds = 0;

  bool holds() const { return !(most && !(ours <= *most)) && !(least && !(ours >= *least)); }
};

using pipelines::Plot;
using pipelines::Series;

struct Picture {
  std::string file;  ///< without .svg
  std::string svg;
};

struct Outcome {
  std::vector<Figure> figures;
  std::vector<Plot> plots;
  std::vector<Picture> pictures = {};
};

/// small: minutes become seconds, for the tests; the bounds are then wider where the case says so.
using Case = std::function<Outcome(bool small)>;

using NamedCase = std::pair<std::string, Case>;

/// All cases, in the table's order.
const std::vector<NamedCase>& all_cases();

/// The table of the cases that ran: case · quantity · published · ours · bound · reference · seconds.
struct Row {
  std::string name;
  Figure figure;
};
std::string markdown_table(const std::vector<Row>& rows);
std::string csv_table(const std::vector<Row>& rows);

}  // namespace brainshift::verification
