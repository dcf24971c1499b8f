// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/check_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "discretise/interface/option_table.hpp"
#include "pipelines/scene/check_parts.hpp"
#include "pipelines/scene/check_tissues.hpp"
#include "pipelines/scene/field_load.hpp"
#include "pipelines/scene/scene_fault.hpp"
#include "pipelines/scene/scene_labels.hpp"
#include "pipelines/scene/scene_table.hpp"
#include "register/field/brain_zones.hpp"
#include "register/interface/option_table.hpp"
#include "segmentation/interface/option_table.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/quadrature/cell_points.hpp"

namespace brainshift::pipelines {
namespace {

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
  for (const char* own : {"skull_label", "other_labels"}) {
    if (const std::string path = std::string("image.") + own;
        scene.source.lines.contains(path) && label_reading(scene).by_class) {
      fail(scene, path,
           path + " is a number of the label map, but its tissues are named by class: " + own +
               " would say nothing; leave it out, or name a <tissue> for each label");
    }
  }
  if (!image.tumour.empty() && !image.tumour_mask.empty()) {
    fail(scene, "image.tumour", "<image> names a tumour and a tumour_mask; give one of them");
  }
  if (!image.brain_mask.empty() && image.t1.empty()) {
    fail(scene, "image", "<image> has a brain_mask but no t1; the tissues are classified from the t1");
  }
}

bool swells(const Scene& scene) {
  return std::any_of(scene.tissues.begin(), scene.tissues.end(),
                     [](const Tissue& tissue) { return tissue.material.swelling != 0; });
}

bool is_pulled(const Scene& scene) {
  return scene.gravity || !scene.loading.gravity.isZero();
}

bool is_pressed(const Scene& scene) {
  return scene.resection && scene.resection->pressure != 0;
}

std::string what_moves(const Scene& scene) {
  return swells(scene) ? "its swelling" : is_pulled(scene) ? "gravity" : "the pressure in the cavity";
}

/// Of a scene without <load>.
void need_something_to_move(const Scene& scene) {
  if (!is_pulled(scene) && !swells(scene) && !is_pressed(scene)) {
    fail(scene, "load",
         "the scene has no <load>: nothing would move; name one, as <load><craniotomy file=\"...\"/></load>");
  }
  if (!scene.contact) {
    fail(scene, "load",
         "the scene has neither <load> nor <contact>: nothing would hold the brain against " + what_moves(scene) +
             "; add <contact/>");
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
                    int{load.field.has_value()} + int{load.simulated.has_value()};
  if (parts != 1) {
    fail(scene, "load",
         "<load> has " + std::to_string(parts) +
             " parts; give exactly one of craniotomy, markups, surfaces, field, simulated");
  }
  if (load.robust && load.field) {
    fail(
        scene, "load.robust",
        "robust=\"yes\" is of single points, and the load is a <field>, whose faults are alike at neighbours; leave it "
        "out");
  }
  if (load.robust && load.registration_unknown) {
    fail(
        scene, "load.robust",
        "robust=\"yes\" does not go with registration=\"unknown\": where the patient lies is not known yet, all points "
        "may contradict the brain; leave the one or the other out");
  }
  if ((is_pulled(scene) || swells(scene)) && (load.robust || load.registration_unknown)) {
    fail(scene, load.robust ? "load.robust" : "load.registration",
         std::string(load.robust ? "robust=\"yes\"" : "registration=\"unknown\"") +
             " does not go with gravity or swelling: what these move would count as " +
             (load.robust ? "points that contradict the others" : "the tracker's error") +
             "; leave the one or the other out");
  }
  if (load.field && load.registration_unknown) {
    fail(scene, "load.registration",
         "registration=\"unknown\" is of points that a tracker measured, and the load is a <field>, which goes from "
         "image to image; leave it out");
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
  if (scene.load && scene.load->field) {
    check_at(scene, "load.field", [&] { check_field_load(*scene.load->field); });
  }
  if (scene.landmarks) {
    check_at(scene, "landmarks", [&] { solve::read_markup_positions(*scene.landmarks); });
  }
  if (!scene.image.t1.empty() && is_ours(scene, StageId::registration)) {
    check_at(scene, "image.t1",
             [&] { registration::check_fade(scene.registration.fade, read_image(scene.image.t1).geometry); });
  }
}

void check_options(const Scene& scene) {
  check_at(scene, "segment", [&] { segmentation::check_options(scene.segment); });
  check_at(scene, "discretise", [&] { discretise::check_options(scene.discretise); });
  check_at(scene, "register", [&] { registration::check_options(scene.registration); });
  if (is_ours(scene, StageId::discretise) && scene.solve.points_per_cell) {
    check_at(scene, "solve.points_per_cell",
             [&] { solve::check_points_per_cell(scene.discretise.cells, *scene.solve.points_per_cell); });
  }
}

/// A fault of a state stands where its element is written, which may be before the sequence.
void check_states(const Scene& scene) {
  if (scene.solve.dynamics == solve::Dynamics::transient) {
    fail(scene, "solve.dynamics",
         "dynamics is transient, but a <sequence> goes from one state of rest to the next; take relaxation");
  }
  for (const Scene& state : scene.states) {
    try {
      check_scene(state);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string(error.what()) + " (state '" + state.state->name + "')");
    }
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  if (!scene.states.empty()) {
    check_states(scene);
    return;
  }
  check_files(scene);
  check_image(scene);
  check_load(scene);
  check_options(scene);
  check_solve_options(scene);
  check_tissues(scene);
  check_late_files(scene);
  check_parts(scene);
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

}  // namespace brainshift::pipelines
