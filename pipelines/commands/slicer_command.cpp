// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line module of 3D Slicer: its description, and a run by Slicer's rules. Progress and notes go to standard
// output, as Slicer shows what stands on standard error as a fault. A computation that does not converge ends with 0
// and a warning among the return parameters, as Slicer drops the outputs of a module that fails.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/printable.hpp"
#include "pipelines/runner/own_folder.hpp"
#include "pipelines/runner/plan.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/runner/scratch_folder.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/new_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "pipelines/scene/presets.hpp"
#include "pipelines/slicer/description.hpp"
#include "segmentation/image/image.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
using Kind = SlicerParameter::Kind;

struct SlicerArguments {
  std::optional<std::string> xml;
  fs::path return_file;
  std::map<std::string, std::string> values;  ///< by flag; those that are given

  std::string value(const std::string& flag) const { return values.contains(flag) ? values.at(flag) : ""; }
};

template <class Visit>
void for_each_parameter(Kind kind, const Visit& visit) {
  for (const SlicerGroup& group : slicer_groups()) {
    for (const SlicerParameter& parameter : group.parameters) {
      if (parameter.kind == kind) {
        visit(parameter);
      }
    }
  }
}

std::string as_xml_text(std::string_view text) {
  std::string safe;
  for (const char c : printable(text)) {
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

/// What Slicer reads on standard output.
class Progressing {
 public:
  void show(const RunEvent& event) {
    const std::string stage(stage_name(event.stage));
    switch (event.kind) {
      case RunEvent::Kind::started:
        std::cout << "<filter-start><filter-name>" << stage << "</filter-name><filter-comment>" << stage
                  << "</filter-comment></filter-start>\n";
        break;
      case RunEvent::Kind::progress:
        if (event.total_fraction < shown_ + 0.005) {
          return;
        }
        shown_ = event.total_fraction;
        std::cout << "<filter-progress>" << shown_ << "</filter-progress><filter-stage-progress>" << event.fraction
                  << "</filter-stage-progress><filter-comment>" << stage << ": " << as_xml_text(event.what)
                  << "</filter-comment>\n";
        break;
      case RunEvent::Kind::note:
        std::cout << stage << ": " << printable(event.what) << '\n';
        break;
      case RunEvent::Kind::kept:
      case RunEvent::Kind::finished:
      case RunEvent::Kind::failed:
        std::cout << "<filter-end><filter-name>" << stage << "</filter-name><filter-time>" << event.seconds
                  << "</filter-time></filter-end>\n";
        break;
    }
    std::cout.flush();
  }

 private:
  double shown_ = -1;
};

void check_outputs(const SlicerArguments& arguments) {
  for_each_parameter(Kind::output, [&](const SlicerParameter& output) {
    const std::string file = arguments.value(output.flag);
    for (const auto& [name, ending] : output.attributes) {
      if (name == "fileExtensions" && !file.empty() && !file.ends_with(ending)) {
        throw std::invalid_argument("--" + output.flag + " is '" + file + "', but must end in " + ending);
      }
    }
  });
}

/// The scene of what Slicer hands over, in the run's folder.
Scene scene_of(const SlicerArguments& arguments, const fs::path& folder) {
  FilesAtHand files{.t1 = arguments.value("t1"),
                    .labels = arguments.value("labels"),
                    .labels_are = arguments.value("labels_are"),
                    .brain_mask = {},
                    .tumour = {},
                    .points = {}};
  for (const char* list : {"before", "after"}) {
    if (!arguments.values.contains(list)) {
      throw std::invalid_argument(std::string("choose a list of points ") + list + " (--" + list + ")");
    }
    files.points.emplace_back(arguments.value(list));
  }
  const NewScene made = new_scene(files);
  for (const std::string& sentence : made.taken) {
    std::cout << printable(sentence) << '\n';
  }
  write_whole(folder / "scene.xml", made.text);
  std::vector<std::string> overrides = preset_overrides(arguments.value("preset"));
  for_each_parameter(Kind::option, [&](const SlicerParameter& option) {
    if (arguments.values.contains(option.flag) && !option.path.empty() && option.flag != "labels_are") {
      overrides.push_back(option.path + "=" + arguments.value(option.flag));
    }
  });
  Scene scene = parse_scene(folder / "scene.xml", overrides);
  check_scene(scene);
  return scene;
}

/// The images and the report of a solution that did not converge.
void show_what_there_is(const Scene& scene, const fs::path& folder, const Settings& settings) {
  Settings silent = settings;
  silent.quiet = true;
  for (const StageId stage : {StageId::registration, StageId::report}) {
    const StagePlan plan = plan_stage(stage, scene, folder, *settings.interruption);
    const fs::path out = folder / stage_name(stage);
    refuse_foreign_folder(out);
    remove_own_folder(out);  // of an earlier run: nothing of it must stay beside what is new
    run_single_stage(stage, out, silent, plan.work);
  }
}

ScalarImage lengths(const VectorImage& field) {
  ScalarImage image{field.geometry, {}};
  for (const auto& [x, y, z] : field.voxels) {
    image.voxels.push_back(std::hypot(x, y, z));
  }
  return image;
}

/// Appears whole: it is written beside its place first.
void write_output(const SlicerParameter& output, const fs::path& made, const fs::path& place) {
  const fs::path unfinished = place.parent_path() / ("partial_" + place.filename().string());
  if (output.flag == "displacement") {
    write_image(unfinished, lengths(read_vector_image(made)));
  } else {
    fs::copy_file(made, unfinished, fs::copy_options::overwrite_existing);
  }
  fs::rename(unfinished, place);
}

void write_outputs(const SlicerArguments& arguments, const fs::path& folder, Interruption& interruption) {
  for_each_parameter(Kind::output, [&](const SlicerParameter& output) {
    if (!arguments.values.contains(output.flag) || output.path.empty()) {
      return;
    }
    const fs::path made = folder / output.path;
    if (fs::exists(made)) {
      const auto hold = interruption.hold();
      write_output(output, made, arguments.value(output.flag));
    } else {
      std::fprintf(stderr, "brainshift: this run has no --%s\n", output.flag.c_str());
    }
  });
}

void write_returned(const SlicerArguments& arguments, const RunOutcome& outcome) {
  if (arguments.return_file.empty()) {
    return;
  }
  const auto& measures = outcome.record["stages"]["solve"]["measures"];
  std::string text;
  for_each_parameter(Kind::returned, [&](const SlicerParameter& returned) {
    const auto measure = measures.find(returned.flag);
    text += returned.flag + " = " +
            (returned.flag == "warning"  ? printable(outcome.failure)
             : measure != measures.end() ? measure->dump()
                                         : returned.default_value) +
            "\n";
  });
  write_whole(arguments.return_file, text);
}

void run_module(const SlicerArguments& arguments, const Settings& settings) {
  check_outputs(arguments);
  std::optional<ScratchFolder> scratch;
  fs::path folder = arguments.value("run");
  if (folder.empty()) {
    scratch.emplace(*settings.interruption);
    folder = scratch->path() / "run";
  }
  fs::create_directories(folder);
  const Scene scene = scene_of(arguments, folder);
  Progressing progressing;
  const RunOutcome outcome =
      run(scene, {.out = folder}, *settings.interruption, [&](const RunEvent& event) { progressing.show(event); });
  if (!outcome.failure.empty()) {
    show_what_there_is(scene, folder, settings);
    std::fprintf(stderr, "brainshift: %s; the outputs show what there is\n", printable(outcome.failure).c_str());
  }
  write_outputs(arguments, folder, *settings.interruption);
  write_returned(arguments, outcome);
  std::cout << "<filter-progress>1</filter-progress>\n" << std::flush;
}

}  // namespace

void add_slicer_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("slicer", "The command-line module of 3D Slicer, which calls it.");
  auto arguments = std::make_shared<SlicerArguments>();
  command->add_option("--xml", arguments->xml, "print the module's description; files: for hosts that know files alone")
      ->type_name("[files]")
      ->check(CLI::IsMember({"files"}))
      ->expected(0, 1);
  command->add_option("--returnparameterfile", arguments->return_file, "gets what the run says of itself")
      ->type_name("FILE");
  for (const SlicerGroup& group : slicer_groups()) {
    for (const SlicerParameter& parameter : group.parameters) {
      if (parameter.kind != Kind::returned) {
        command
            ->add_option_function<std::string>(
                "--" + parameter.flag,
                [arguments, flag = parameter.flag](const std::string& value) { arguments->values[flag] = value; },
                parameter.description)
            ->type_name(parameter.tag)
            ->default_str(parameter.default_value);
      }
    }
  }
  command->callback([arguments, &settings] {
    if (arguments->xml) {
      std::cout << slicer_description(*arguments->xml == "files") << std::flush;
    } else {
      run_module(*arguments, settings);
    }
  });
}

}  // namespace brainshift::pipelines
