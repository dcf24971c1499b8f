// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <iostream>
#include <memory>
#include <tuple>

#include "pipelines/after/after_run.hpp"
#include "pipelines/commands/commands.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/describe_scene.hpp"
#include "pipelines/scene/explain_scene.hpp"
#include "pipelines/scene/new_scene.hpp"
#include "pipelines/scene/options_page.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "pipelines/scene/presets.hpp"

namespace brainshift::pipelines {
namespace {

struct SceneArguments {
  std::filesystem::path check;
  std::filesystem::path explain;
  bool defaults = false;
  bool options = false;
  bool make = false;
  FilesAtHand files;
  std::filesystem::path after;
  std::optional<double> within;
  std::string preset;
  std::vector<std::string> overrides;
};

Scene checked(const std::filesystem::path& file, const SceneArguments& arguments) {
  Scene scene = parse_scene(file, preset_overrides(arguments.preset, arguments.overrides));
  check_scene(scene);
  return scene;
}

void explain(const Scene& scene, const std::filesystem::path& after, std::optional<double> within,
             const Settings& settings) {
  std::cout << explain_scene(scene);
  if (!after.empty()) {
    std::cout << std::flush
              << explain_after(scene, after, within, *settings.interruption, [&](const std::string& what) {
                   if (!settings.quiet) {
                     std::cerr << "solving " << what << " ...\n";
                   }
                 });
  }
}

/// Of a sequence state by state, as each is run.
void explain_all(const Scene& scene, const SceneArguments& arguments, const Settings& settings) {
  if (scene.states.empty()) {
    explain(scene, arguments.after, arguments.within, settings);
  }
  for (const Scene& state : scene.states) {
    const std::string& name = state.state->name;
    std::cout << "state " << name << (state.state->before.empty() ? "" : ", which goes on from " + state.state->before)
              << "\n";
    explain(state, arguments.after.empty() ? arguments.after : state_folder(arguments.after, name), arguments.within,
            settings);
  }
}

void look_at_scene(const SceneArguments& arguments, const Settings& settings) {
  const bool of_a_scene = !arguments.check.empty() || !arguments.explain.empty();
  if (!of_a_scene && (!arguments.preset.empty() || !arguments.overrides.empty())) {
    throw std::invalid_argument(
        "--preset and --set are of a scene that is there, for --check and --explain; leave them out, and give them to "
        "'brainshift run'");
  }
  if (arguments.defaults) {
    std::cout << default_scene();
  } else if (arguments.options) {
    std::cout << options_page();
  } else if (arguments.make) {
    const NewScene scene = new_scene(arguments.files);
    std::cout << scene.text;
    for (const std::string& sentence : scene.taken) {
      if (!settings.quiet) {
        std::cerr << sentence << "\n";
      }
    }
  } else if (!arguments.check.empty()) {
    checked(arguments.check, arguments);
    if (!settings.quiet) {
      std::cout << arguments.check.string() << ": no fault found\n";
    }
  } else {
    explain_all(checked(arguments.explain, arguments), arguments, settings);
  }
  std::cout.flush();
  if (!std::cout && errno != EPIPE) {  // who reads may have had enough, as head has
    throw std::runtime_error("standard output cannot be written");
  }
}

void add_files_at_hand(CLI::App& command, CLI::Option& make, FilesAtHand& files) {
  const std::tuple<const char*, std::filesystem::path&, const char*> images[] = {
      {"--t1", files.t1, "the preoperative image"},
      {"--labels", files.labels, "its label map"},
      {"--brain-mask", files.brain_mask, "or a mask of its brain, as a T1 without its skull is"},
      {"--tumour", files.tumour, "a label map of the tumour"}};
  for (const auto& [name, file, help] : images) {
    command.add_option(name, file, help)->type_name("FILE")->needs(&make);
  }
  command
      .add_option("--labels-are", files.labels_are, "freesurfer, brats or a table's file; else a table beside the map")
      ->type_name("NAME")
      ->needs(&make);
  command.add_option("--points", files.points, "markups or surfaces before and after, or craniotomy.csv")
      ->type_name("FILE")
      ->expected(1, 2)
      ->needs(&make);
}

}  // namespace

void add_scene_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("scene", "Look at a scene without computing.");
  auto arguments = std::make_shared<SceneArguments>();
  auto* what = command->add_option_group("what")->require_option(1);
  what->add_option("--check", arguments->check, "look for faults")->type_name("FILE");
  CLI::Option* explain =
      what->add_option("--explain", arguments->explain, "which parts are active and what they cost")->type_name("FILE");
  what->add_flag("--defaults", arguments->defaults, "a commented scene with every option");
  what->add_flag("--options", arguments->options, "every option with its range, unit and default, as a page");
  CLI::Option* make = what->add_flag("--new", arguments->make, "a short scene of the files at hand");
  add_files_at_hand(*command, *make, arguments->files);
  CLI::Option* after =
      command
          ->add_option("--after", arguments->after,
                       "the folder of the scene's run: solves it again with each part left out in turn and says which "
                       "made no difference; writes nothing")
          ->type_name("DIR")
          ->needs(explain);
  command->add_option("--within", arguments->within, "a change that counts as none, mm; else the solve tolerance")
      ->type_name("MM")
      ->check(CLI::PositiveNumber)
      ->needs(after);
  command->add_option("--preset", arguments->preset, "settings that the scene's run was given")
      ->type_name(preset_names());
  command->add_option("--set", arguments->overrides, "override an option of the scene")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([arguments, &settings] { look_at_scene(*arguments, settings); });
}

}  // namespace brainshift::pipelines
