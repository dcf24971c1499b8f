// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "discretise/interface/option_table.hpp"
#include "pipelines/commands/commands.hpp"

namespace brainshift::pipelines {
namespace {

struct DiscretiseArguments {
  Scene scene;
  DiscretiseJob job;
  std::filesystem::path craniotomy;
  std::filesystem::path out;
};

void discretise(const DiscretiseArguments& arguments, const Settings& settings) {
  DiscretiseJob job = arguments.job;
  const auto brain_labels = job.options.brain_labels;
  job.options = arguments.scene.discretise;
  job.options.brain_labels = brain_labels;
  job.refinement = arguments.scene.refinement;
  discretise::check_options(job.options);
  if (!arguments.craniotomy.empty()) {
    job.load = Load{};
    job.load->craniotomy = arguments.craniotomy;
  }
  run_single_stage(StageId::discretise, arguments.out, settings,
                   [&](const auto& folder, const Progress& progress) { return run_job(job, folder, progress); });
}

}  // namespace

void add_discretise_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("discretise", "A closed surface to nodes and background cells.");
  auto arguments = std::make_shared<DiscretiseArguments>();
  command->add_option("--surface", arguments->job.surface, "the brain's closed surface")->required()->type_name("FILE");
  command->add_option("--labels", arguments->job.labels, "label map; without it all is tissue 1")->type_name("FILE");
  command->add_option("--brain-labels", arguments->job.options.brain_labels, "labels that are tissue of the brain")
      ->check(CLI::Range(static_cast<int>(label_numbers.low), static_cast<int>(label_numbers.high)))
      ->capture_default_str();
  command->add_option("--craniotomy", arguments->craniotomy, "craniotomy.csv: where nodes are finer")
      ->type_name("FILE");
  add_stage_options(*command, arguments->scene, "discretise");
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { discretise(*arguments, settings); });
}

}  // namespace brainshift::pipelines
