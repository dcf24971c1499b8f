// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace brainshift::pipelines {

enum class Verdict : std::uint8_t { within, outside, no_bound };

/// A quality measure in plain words.
struct MeasureRow {
  std::string stage;
  std::string meaning;
  std::string value;  ///< with its unit
  std::string bound;  ///< empty when it has none
  Verdict verdict = Verdict::no_bound;
};

/// The measures that tell whether a run may be trusted, as far as run.json has them.
std::vector<MeasureRow> quality_measures(const nlohmann::json& record);

/// A number with three figures; whole and large ones with all of theirs, thousands apart.
std::string readable(double value);

}  // namespace brainshift::pipelines
