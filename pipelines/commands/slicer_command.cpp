// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command-line module of 3D Slicer: its description, and a run by Slicer's rules. Progress and notes go to standard
// output, as Slicer shows what stands on standard error as a fault. A computation that does not converge ends with 0
// and a warning among the return parameters, as Slicer drops the outputs of a module that fails.
#include <tinyxml2.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>

#include "pipelines/checksum/sha256.hpp"
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
#include "pipelines/slicer/check_outputs.hpp"
#include "pipelines/slicer/description.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
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

/// The scene with options as attributes, PATH=VALUE each: 'brainshift run' on it does the same. None is of a part that
/// the scene lacks.
std::string with_options(const std::string& scene, const std::vector<std::string>& options) {
  tinyxml2::XMLDocument document;
  document.Parse(scene.c_str());
  tinyxml2::XMLElement& root = *document.RootElement();
  for (const std::string& option : options) {
    const std::size_t dot = option.find('.'), equals = option.find('=');
    const std::string part = option.substr(0, dot), value = option.substr(equals + 1);
    tinyxml2::XMLElement* element = root.FirstChildElement(part.c_str());
    for (auto* stage = root.FirstChildElement("stage"); stage != nullptr && element == nullptr;
         stage = stage->NextSiblingElement("stage")) {
      element = stage->Attribute("name", part.c_str()) != nullptr ? stage : nullptr;
    }
    if (element == nullptr) {
      element = root.InsertNewChildElement("stage");
      element->SetAttribute("name", part.c_str());
    }
    if (!value.empty()) {
      element->SetAttribute(option.substr(dot + 1, equals - dot - 1).c_str(), value.c_str());
    }
  }
  tinyxml2::XMLPrinter text;
  document.Print(&text);
  return text.CStr();
}

constexpr std::string_view mark = "<!-- As the module of 3D Slicer wrote it: ";

/// By which a scene is known that nobody has edited since.
std::string mark_of(const std::string& text) {
  return std::string(mark) + sha256_of_text(text) + " -->\n";
}

/// Throws std::invalid_argument where somebody has edited the scene that would be written over.
void refuse_edited(const fs::path& file) {
  if (!fs::exists(file)) {
    return;
  }
  const std::string all = read_text(file), text = all.substr(0, all.rfind(mark));
  if (all != text + mark_of(text)) {
    refuse(file,
           "it was edited, or an earlier version wrote it, and the module would write over it; run it with 'brainshift "
           "run', or choose another folder");
  }
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
  std::vector<std::string> options;
  for_each_parameter(Kind::option, [&](const SlicerParameter& option) {
    if (option.flag == "preset") {
      const bool given = arguments.values.contains(option.flag);
      options = preset_overrides(given ? arguments.value(option.flag) : option.default_value);
    } else if (arguments.values.contains(option.flag) && !option.path.empty() && option.flag != "labels_are") {
      options.push_back(option.path + "=" + arguments.value(option.flag));
    }
  });
  const fs::path file = folder / "scene.xml";
  refuse_edited(file);
  const std::string text = with_options(made.text, options);
  write_whole(file, text + mark_of(text));
  Scene scene = parse_scene(file, {});
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

/// What did not converge, then what the stages warn of.
std::string warnings_of(const RunOutcome& outcome) {
  std::string text = outcome.failure;
  for (const auto& [name, stage] : outcome.record["stages"].items()) {
    if (stage.value("status", "") == "outdated") {
      continue;
    }
    for (const auto& note : stage.value("notes", nlohmann::ordered_json::array())) {
      const std::string sentence = note.is_string() ? note.get<std::string>() : "";
      if (sentence.starts_with("warning: ")) {
        text += (text.empty() ? "" : "; ") + sentence.substr(std::string_view("warning: ").size());
      }
    }
  }
  return text;
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
            (returned.flag == "warning"                         ? printable(warnings_of(outcome))
             : measure != measures.end() && !measure->is_null() ? measure->dump()
                                                                : returned.default_value) +
            "\n";
  });
  write_whole(arguments.return_file, text);
}

void run_module(const SlicerArguments& arguments, const Settings& settings) {
  check_outputs(arguments.values, arguments.return_file);
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
