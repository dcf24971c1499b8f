// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/report/report.hpp"

namespace brainshift::pipelines {
namespace {

struct ReportArguments {
  std::filesystem::path run_folder;
  std::filesystem::path out;
};

}  // namespace

void add_report_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("report", "The page of pictures of a run.");
  auto arguments = std::make_shared<ReportArguments>();
  command->add_option("run_folder", arguments->run_folder, "the --out of a run")->required()->type_name("RUN_FOLDER");
  command->add_option("--out", arguments->out, "folder for the page; RUN_FOLDER/report if absent")->type_name("DIR");
  command->callback([arguments, &settings] {
    const auto out = arguments->out.empty() ? arguments->run_folder / "report" : arguments->out;
    if (!std::filesystem::exists(arguments->run_folder / "run.json")) {
      throw std::invalid_argument(arguments->run_folder.string() +
                                  ": there is no run.json in it; give the --out folder of 'brainshift run'");
    }
    run_single_stage(StageId::report, out, settings, [&](const auto& folder, const Progress& progress) {
      write_report(arguments->run_folder, folder, progress);
      return StageReport{};
    });
  });
}

}  // namespace brainshift::pipelines
