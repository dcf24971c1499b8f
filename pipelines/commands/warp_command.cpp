// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/printable.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/warp_files.hpp"

namespace brainshift::pipelines {
namespace {

using registration::Interpolation;
using registration::Values;

struct WarpArguments {
  WarpJob job;
  bool inverse = false;
  std::string interpolation = "auto";
  std::filesystem::path out;
};

void set_interpolation(const std::string& name, registration::WarpAnyOptions& options) {
  options.values = name == "auto" ? Values::recognised : name == "nearest" ? Values::labels : Values::intensities;
  options.interpolation = name == "bspline" ? Interpolation::bspline : Interpolation::linear;
}

void warp(const WarpArguments& arguments, const Settings& settings) {
  WarpJob job = arguments.job;
  job.towards = arguments.inverse ? registration::Towards::preop : registration::Towards::intraop;
  set_interpolation(arguments.interpolation, job.options);
  refuse_stage_folder(arguments.out);
  StageFolder folder(arguments.out, *settings.interruption);
  const std::vector<std::string> notes = warp_files(job, folder.path());
  remove_values_of_earlier(job.files, folder.path(), arguments.out);
  folder.merge();
  for (const std::string& note : notes) {
    if (!settings.quiet) {
      std::fprintf(stderr, "warp: %s\n", printable(note).c_str());
    }
  }
}

}  // namespace

void add_warp_command(CLI::App& program, const Settings& settings) {
  CLI::App* command =
      program.add_subcommand("warp", "Takes images, surfaces, tracts and points along, by a finished run's fields.");
  auto arguments = std::make_shared<WarpArguments>();
  command->add_option("run_folder", arguments->job.run, "the --out of a run")->required()->type_name("RUN");
  command->add_option("files", arguments->job.files, "what is to be warped")->required()->type_name("FILE");
  command->add_flag("--inverse", arguments->inverse, "the files are intraoperative; take them back");
  command->add_option("--like", arguments->job.like, "image whose grid warped images take; their own if absent")
      ->type_name("IMAGE");
  command
      ->add_option("--interpolation", arguments->interpolation,
                   "of images; auto: label maps nearest, else linear; nearest takes label maps alone")
      ->check(CLI::IsMember({"auto", "nearest", "linear", "bspline"}))
      ->type_name("auto | nearest | linear | bspline")
      ->capture_default_str();
  command->add_option("--out", arguments->out, "folder for the warped files")->required()->type_name("DIR");
  command->callback([arguments, &settings] { warp(*arguments, settings); });
}

}  // namespace brainshift::pipelines
