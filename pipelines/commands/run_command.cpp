// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/console.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "pipelines/scene/presets.hpp"
#include "pipelines/tradeoff/to_tolerance.hpp"

namespace brainshift::pipelines {
namespace {

struct RunArguments {
  std::filesystem::path scene;
  RunOptions options;
  std::string until = "report";
  std::string preset;
  std::optional<double> tolerance;
  std::optional<std::size_t> most_nodes;
  std::vector<std::string> overrides;
};

void show(Console& console, const RunEvent& event) {
  switch (event.kind) {
    case RunEvent::Kind::started:
      return console.started(event.stage);
    case RunEvent::Kind::progress:
      return console.progress(event.stage, event.fraction, event.what);
    case RunEvent::Kind::finished:
      return console.finished(event.stage, event.seconds);
    case RunEvent::Kind::kept:
      return console.kept(event.stage, event.what);
    case RunEvent::Kind::failed:
      return console.failed(event.stage);
    case RunEvent::Kind::note:
      return console.note(event.stage, event.what);
  }
}

void tell(const Level& level, bool quiet) {
  if (quiet) {
    return;
  }
  std::fprintf(stderr, "%zu nodes: ", level.nodes);
  if (std::isfinite(level.estimate.percentile_95)) {
    std::fprintf(stderr, "estimated error %.3g mm (95 %% of the brain; largest %.3g mm)\n",
                 level.estimate.percentile_95, level.estimate.largest);
  } else {
    std::fprintf(stderr, "the first solution\n");
  }
}

/// The sentence of what did not converge, or was not reached; else empty.
std::string run_checked(const Scene& scene, const RunArguments& arguments, const Settings& settings) {
  Console console(settings.quiet, settings.verbose);
  std::string state;
  const RunObserver observer = [&](const RunEvent& event) {
    if (state != event.state) {
      state = event.state;
      console.state(state);
    }
    show(console, event);
  };
  if (!arguments.tolerance) {
    return run(scene, arguments.options, *settings.interruption, observer).failure;
  }
  const ToleranceOutcome outcome =
      run_to_tolerance(scene, {*arguments.tolerance, arguments.most_nodes}, arguments.options, *settings.interruption,
                       observer, [&](const Level& level) { tell(level, settings.quiet); });
  return outcome.run.failure.empty() ? outcome.missed : outcome.run.failure;
}

void run_scene(RunArguments arguments, const Settings& settings) {
  const Scene scene = parse_scene(arguments.scene, preset_overrides(arguments.preset, arguments.overrides));
  check_scene(scene);
  arguments.options.until = stage_from_name(arguments.until);
  const std::string failure = run_checked(scene, arguments, settings);
  if (!failure.empty()) {
    throw NotConverged(failure);
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
  auto* preset =
      command->add_option("--preset", arguments->preset, "settings of the scene that suit each other: " + preset_help())
          ->type_name(preset_names());
  auto* tolerance =
      command
          ->add_option(
              "--tolerance", arguments->tolerance,
              "error of the displacement, mm, 95 % of the brain: spacing, basis, integration and stop are chosen, "
              "and the brain is solved on finer clouds until the estimated error is below it")
          ->type_name("MM")
          ->excludes(preset);
  command->add_option("--max-nodes", arguments->most_nodes, "that --tolerance may take; absent: what fits the memory")
      ->type_name("N")
      ->needs(tolerance);
  command->add_option("--set", arguments->overrides, "override an option of the scene, as segment.edge_length=4")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([arguments, &settings] { run_scene(*arguments, settings); });
}

}  // namespace brainshift::pipelines
