// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the cases at the extremes and prints their table.
//
//   extremes [--small] [--out DIR] [CASE ...]
//
// Writes DIR/extremes.md and DIR/extremes.csv when --out is given. Exit 1 when a row does not do what it must.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "segmentation/files/write_text.hpp"
#include "tests/extremes/row.hpp"

namespace {

using namespace brainshift::extremes;

const std::pair<const char*, Case> cases[] = {
    {"compression", compression_cases::compression},
    {"incompressible", stiffness_cases::incompressible},
    {"stiffness_ratio", stiffness_cases::stiffness_ratio},
    {"clouds", clouds_cases::clouds},
    {"slivers", clouds_cases::slivers},
    {"far_away", places_cases::far_away},
    {"metres", places_cases::metres},
    {"time_step", steps_cases::time_step},
    {"free_vibration", steps_cases::free_vibration},
    {"precision", precision_cases::precision},
    {"loads", loads_cases::loads},
    {"rotation", loads_cases::rotation},
    {"rest", loads_cases::rest},
};

struct Arguments {
  bool small = false;
  std::filesystem::path out;
  std::vector<std::string> names;
};

Arguments read_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--small") {
      arguments.small = true;
    } else if (words[i] == "--out" && i + 1 < words.size()) {
      arguments.out = words[++i];
    } else if (std::any_of(std::begin(cases), std::end(cases), [&](const auto& c) { return c.first == words[i]; })) {
      arguments.names.push_back(words[i]);
    } else {
      throw std::invalid_argument("there is no case '" + words[i] + "'");
    }
  }
  return arguments;
}

int run_cases(const Arguments& arguments) {
  std::vector<Row> rows;
  for (const auto& [name, run_case] : cases) {
    const auto& names = arguments.names;
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
      continue;
    }
    std::fprintf(stderr, "%s ...\n", name);
    for (const Row& row : run_case(arguments.small)) {
      rows.push_back(row);
    }
    if (!arguments.out.empty()) {
      std::filesystem::create_directories(arguments.out);
      brainshift::write_text(arguments.out / "extremes.md", markdown_table(rows));
      brainshift::write_text(arguments.out / "extremes.csv", csv_table(rows));
    }
  }
  std::printf("%s", markdown_table(rows).c_str());
  const auto broken = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.holds; });
  if (broken > 0) {
    std::printf("\n%d of %d rows do not do what they must\n", static_cast<int>(broken), static_cast<int>(rows.size()));
  }
  return broken > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_cases(read_arguments({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "extremes: %s\n", error.what());
    return 2;
  }
}
