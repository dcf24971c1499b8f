// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_scene.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "discretise/interface/option_table.hpp"
#include "pipelines/scene/check_uncertainty.hpp"
#include "pipelines/scene/scene_labels.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "register/field/brain_zones.hpp"
#include "register/interface/option_table.hpp"
#include "segmentation/interface/option_table.hpp"
#include "segmentation/labels/label_table.hpp"
#include "segmentation/septa/septa.hpp"
#include "solve/cut/septum.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/material/check_material.hpp"
#include "solve/quadrature/cell_points.hpp"
#include "solve/region/region.hpp"

namespace brainshift::pipelines {
namespace {

/// Without a scene's file the options are those of a command.
[[noreturn]] void fail(const Scene& scene, const std::string& path, const std::string& what) {
  throw std::invalid_argument(scene.source.file.empty() ? what : place(scene.source, path) + ": " + what);
}

/// Runs a check of the library; the place in the scene comes before its message.
template <class Check>
void check_at(const Scene& scene, const std::string& path, const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    fail(scene, path, error.what());
  }
}

void check_files(const Scene& scene) {
  for (const Element& element : scene_elements()) {
    if (!element.present(scene)) {
      continue;
    }
    for (const auto& option : element.options) {
      const std::string path = element.path + "." + option.name;
      const std::string file = option.get(scene);
      if (option.is_path && file.empty() && option.required) {
        fail(scene, path, path + " is empty; it must name a file");
      }
      if (!names_file(option, file)) {
        continue;
      }
      std::error_code fault;
      const auto status = std::filesystem::status(file, fault);
      if (status.type() == std::filesystem::file_type::not_found) {
        fail(scene, path, path + " names the file " + file + ", which does not exist");
      }
      if (fault) {
        fail(scene, path, path + " names the file " + file + ", which cannot be reached (" + fault.message() + ")");
      }
    }
  }
}

bool is_ours(const Scene& scene, StageId stage) {
  return scene.commands[index_of(stage)].empty();
}

void check_image(const Scene& scene) {
  const ImageInputs& image = scene.image;
  const int sources = int{!image.labels.empty()} + int{!image.brain_mask.empty()} + int{!image.surface.empty()};
  if (is_ours(scene, StageId::segment) && sources != 1) {
    fail(scene, "image",
         "<image> names " + std::to_string(sources) +
             " of labels, brain_mask and surface; give exactly one, a brain_mask together with a t1");
  }
  if (!image.labels_are.empty() && label_reading(scene).by_class != !image.labels.empty()) {
    fail(scene, "image.labels_are",
         "labels_are says what the label map's numbers are, so tissues are named by class, not by label");
  }
  if (!image.tumour.empty() && !image.tumour_mask.empty()) {
    fail(scene, "image.tumour", "<image> names a tumour and a tumour_mask; give one of them");
  }
  if (!image.brain_mask.empty() && image.t1.empty()) {
    fail(scene, "image", "<image> has a brain_mask but no t1; the tissues are classified from the t1");
  }
}

/// Of a scene without <load>.
void need_something_to_move(const Scene& scene) {
  const bool swells = std::any_of(scene.tissues.begin(), scene.tissues.end(),
                                  [](const Tissue& tissue) { return tissue.material.swelling != 0; });
  if (!scene.gravity && scene.loading.gravity.isZero() && !swells) {
    fail(scene, "load",
         "the scene has no <load>: nothing would move; name one, as <load><craniotomy file=\"...\"/></load>");
  }
  if (!scene.contact) {
    fail(scene, "load",
         "the scene has neither <load> nor <contact>: nothing would hold the brain against " +
             std::string(swells ? "its swelling" : "gravity") + "; add <contact/>");
  }
}

void check_load(const Scene& scene) {
  if (!scene.load) {
    if (is_ours(scene, StageId::discretise)) {
      need_something_to_move(scene);
    }
    return;
  }
  const Load& load = *scene.load;
  const int parts = int{load.craniotomy.has_value()} + int{load.markups.has_value()} + int{load.surfaces.has_value()} +
                    int{load.simulated.has_value()};
  if (parts != 1) {
    fail(
        scene, "load",
        "<load> has " + std::to_string(parts) + " parts; give exactly one of craniotomy, markups, surfaces, simulated");
  }
}

/// What would be found late, when stages that took long are done: files are read as their stage will read them.
void check_late_files(const Scene& scene) {
  if (scene.load && scene.load->craniotomy) {
    check_at(scene, "load.craniotomy", [&] { solve::read_craniotomy_csv(*scene.load->craniotomy); });
  }
  if (scene.load && scene.load->markups) {
    check_at(scene, "load.markups",
             [&] { solve::read_markups(scene.load->markups->before, scene.load->markups->after); });
  }
  if (scene.landmarks) {
    check_at(scene, "landmarks", [&] { solve::read_markup_positions(*scene.landmarks); });
  }
  if (!scene.image.t1.empty() && is_ours(scene, StageId::registration)) {
    check_at(scene, "image.t1",
             [&] { registration::check_fade(scene.registration.fade, read_image(scene.image.t1).geometry); });
  }
}

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

void check_options(const Scene& scene) {
  check_at(scene, "segment", [&] { segmentation::check_options(scene.segment); });
  check_at(scene, "discretise", [&] { discretise::check_options(scene.discretise); });
  check_at(scene, "register", [&] { registration::check_options(scene.registration); });
  if (scene.refinement.factor < 1 && !scene.load) {
    fail(scene, "discretise.craniotomy_factor", "discretise.craniotomy_factor needs a <load> to refine towards");
  }
  if (is_ours(scene, StageId::discretise) && scene.solve.points_per_cell) {
    check_at(scene, "solve.points_per_cell",
             [&] { solve::check_points_per_cell(scene.discretise.cells, *scene.solve.points_per_cell); });
  }
}

/// What of the scene a region of the body cannot do.
void check_region(const Scene& scene) {
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
  check_at(scene, "solve.region", [&] { solve::check_region(model, scene.solve); });
}

std::set<std::uint16_t> labels_in(const LabelMap& map) {
  std::set<std::uint16_t> labels;
  for (const auto& [label, volume] : segmentation::label_volumes(map)) {
    labels.insert(label);
  }
  return labels;
}

/// The labels that the segment stage will give: of the map, with the numbers that tissues join, of the classes, or
/// tissue 1 of a bare surface.
std::set<std::uint16_t> labels_to_come(const Scene& scene) {
  namespace label = segmentation::default_label;
  std::set<std::uint16_t> labels = {label::parenchyma};
  if (!scene.image.labels.empty()) {
    labels = labels_in(read_labels(scene.image, label_reading(scene)).map);
  } else if (!scene.image.brain_mask.empty()) {
    labels.insert({label::ventricles, label::csf});
  }
  if (!scene.image.tumour_mask.empty() || !scene.image.tumour.empty()) {
    labels.insert(label::tumour);
  }
  return labels;
}

std::string listed(const std::set<std::uint16_t>& labels) {
  return labels.empty() ? "none" : write_numbers(labels);
}

bool by_class(const Tissue& tissue) {
  return tissue.tissue_class != 0;
}

/// Of tissues named by class.
void check_classes(const Scene& scene) {
  if (!std::all_of(scene.tissues.begin(), scene.tissues.end(), by_class)) {
    fail(scene, "tissues", "some tissues are named by class, others by label; name all of them in one way");
  }
  if (!scene.image.labels.empty()) {
    check_at(scene, "image.labels", [&] { read_labels(scene.image, label_reading(scene)); });
  }
}

void check_tissues(const Scene& scene) {
  if (scene.tissues.empty()) {
    fail(scene, "tissues", "the scene has no <tissues>; name a tissue with its material for each label of the brain");
  }
  for (const Tissue& tissue : scene.tissues) {
    check_at(scene, "tissues." + std::to_string(tissue.label), [&] { check_material(tissue); });
  }
  if (!is_ours(scene, StageId::segment)) {
    return;
  }
  if (std::any_of(scene.tissues.begin(), scene.tissues.end(), by_class)) {
    check_classes(scene);
    return;
  }
  const std::set<std::uint16_t> labels = labels_to_come(scene);
  const bool lists = std::any_of(scene.tissues.begin(), scene.tissues.end(),
                                 [](const Tissue& tissue) { return !tissue.labels.empty(); });
  const std::string source = scene.image.labels.empty() ? "the segmentation" : scene.image.labels.string();
  std::set<std::uint16_t> named(scene.image.other_labels.begin(), scene.image.other_labels.end());
  for (const Tissue& tissue : scene.tissues) {
    if (!labels.contains(tissue.label)) {
      fail(scene, "tissues." + std::to_string(tissue.label),
           "tissue " + std::to_string(tissue.label) + " is not in " + source + ", whose labels are " + listed(labels) +
               "; remove the tissue or correct its label");
    }
    named.insert(tissue.label);
  }
  for (const std::uint16_t label : labels) {
    if (!named.contains(label) && !lists) {
      fail(
          scene, "tissues",
          "label " + std::to_string(label) + " of " + source +
              " has no material; give it a <tissue>, or list it in the image's other_labels if it is not of the brain");
    }
  }
  const auto skull = scene.image.skull_label;
  if (skull && !labels.contains(*skull)) {
    fail(scene, "image.skull_label",
         "skull_label " + std::to_string(*skull) + " is not in " + source + ", whose labels are " + listed(labels));
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  check_files(scene);
  check_image(scene);
  check_load(scene);
  check_options(scene);
  check_solve_options(scene);
  check_tissues(scene);
  check_cuts(scene);
  check_septa(scene);
  check_resection(scene);
  check_late_files(scene);
  if (scene.uncertainty) {
    check_at(scene, "uncertainty", [&] { check_uncertainty(scene); });
  }
}

void check_solve_options(const Scene& scene) {
  check_at(scene, "solve", [&] { solve::check_options(scene.solve); });
  const Loading& loading = scene.loading;
  if (!loading.curve.empty() && loading.duration) {
    fail(scene, "solve.duration",
         "there are both a duration and a curve for the load; the curve " + loading.curve.string() +
             " says how long it takes: give one of them");
  }
  if (loading.curve.empty() && loading.curve_join != solve::LoadCurve::Join::smooth) {
    fail(scene, "solve.curve_join", "curve_join is straight, but there is no curve whose rows it would join");
  }
  if (scene.solve.dynamics == solve::Dynamics::relaxation) {
    const std::pair<const char*, bool> in_time_only[] = {{"time_step", scene.solve.time_step != 0},
                                                         {"damping", scene.solve.damping != 0},
                                                         {"duration", loading.duration.has_value()}};
    for (const auto& [name, given] : in_time_only) {
      if (given) {
        fail(scene, std::string("solve.") + name,
             std::string(name) +
                 " is given, but dynamics is relaxation, which has no time; leave it out, or set "
                 "dynamics to transient");
      }
    }
  }
  if (scene.gravity) {
    check_at(scene, "gravity", [&] { check_gravity(*scene.gravity); });
    if (!loading.gravity.isZero()) {
      fail(scene, "solve.gravity", "there are both <gravity> and solve.gravity, the whole weight; give one of them");
    }
  }
  if (scene.solve.region > 0) {
    check_region(scene);
  }
  load_curve(loading);
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
}

void check_material(const Tissue& tissue) {
  const std::string name = "the material of label " + std::to_string(tissue.label);
  if (tissue.material.law != solve::Law::ogden && !tissue.material.ogden.empty()) {
    throw std::invalid_argument(name + " has the Ogden terms " + find_option(tissue_options(), "ogden")->get(tissue) +
                                " but follows the law " + find_option(tissue_options(), "law")->get(tissue) +
                                "; set the law to ogden, or ogden to nothing");
  }
  solve::check_material(name, tissue.material);
}

}  // namespace brainshift::pipelines
