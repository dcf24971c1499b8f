// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/rest_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace brainshift::solve {

namespace {

std::string still_open(int steps, double error_bound, double tolerance) {
  std::ostringstream text;
  text << "not converged after " << steps << " steps: the error bound is " << error_bound << " mm, wanted " << tolerance
       << " mm";
  return text.str();
}

}  // namespace

std::string not_converged(int steps, double error_bound, double tolerance) {
  return still_open(steps, error_bound, tolerance) + "; allow more steps or a larger tolerance; it moves most";
}

std::string stands_still(int since, double error_bound, double tolerance, Precision precision) {
  std::ostringstream text;
  text << "not converged: since step " << since << " the body moves by no more than rounding, with an error bound of "
       << error_bound << " mm where " << tolerance << " mm are wanted; take a larger tolerance"
       << (precision == Precision::single_precision ? " or double precision" : "");
  return text.str();
}

std::string outlasts_single(int steps, double error_bound, double tolerance) {
  return still_open(steps, error_bound, tolerance) +
         ", and single precision may not tell where so slow a body rests; take double precision";
}

void report_window(const Progress& progress, int steps, double time, double error_bound, double tolerance,
                   double& done) {
  std::ostringstream text;
  text << "step " << steps;
  double now = 0.3 * time;
  if (std::isfinite(error_bound)) {
    text << ", error bound " << error_bound << " mm";
    const double decades = std::log10(std::max(error_bound / tolerance, 1.0));
    now = 1 - 0.7 * std::min(decades / 3, 1.0);
  }
  done = std::max(done, now);
  report(progress, done, text.str());
}

}  // namespace brainshift::solve
