// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/jobs.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "pipelines/runner/image_warnings.hpp"
#include "pipelines/runner/job_files.hpp"
#include "pipelines/runner/measures.hpp"
#include "segmentation/body/brain_body.hpp"
#include "segmentation/files/naming.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/image/read_mask.hpp"
#include "segmentation/septa/septa.hpp"
#include "segmentation/surface/resection_wall.hpp"

namespace brainshift::pipelines {
namespace fs = std::filesystem;
namespace {

std::optional<LabelMap> mask_if(const fs::path& file, std::vector<std::string>& notes) {
  if (file.empty()) {
    return std::nullopt;
  }
  ReadMask mask = read_mask_and_warning(file);
  if (!mask.warning.empty()) {
    notes.push_back(mask.warning);
  }
  return std::move(mask.map);
}

/// A tumour's map as a mask: of BraTS's numbers the tumour without its oedema.
std::optional<LabelMap> tumour_if(const fs::path& file, std::vector<std::string>& notes) {
  auto tumour = labels_if(file);
  if (tumour) {
    const auto volumes = segmentation::label_volumes(*tumour);
    const bool brats = volumes.contains(2) && volumes.contains(1) + volumes.contains(3) + volumes.contains(4) > 0;
    if (brats) {
      notes.push_back(file.string() + ": taken for BraTS's numbers, so that 2 (" +
                      segmentation::in_millilitres(volumes.at(2)) +
                      ") is oedema and no tumour; if it is a tumour, renumber it");
    }
    for (std::uint16_t& voxel : tumour->voxels) {
      voxel = voxel != 0 && !(brats && voxel == 2) ? 1 : 0;
    }
  }
  return tumour;
}

/// On the T1's grid a map whose own field of view cuts the brain off has no border any more.
void note_cut(const LabelMap& map, const fs::path& file, const std::vector<std::uint16_t>& brain,
              const std::optional<ScalarImage>& t1, std::vector<std::string>& notes) {
  if (!t1 || same_geometry(map.geometry, t1->geometry)) {
    return;
  }
  const Mask tissue = brain.empty() ? mask_of(map) : mask_of(map, brain);
  if (const auto cut = segmentation::border_cut(tissue, &t1->geometry); cut.off) {
    notes.push_back(segmentation::cut_sentence(cut, "the border of " + file.string() + ", within the T1,"));
  }
}

/// Takes a map to the reference's grid, and says so. `counted`: the labels that must lie within it, all when empty.
void take_to_grid(std::optional<LabelMap>& map, const fs::path& file, const ImageGeometry& grid,
                  const fs::path& grid_file, std::vector<std::string>& notes,
                  const std::vector<std::uint16_t>& counted = {}) {
  if (!map || same_geometry(map->geometry, grid)) {
    return;
  }
  LabelMap inner = *map;
  for (std::uint16_t& voxel : inner.voxels) {
    voxel = counted.empty() || std::find(counted.begin(), counted.end(), voxel) != counted.end() ? voxel : 0;
  }
  if (const double share = share_within(inner, grid); share < 0.5) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(static_cast<int>(100 * share)) +
                                " % of it lie within " + grid_file.string() + " (" + described(map->geometry) +
                                " against " + described(grid) +
                                "); are they of one patient and one frame? Register one to the other first");
  }
  *map = on_grid(*map, grid);
  notes.push_back(file.string() + ": lies on another grid than " + grid_file.string() +
                  "; taken to it, the nearest label at each voxel");
}

/// The number that a tumour of its own file gets may be another tissue's, where a map has numbers of its own.
void note_both_tumours(const LabelMap& labels, const LabelMap& tumour, const SegmentJob& job, const fs::path& file,
                       std::vector<std::string>& notes) {
  constexpr double worth_saying = 0.2;  // of the file's tumour: two hands do not draw the same outline
  std::size_t both = 0, beside = 0;
  for (std::size_t i = 0; i < labels.voxels.size(); ++i) {
    const bool same = labels.voxels[i] == segmentation::default_label::tumour;
    both += tumour.voxels[i] != 0 ? 1 : 0;
    beside += same && tumour.voxels[i] == 0 ? 1 : 0;
  }
  if (both == 0) {
    notes.push_back("warning: " + file.string() + ": no voxel is tumour there");
  } else if (static_cast<double>(beside) > worth_saying * static_cast<double>(both)) {
    const double voxel = labels.geometry.spacing.prod();
    notes.push_back("warning: " + std::string(job.reading.by_class ? "the tumour" : "label 3") + " of " +
                    job.image.labels.string() + " holds " +
                    segmentation::in_millilitres(static_cast<double>(beside) * voxel) + " outside the tumour of " +
                    file.string() + ", of " + segmentation::in_millilitres(static_cast<double>(both) * voxel) +
                    ", and all of it counts as tumour" +
                    (job.reading.by_class ? "; give one of the two if that is wrong"
                                          : "; if it is another tissue, give it another number"));
  }
}

/// What a table told of the labels, as the stage's options.
void set_classes(const LabelMap& labels, bool tumour, segmentation::SegmentOptions& options) {
  namespace label = segmentation::default_label;
  const auto volumes = segmentation::label_volumes(labels);
  options.brain_labels.clear();
  for (const std::uint16_t number : {label::parenchyma, label::ventricles, label::tumour}) {
    if (volumes.contains(number) || (tumour && number == label::tumour)) {
      options.brain_labels.push_back(number);
    }
  }
  options.fluid_label = label::csf;
  options.skull_label = volumes.contains(label::skull) ? std::optional(label::skull) : std::nullopt;
  // Of eight heads and FreeSurfer's, 3 mm is the least that leaves no fold; more takes in more of the fluid outside.
  constexpr double radius = 4;
  options.closing = options.closing.value_or(radius);
}

/// From the numbers as the map has them: classes do not tell left from right.
void write_septa(const fs::path& labels, const fs::path& file, StageReport& said) {
  const Surface septa = naming(labels.string(), [&] { return segmentation::septa_of(read_label_map(labels)); });
  write_surface(file, septa);
  said.measures["septa_area_mm2"] = area(septa);
}

void write_wall(const std::vector<std::uint16_t>& resected, const LabelMap& labels,
                const segmentation::SegmentOptions& options, const fs::path& file, StageReport& said) {
  const segmentation::MeasuredSurface wall =
      segmentation::resection_wall(labels, options.brain_labels, resected, options.edge_length);
  write_surface(file, wall.surface);
  said.measures["resection_wall"] = {{"area_mm2", area(wall.surface)},
                                     {"volume_mm3", wall.measures.volume},
                                     {"boundary_distance_95_mm", wall.measures.boundary_distance_95}};
}

const fs::path& tumour_file(const SegmentJob& job) {
  return job.image.tumour.empty() ? job.image.tumour_mask : job.image.tumour;
}

/// The files as they are; what a table told of the labels goes to the options.
segmentation::SegmentInput read_files(const SegmentJob& job, segmentation::SegmentOptions& options,
                                      std::vector<std::string>& notes) {
  segmentation::SegmentInput input;
  if (!job.image.t1.empty()) {
    input.t1 = read_image(job.image.t1);
  }
  if (!job.image.labels.empty()) {
    ReadLabels read = read_labels(job.image, job.reading);
    input.labels = std::move(read.map);
    notes = std::move(read.notes);
  }
  input.brain_mask = mask_if(job.image.brain_mask, notes);
  input.tumour_mask =
      job.image.tumour.empty() ? mask_if(job.image.tumour_mask, notes) : tumour_if(job.image.tumour, notes);
  if (!job.image.surface.empty()) {
    input.surface = read_surface(job.image.surface);
  }
  if (input.labels && job.reading.by_class) {
    set_classes(*input.labels, input.tumour_mask.has_value(), options);
  }
  return input;
}

/// Takes all maps to one grid, that of the T1 if there is one.
void take_together(const SegmentJob& job, const segmentation::SegmentOptions& options,
                   segmentation::SegmentInput& input, std::vector<std::string>& notes) {
  if (input.labels) {
    note_cut(*input.labels, job.image.labels, options.brain_labels, input.t1, notes);
  } else if (input.brain_mask) {
    note_cut(*input.brain_mask, job.image.brain_mask, {}, input.t1, notes);
  }
  if (input.t1) {
    take_to_grid(input.labels, job.image.labels, input.t1->geometry, job.image.t1, notes, options.brain_labels);
    take_to_grid(input.brain_mask, job.image.brain_mask, input.t1->geometry, job.image.t1, notes);
    take_to_grid(input.tumour_mask, tumour_file(job), input.t1->geometry, job.image.t1, notes);
  } else if (input.labels) {
    take_to_grid(input.tumour_mask, tumour_file(job), input.labels->geometry, job.image.labels, notes);
  }
}

}  // namespace

StageReport run_job(const SegmentJob& job, const fs::path& out, const Progress& progress) {
  segmentation::SegmentOptions options = job.options;
  std::vector<std::string> notes;
  report(progress, 0, "reading");
  segmentation::SegmentInput input = read_files(job, options, notes);
  take_together(job, options, input, notes);
  if (input.labels && input.tumour_mask) {
    note_both_tumours(*input.labels, *input.tumour_mask, job, tumour_file(job), notes);
  }
  std::ranges::copy(
      frame_warnings({job.image.t1, job.image.labels, job.image.brain_mask, job.image.tumour, job.image.tumour_mask}),
      std::back_inserter(notes));
  if (input.t1 && input.labels) {
    for (const std::string& warning : warnings_of(*input.t1, *input.labels, options.brain_labels)) {
      notes.push_back("warning: " + warning);
    }
  }
  const fs::path& file = input.labels ? job.image.labels : input.surface ? job.image.surface : job.image.brain_mask;
  const segmentation::Segmentation result =
      naming(file.string(), [&] { return segmentation::segment(input, options, progress); });
  segmentation::write_segmentation(out, result);
  StageReport stage = report_of(result);
  if (job.septa) {
    write_septa(job.image.labels, out / "septa.vtp", stage);
  }
  if (!job.resected.empty() && result.labels) {
    naming(file.string(), [&] { write_wall(job.resected, *result.labels, options, out / "resection.vtp", stage); });
  }
  stage.notes.insert(stage.notes.begin(), notes.begin(), notes.end());
  return stage;
}

}  // namespace brainshift::pipelines
