// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_parts.hpp"

#include <set>
#include <stdexcept>

#include "pipelines/scene/scene_fault.hpp"
#include "segmentation/septa/septa.hpp"
#include "solve/cut/septum.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/region/region.hpp"
#include "solve/run/measured.hpp"
#include "solve/uncertainty/draw.hpp"
#include "solve/uncertainty/sample.hpp"

namespace brainshift::pipelines {
namespace {

void check_cuts(const Scene& scene) {
  if (!scene.cuts) {
    return;
  }
  if (scene.cuts->files.empty()) {
    fail(scene, "cuts", "<cuts> names no cut; name one, as <cut file=\"sheet.vtp\"/>, or leave <cuts> out");
  }
  for (std::size_t i = 0; i < scene.cuts->files.size(); ++i) {
    check_at(scene, "cuts." + std::to_string(i + 1), [&] { read_cut(scene.cuts->files[i], solve::Plane::none); });
  }
}

void check_septa(const Scene& scene) {
  if (scene.septa && scene.septum) {
    fail(scene, "septum", "there are both <septa>, from the label map, and <septum>, from a file; give one of them");
  }
  if (scene.septa && scene.image.labels.empty()) {
    fail(scene, "septa",
         "<septa> needs a label map with FreeSurfer's numbers, and the <image> names no labels; name them, or give the "
         "sheet, as <septum file=\"falx.vtp\"/>");
  }
  if (scene.septa && is_ours(scene, StageId::segment)) {
    check_at(scene, "septa", [&] { segmentation::septa_of(read_label_map(scene.image.labels)); });
  }
  if (scene.septum) {
    check_at(scene, "septum", [&] { solve::read_septum(scene.septum->file); });
  }
}

/// A model with the scene's parts, and nothing in them.
solve::Model parts_of(const Scene& scene) {
  solve::Model model;
  model.gravity = scene.loading.gravity;
  if (scene.gravity) {
    model.fluid.emplace();
  }
  model.resection = scene.resection;
  model.cuts.resize(scene.cuts ? 1 : 0);
  if (scene.septa || scene.septum) {
    model.septum.emplace();
  }
  return model;
}

void check_uncertainty(const Scene& scene) {
  if (scene.uncertainty->share > scene.uncertainty->shares) {
    throw std::invalid_argument("share is " + std::to_string(scene.uncertainty->share) + " of " +
                                std::to_string(scene.uncertainty->shares) + " shares; count from 1 to shares");
  }
  const solve::Model parts = parts_of(scene);
  solve::check_sampled(parts, scene.solve);
  if (!solve::varies(parts, *scene.uncertainty) && !(scene.load && has_noise(*scene.load))) {
    throw std::invalid_argument(
        "nothing of the scene is uncertain: the load has no noise and all constants are known; give <load> a noise, or "
        "one of stiffness, poisson, gravity_angle and fluid_level more than 0, or leave <uncertainty> out");
  }
}

}  // namespace

bool has_noise(const Load& load) {
  return load.noise || (load.craniotomy && solve::read_craniotomy_csv(*load.craniotomy).sigma.rows() > 0);
}

void check_parts(const Scene& scene) {
  check_cuts(scene);
  check_septa(scene);
  check_resection(scene);
  if (scene.load) {
    const bool noisy = has_noise(*scene.load);
    const auto need_noise = [&](bool asked, const std::string& option, const std::string& text) {
      if (asked && !noisy) {
        fail(
            scene, "load." + option,
            text + " needs to know how well the points were measured; give <load> a noise, or the file a column sigma");
      }
    };
    need_noise(scene.load->robust, "robust", "robust=\"yes\"");
    need_noise(scene.load->registration_unknown, "registration", "an unknown registration");
    need_noise(scene.load->weight > 0, "weight", "a weight");
    if (noisy) {
      check_at(scene, "load", [&] { solve::check_measured(parts_of(scene), scene.solve); });
    }
  }
  if (scene.uncertainty) {
    check_at(scene, "uncertainty", [&] { check_uncertainty(scene); });
  }
}

void check_region(const Scene& scene) {
  check_at(scene, "solve.region", [&] { solve::check_region(parts_of(scene), scene.solve); });
}

void check_resection(const Scene& scene) {
  if (!scene.resection) {
    return;
  }
  std::set<std::int32_t> left;
  for (const Tissue& tissue : scene.tissues) {
    left.insert(tissue.label);
  }
  const std::string labels = write_numbers(left);
  if (scene.resection->labels.empty()) {
    fail(scene, "resection.labels", "the resection names no label; the tissues' labels are " + labels);
  }
  for (const std::int32_t label : scene.resection->labels) {
    if (left.erase(label) == 0) {
      fail(scene, "resection.labels",
           "the resection names label " + std::to_string(label) +
               ", which no tissue has or which is named twice; the tissues' labels are " + labels);
    }
  }
  if (left.empty()) {
    fail(scene, "resection.labels", "the resection takes out every tissue (" + labels + "); leave one");
  }
  if (scene.resection->fluid_level && !scene.gravity) {
    fail(scene, "resection.fluid_level",
         "the fluid in the cavity has a level, but nothing says which way gravity pulls it; name <gravity> with the "
         "level of the fluid about the brain");
  }
}

}  // namespace brainshift::pipelines
