// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {
namespace {

struct SegmentArguments {
  Scene scene;
  std::vector<std::int16_t> brain_labels = segmentation::SegmentOptions{}.brain_labels;
  std::filesystem::path out;
};

void segment(const SegmentArguments& arguments, const Settings& settings) {
  SegmentJob job{arguments.scene.image, arguments.scene.segment};
  job.options.brain_labels = arguments.brain_labels;
  job.options.skull_label = arguments.scene.image.skull_label;
  run_single_stage(StageId::segment, arguments.out, settings,
                   [&](const auto& folder, const Progress& progress) { return run_job(job, folder, progress); });
}

}  // namespace

void add_segment_command(CLI::App& program, const Settings& settings) {
  CLI::App* command =
      program.add_subcommand("segment", "Labels, or a T1 with a brain mask, or a surface, to surfaces.");
  auto arguments = std::make_shared<SegmentArguments>();
  for (const char* name : {"t1", "labels", "brain_mask", "tumour_mask", "surface", "skull_label"}) {
    add_scene_option(*command, arguments->scene, "image", name);
  }
  for (const char* name : {"edge_length", "classes", "ventricle_depth"}) {
    add_scene_option(*command, arguments->scene, "segment", name);
  }
  command->add_option("--brain-labels", arguments->brain_labels, "labels that are tissue of the brain")
      ->check(CLI::Range(static_cast<int>(label_numbers.low), static_cast<int>(label_numbers.high)))
      ->capture_default_str();
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { segment(*arguments, settings); });
}

}  // namespace brainshift::pipelines
