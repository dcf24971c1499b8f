// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <stdexcept>

#include "pipelines/commands/commands.hpp"
#include "segmentation/image/segments.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {
namespace {

struct SegmentArguments {
  Scene scene;
  std::vector<std::uint16_t> brain_labels;
  std::filesystem::path out;
};

void segment(const SegmentArguments& arguments, const Settings& settings) {
  SegmentJob job{arguments.scene.image, arguments.scene.segment};
  const ImageInputs& image = job.image;
  const bool own_numbers = !arguments.brain_labels.empty() || image.skull_label.has_value();
  if (own_numbers && !image.labels_are.empty()) {
    throw std::invalid_argument(
        "--labels-are says what the label map's numbers are; leave --brain-labels and --skull-label out");
  }
  if (!arguments.brain_labels.empty()) {
    job.options.brain_labels = arguments.brain_labels;
  }
  // Segments whose names do not tell are refused as such: they are not this program's numbers.
  job.reading.by_class =
      !image.labels.empty() && !own_numbers && (classes_are_told(image) || !read_segments(image.labels).empty());
  job.options.skull_label = arguments.scene.image.skull_label;
  run_single_stage(StageId::segment, arguments.out, settings,
                   [&](const auto& folder, const Progress& progress) { return run_job(job, folder, progress); });
}

}  // namespace

void add_segment_command(CLI::App& program, const Settings& settings) {
  CLI::App* command =
      program.add_subcommand("segment", "Labels, or a T1 with a brain mask, or a surface, to surfaces.");
  auto arguments = std::make_shared<SegmentArguments>();
  for (const char* name :
       {"t1", "labels", "labels_are", "brain_mask", "tumour_mask", "tumour", "surface", "skull_label"}) {
    add_scene_option(*command, arguments->scene, "image", name);
  }
  add_stage_options(*command, arguments->scene, "segment");
  command
      ->add_option("--brain-labels", arguments->brain_labels,
                   "labels that are tissue of the brain; 1 2 3 where no table tells the labels")
      ->check(CLI::Range(static_cast<int>(label_numbers.low), static_cast<int>(label_numbers.high)));
  command->add_option("--out", arguments->out, "folder for the artefacts")->required()->type_name("DIR");
  command->callback([arguments, &settings] { segment(*arguments, settings); });
}

}  // namespace brainshift::pipelines
