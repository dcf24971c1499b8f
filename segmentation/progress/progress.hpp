// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace brainshift {

/// Called now and then from inside a stage, from one thread at a time: the fraction of the stage that is done, 0 to 1,
/// and what is being done. A stage never prints; who wants to see progress passes a function. May be empty.
using Progress = std::function<void(double fraction, std::string_view what)>;

inline void report(const Progress& progress, double fraction, std::string_view what) {
  if (progress) {
    progress(fraction, what);
  }
}

/// For a part of a stage's work: from its begin to its end, fractions of the whole.
inline Progress part_of(const Progress& whole, double begin, double end) {
  if (!whole) {
    return {};
  }
  return [=](double fraction, std::string_view what) { whole(begin + fraction * (end - begin), what); };
}

}  // namespace brainshift
