// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

namespace brainshift::pipelines {

/// What `brainshift tradeoff` tries: for each setting the values of the scene's option of that name, separated by
/// blanks or commas; all combinations are solved.
struct TradeoffLists {
  std::string nodes = "1500 3000 6000 12000";
  std::string points_per_cell = "1 auto";
  std::string integration_tolerance = "0";
  std::string basis = "linear modified_quadratic";
  std::string derivatives = "full diffuse";
  std::string precision = "double single";
  std::string tolerance = "0.1 0.01";
  int reference_nodes = 48000;  ///< of the solution that they are measured against
};

/// A setting and where the scene has its option.
struct TradeoffSetting {
  const char* name;
  const char* element;
  std::string TradeoffLists::*list;
};

/// In the order in which combinations are counted: what a cloud is made from comes first, so that it is made once.
inline constexpr std::array<TradeoffSetting, 7> tradeoff_settings = {{
    {"nodes", "discretise", &TradeoffLists::nodes},
    {"points_per_cell", "solve", &TradeoffLists::points_per_cell},
    {"integration_tolerance", "solve", &TradeoffLists::integration_tolerance},
    {"basis", "solve", &TradeoffLists::basis},
    {"derivatives", "solve", &TradeoffLists::derivatives},
    {"precision", "solve", &TradeoffLists::precision},
    {"tolerance", "solve", &TradeoffLists::tolerance},
}};

}  // namespace brainshift::pipelines
