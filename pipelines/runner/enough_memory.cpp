// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/enough_memory.hpp"

#include <stdexcept>
#include <string>

#include "pipelines/scene/stage_memory.hpp"
#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {
namespace {

std::string gigabytes(double mb) {
  return with_decimals(mb * 1024 * 1024 / 1e9);
}

std::string millions(double count) {
  return with_decimals(count / 1e6) + " million";
}

/// What the stage's memory grows with, and how to have less of it.
std::string what_to_do(StageId stage, const Scene& scene, const RunSize& size) {
  if (stage == StageId::solve) {
    return "about " + millions(size.solve.nodes) +
           " nodes; take fewer (discretise.nodes), or a machine with more memory";
  }
  const auto& file = scene.image.t1.empty() ? scene.image.labels : scene.image.t1;
  return millions(size.voxels) + " voxels of " + file.string() +
         "; crop the image to the head, resample it to coarser voxels, or take a machine with more memory";
}

}  // namespace

void require_memory(const Scene& scene, StageId from, StageId until, double available_mb) {
  constexpr double most_above = 1.5;
  const RunSize size = declared_run_size(scene);
  for (const StageId stage : all_stages) {
    if (stage < from || stage > until || !is_active(stage, scene) || !is_ours(scene, stage)) {
      continue;
    }
    const double most = stage_memory(stage, scene, size).value_or(0);
    if (most / most_above > available_mb) {
      throw std::runtime_error(std::string(stage_name(stage)) + " needs " + gigabytes(most / most_above) + " to " +
                               gigabytes(most) + " GB of memory, and " + gigabytes(available_mb) +
                               " GB can be had: it is to hold " + what_to_do(stage, scene, size));
    }
  }
}

}  // namespace brainshift::pipelines
