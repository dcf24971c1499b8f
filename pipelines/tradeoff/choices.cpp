// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/choices.hpp"

#include <algorithm>

#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {

std::vector<Choice> all_choices(const TradeoffLists& lists) {
  std::vector<Choice> choices(1);
  for (std::size_t s = 0; s < tradeoff_settings.size(); ++s) {
    std::vector<Choice> longer;
    for (const Choice& choice : choices) {
      for (const std::string& value : split_words(lists.*tradeoff_settings[s].list)) {
        longer.push_back(choice);
        longer.back()[s] = value;
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

Choice reference_choice(const TradeoffLists& lists) {
  const std::vector<double> stops = read_numbers<double>(lists.tolerance).value();
  const double stop = *std::min_element(stops.begin(), stops.end()) / 10;
  return {write_number(lists.reference_nodes), "auto", "0", "modified_quadratic", "full", "double", write_number(stop)};
}

std::vector<std::string> overrides_of(const Choice& choice) {
  std::vector<std::string> overrides = {"discretise.spacing="};  // nodes take its place
  for (std::size_t s = 0; s < choice.size(); ++s) {
    overrides.push_back(std::string(tradeoff_settings[s].element) + "." + tradeoff_settings[s].name + "=" + choice[s]);
  }
  return overrides;
}

std::string name_of(const Choice& choice) {
  std::string name;
  for (const std::string& value : choice) {
    name += (name.empty() ? "" : "-") + value;
  }
  return name;
}

std::string describe(const Choice& choice) {
  const auto& [nodes, points, tau, basis, derivatives, precision, stop] = choice;
  const std::string integration = tau != "0"         ? "integration tolerance " + tau
                                  : points == "auto" ? "all points a cell"
                                                     : points + (points == "1" ? " point a cell" : " points a cell");
  return nodes + " nodes, " + integration + ", " + basis + " basis, " + derivatives + " derivatives, " + precision +
         " precision, stop at " + stop + " mm";
}

}  // namespace brainshift::pipelines
