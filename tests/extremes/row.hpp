// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "solve/solve.hpp"

namespace brainshift::extremes {

/// How a run ended, as the program would: with an answer (exit 0), stopped on the way (3) or refused at the door (2).
struct Ending {
  int exit = 0;
  std::string says = {};  ///< the sentence, where there is no answer
  solve::SolveResult result = {};
  double seconds = 0;
};
Ending run(const solve::Model& model, const solve::SolveOptions& options);

/// What is measured of an answer, and the most it may be.
struct Measured {
  std::string quantity;
  double value;
  double most;
  std::string unit;
};

/// Ways to end that are right.
enum class Must { answer, answer_or_stop, stop, refuse };

/// A row of the table.
struct Row {
  std::string what, must, did, reference;
  bool holds;
  double seconds;
};

/// measured: of the answer, when there is one. words: what the sentence of a stop or refusal must say; a stop names its
/// node in any case.
Row judge(const std::string& what, Must must, const Ending& ending, const std::vector<Measured>& measured,
          const std::string& reference, const std::string& words = {});

/// small: minutes become seconds, for the tests.
using Case = std::vector<Row> (*)(bool small);

std::string markdown_table(const std::vector<Row>& rows);
std::string csv_table(const std::vector<Row>& rows);

// A namespace a file.
namespace clouds_cases {
std::vector<Row> clouds(bool small);
std::vector<Row> slivers(bool small);
}  // namespace clouds_cases

namespace compression_cases {
std::vector<Row> compression(bool small);
}  // namespace compression_cases

namespace loads_cases {
std::vector<Row> loads(bool small);
std::vector<Row> rotation(bool small);
std::vector<Row> rest(bool small);
}  // namespace loads_cases

namespace places_cases {
std::vector<Row> far_away(bool small);
std::vector<Row> metres(bool small);
}  // namespace places_cases

namespace precision_cases {
std::vector<Row> precision(bool small);
}  // namespace precision_cases

namespace steps_cases {
std::vector<Row> time_step(bool small);
std::vector<Row> free_vibration(bool small);
}  // namespace steps_cases

namespace stiffness_cases {
std::vector<Row> incompressible(bool small);
std::vector<Row> stiffness_ratio(bool small);
}  // namespace stiffness_cases

}  // namespace brainshift::extremes
