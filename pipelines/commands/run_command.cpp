// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"

namespace brainshift::pipelines {
namespace {

struct RunArguments {
  std::filesystem::path scene;
  RunOptions options;
  std::string until = "report";
  std::vector<std::string> overrides;
};

void show(Console& console, const RunEvent& event) {
  switch (event.kind) {
    case RunEvent::Kind::started:
      return console.started(event.stage);
    case RunEvent::Kind::progress:
      return console.progress(event.stage, event.fraction, event.total_fraction, event.what);
    case RunEvent::Kind::finished:
      return console.finished(event.stage, event.seconds);
    case RunEvent::Kind::kept:
      return console.kept(event.stage);
    case RunEvent::Kind::failed:
      return console.failed(event.stage);
  }
}

void run_scene(RunArguments arguments, const Settings& settings) {
  const Scene scene = parse_scene(arguments.scene, arguments.overrides);
  check_scene(scene);
  arguments.options.until = stage_from_name(arguments.until);
  Console console(settings.quiet, settings.verbose);
  const RunOutcome outcome =
      run(scene, arguments.options, *settings.interruption, [&](const RunEvent& event) { show(console, event); });
  if (!outcome.failure.empty()) {
    throw NotConverged(outcome.failure);
  }
}

}  // namespace

void add_run_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("run", "Run the stages of a scene in one folder.");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("scene", arguments->scene, "the scene's file (.xml)")->required()->type_name("SCENE");
  command->add_option("--out", arguments->options.out, "the run's folder; finished stages in it are kept")
      ->required()
      ->type_name("DIR");
  command->add_option("--until", arguments->until, "the last stage to run")
      ->type_name("segment | discretise | solve | register | report");
  command->add_flag("--force", arguments->options.force, "run stages that have not changed, too");
  command->add_option("--set", arguments->overrides, "override an option of the scene, as segment.edge_length=4")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([arguments, &settings] { run_scene(*arguments, settings); });
}

}  // namespace brainshift::pipelines
