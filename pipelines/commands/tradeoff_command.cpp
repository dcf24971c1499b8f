// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <iostream>
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/scene/tradeoff_lists.hpp"
#include "pipelines/tradeoff/tradeoff_files.hpp"

namespace brainshift::pipelines {
namespace {

struct TradeoffArguments {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::vector<std::string> lists;      ///< as overrides of the scene
  std::vector<std::string> overrides;  ///< --set
};

void tell(std::size_t done, std::size_t all, const TradeoffPoint& point) {
  if (point.failure.empty()) {
    std::fprintf(stderr, "%zu/%zu  %s: %.2f s, %.3f mm\n", done, all, describe(point.choice).c_str(),
                 point.solve_seconds, point.error.percentile_95);
  } else {
    std::fprintf(stderr, "%zu/%zu  %s: %s\n", done, all, describe(point.choice).c_str(), point.failure.c_str());
  }
}

void trade(const TradeoffArguments& arguments, const Settings& settings) {
  const auto observer = [&](std::size_t done, std::size_t all, const TradeoffPoint& point) {
    if (!settings.quiet) {
      tell(done, all, point);
    }
  };
  std::vector<std::string> overrides = arguments.overrides;
  overrides.insert(overrides.end(), arguments.lists.begin(), arguments.lists.end());
  const Sweep result = sweep(arguments.scene, overrides, arguments.out, *settings.interruption, observer);
  write_tradeoff(arguments.out, result);
  if (!settings.quiet) {
    std::cout << front_in_words(result, TradeoffTime::solve);
  }
}

}  // namespace

void add_tradeoff_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand(
      "tradeoff", "Solve a scene with many settings and show what each costs in seconds and buys in millimetres.");
  auto arguments = std::make_shared<TradeoffArguments>();
  command->add_option("scene", arguments->scene, "the scene's file (.xml)")->required()->type_name("SCENE");
  command->add_option("--out", arguments->out, "folder; what is measured in it already is not done again")
      ->required()
      ->type_name("DIR");
  const auto as_override = [&](const std::string& name, const std::string& help) {
    std::string flag = "--" + name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    command
        ->add_option_function<std::string>(
            flag,
            [arguments, name](const std::string& values) {
              arguments->lists.push_back("tradeoff." + name + "=" + values);
            },
            help)
        ->type_name("VALUE,VALUE,...");
  };
  for (const TradeoffSetting& setting : tradeoff_settings) {
    as_override(setting.name, "values of " + std::string(setting.element) + "." + setting.name);
  }
  as_override("reference_nodes", "of the much finer solution that they are measured against");
  command->add_option("--set", arguments->overrides, "override an option of the scene")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([arguments, &settings] { trade(*arguments, settings); });
}

}  // namespace brainshift::pipelines
