// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the verification cases and prints their table.
//
//   verify [--small] [--out DIR] [CASE ...]
//
// Writes DIR/verification.md, DIR/verification.csv and the plots when --out is given. Exit 1 when a figure does not
// keep its bound.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include "segmentation/files/write_text.hpp"
#include "tests/verification/figures.hpp"

namespace {

using namespace brainshift::verification;

struct Arguments {
  bool small = false;
  std::filesystem::path out;
  std::vector<std::string> cases;
};

Arguments read_arguments(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--small") == 0) {
      arguments.small = true;
    } else if (std::strcmp(argv[i], "--out") == 0 && i + 1 < argc) {
      arguments.out = argv[++i];
    } else {
      arguments.cases.emplace_back(argv[i]);
    }
  }
  for (const std::string& name : arguments.cases) {
    if (std::none_of(all_cases().begin(), all_cases().end(), [&](const NamedCase& c) { return c.name == name; })) {
      throw std::invalid_argument("there is no case '" + name + "'");
    }
  }
  return arguments;
}

/// A case that the solver gave up is a figure that does not hold; the others still run.
Outcome finished(const Case& run_case, bool small) {
  try {
    return run_case(small);
  } catch (const std::runtime_error& error) {
    return {{{std::string("not finished: ") + error.what(), "", std::nan(""), "", 0.0}}, {}};
  }
}

int run(const Arguments& arguments) {
  std::vector<Row> rows;
  for (const auto& [name, run_case] : all_cases()) {
    if (!arguments.cases.empty() &&
        std::find(arguments.cases.begin(), arguments.cases.end(), name) == arguments.cases.end()) {
      continue;
    }
    std::fprintf(stderr, "%s ...\n", name.c_str());
    const Outcome outcome = finished(run_case, arguments.small);
    for (const Figure& figure : outcome.figures) {
      rows.push_back({name, figure});
    }
    if (!arguments.out.empty()) {
      std::filesystem::create_directories(arguments.out);
      for (const Plot& plot : outcome.plots) {
        draw(arguments.out, plot);
      }
      for (const Picture& picture : outcome.pictures) {
        brainshift::write_text(arguments.out / (picture.file + ".svg"), picture.svg);
      }
      brainshift::write_text(arguments.out / "verification.md", markdown_table(rows));
      brainshift::write_text(arguments.out / "verification.csv", csv_table(rows));
    }
  }
  std::printf("%s", markdown_table(rows).c_str());
  const auto broken = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.figure.holds(); });
  if (broken > 0) {
    std::printf("\n%d of %d figures do not keep their bound\n", static_cast<int>(broken),
                static_cast<int>(rows.size()));
  }
  return broken > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(read_arguments(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "verify: %s\n", error.what());
    return 2;
  }
}
