// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/commands/cut_arguments.hpp"

#include <stdexcept>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/table_option.hpp"
#include "pipelines/scene/rupture_text.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/cut/cut_path.hpp"

namespace brainshift::pipelines {
namespace {

/// Of an option that may be given again, one value each time.
void repeated(CLI::Option* option, const std::string& type) {
  option->type_name(type)->take_all()->allow_extra_args(false);
}

solve::Cut read_path(const std::string& text, const solve::CutTiming& timing) {
  const auto vertices = read_number_pairs(text);
  if (!vertices) {
    throw std::invalid_argument("--cut-path is '" + text +
                                "', but must be points x,y in mm, separated by semicolons, as '0,50; 30,50' is");
  }
  return solve::cut_path(*vertices, timing, "--cut-path '" + text + "'");
}

}  // namespace

void add_cut_options(CLI::App& command, Scene& scene, CutArguments& arguments) {
  repeated(command.add_option("--cut", arguments.files,
                              "a cut; again for each: a sheet (" + std::string(listed_surface_endings) +
                                  "), with --plane a path (.csv, x,y[,time])"),
           "FILE");
  repeated(command.add_option("--cut-path", arguments.paths, "a cut of a plane problem; again for each"),
           "'x,y; x,y; ...'");
  for (const char* name : {"start", "speed", "direction"}) {
    add_table_option<CutFile>(command, std::string("--cut-") + name, *find_option(cut_options(), name),
                              [&arguments]() -> CutFile& { return arguments.timed; });
  }
  add_scene_option(command, scene, "cuts", "contact", "--cut-contact");
  CLI::Option* labels = add_scene_option(command, scene, "resection", "labels", "--resection");
  add_scene_option(command, scene, "resection", "pressure", "--resection-pressure")->needs(labels);
  CLI::Option* rupture =
      command
          .add_option(
              "--rupture", arguments.rupture,
              "of a plane problem: above this principal stretch or stress (Pa) a tear goes on or begins, a mean "
              "over the distance (mm; 0: twice the spacing); the strength uniform in 1 ± scatter from place to "
              "place")
          ->type_name("stretch=S|stress=PA[,distance=MM][,scatter=SHARE][,seed=N]");
  CLI::Option* spots = command.add_option("--weak-spot", arguments.weak_spots,
                                          "where the strength is lower by the factor; again for each");
  repeated(spots->needs(rupture), "x,y,radius,factor");
}

void read_cut_arguments(const CutArguments& arguments, Scene& scene, SolveJob& job) {
  const bool planar = job.plane != solve::Plane::none;
  const solve::CutTiming& timing = arguments.timed.timing;
  if (!planar && !arguments.paths.empty()) {
    throw std::invalid_argument(
        "--cut-path cuts a plane problem; say --plane, or give a body in space a sheet with --cut");
  }
  if (!planar && arguments.rupture) {
    throw std::invalid_argument("--rupture is for plane problems; say --plane, or leave it out");
  }
  if (arguments.files.empty() && arguments.paths.empty() &&
      (scene.cuts || timing.start || timing.speed || !timing.direction.isZero(0))) {
    throw std::invalid_argument(
        "there is no cut to which contact, start, speed or direction would apply; give a --cut");
  }
  if (!arguments.files.empty() && !scene.cuts) {
    scene.cuts.emplace();
  }
  for (const std::filesystem::path& file : arguments.files) {
    scene.cuts->files.push_back({file, timing});
  }
  for (const std::string& text : arguments.paths) {
    job.cut_paths.push_back(read_path(text, timing));
  }
  if (arguments.rupture) {
    job.rupture = rupture_from_text(*arguments.rupture);
  }
  for (const std::string& text : arguments.weak_spots) {
    job.rupture->weak_spots.push_back(weak_spot_from_text(text));
  }
}

}  // namespace brainshift::pipelines
