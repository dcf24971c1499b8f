// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/runner/job_files.hpp"

namespace brainshift::pipelines {
namespace {

struct RegisterArguments {
  Scene scene;
  RegisterJob job;
  std::filesystem::path out;
};

void register_images(const RegisterArguments& arguments, const Settings& settings) {
  RegisterJob job = arguments.job;
  job.options = arguments.scene.registration;
  if (arguments.scene.resection) {
    job.resected = arguments.scene.resection->labels;
  }
  run_single_stage(StageId::registration, arguments.out, settings, [&](const auto& folder, const Progress& progress) {
    StageReport said = run_job(job, folder, progress);
    for (const std::string& warning : frame_warnings({job.t1, job.labels})) {  // of a run segment says it
      said.notes.push_back(warning);
    }
    return said;
  });
}

}  // namespace

void add_register_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("register", "Displacements to fields, transforms and warped images.");
  auto arguments = std::make_shared<RegisterArguments>();
  RegisterJob& job = arguments->job;
  command->add_option("--solution", job.solution, "solution.vtu")->required()->type_name("FILE");
  command->add_option("--brain", job.surface, "the brain's surface")->required()->type_name("FILE");
  command->add_option("--t1", job.t1, "preop image, whose grid the fields take")->required()->type_name("FILE");
  command->add_option("--labels", job.labels, "label map to warp")->type_name("FILE");
  CLI::Option* wall =
      command->add_option("--wall", job.wall, "of what was taken out, resection.vtp of segment")->type_name("FILE");
  CLI::Option* resected = add_scene_option(*command, arguments->scene, "resection", "labels", "--resection");
  wall->needs(resected);
  resected->needs(wall);
  for (const char* name : {"cavity_label", "cavity_value"}) {
    add_scene_option(*command, arguments->scene, "register", name)->needs(wall);
  }
  command->add_option("--landmarks", job.landmarks, "markups to move")->type_name("FILE");
  command->add_option("--warp", job.warp, "another image, surface or file of points to move; again for each")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--warp-labels", job.warp_labels, "another label map to move; again for each")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
  for (const char* name : {"fade", "interpolation", "inverse_tolerance", "device"}) {
    add_scene_option(*command, arguments->scene, "register", name);
  }
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { register_images(*arguments, settings); });
}

}  // namespace brainshift::pipelines
