// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Python module brainshift._core: the stages on arrays, and the runner. init.py stands before it.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <algorithm>

#include "discretise/discretise.hpp"
#include "discretise/interface/option_table.hpp"
#include "pipelines/phantom/phantom.hpp"
#include "pipelines/python/convert.hpp"
#include "pipelines/runner/impose.hpp"
#include "pipelines/runner/libraries.hpp"
#include "pipelines/runner/load_warnings.hpp"
#include "pipelines/runner/measure_warnings.hpp"
#include "pipelines/runner/register_warnings.hpp"
#include "pipelines/runner/run.hpp"
#include "pipelines/runner/stage_folder.hpp"
#include "pipelines/runner/warp_files.hpp"
#include "pipelines/scene/check_scene.hpp"
#include "pipelines/scene/parse_scene.hpp"
#include "pipelines/scene/presets.hpp"
#include "register/interface/option_table.hpp"
#include "register/registration.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/interface/option_table.hpp"
#include "segmentation/segment.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/load/contradictions.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/noisy_load.hpp"
#include "solve/material/material_options.hpp"
#include "solve/material/named_materials.hpp"
#include "solve/run/outliers.hpp"
#include "solve/solve.hpp"
#include "solve/solve_each.hpp"

namespace brainshift::python {
namespace {

using Listener = std::function<void(double, std::string)>;  // progress(fraction, what) of the caller, or None
using Free = py::gil_scoped_release;

/// Tells the caller, and looks whether the user interrupts: then KeyboardInterrupt leaves the computation as any fault.
Progress attentive(const Listener& listener) {
  return [&listener](double fraction, std::string_view what) {
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) {
      throw py::error_already_set();
    }
    if (listener) {
      listener(fraction, std::string(what));
    }
  };
}

template <class T>
std::optional<T> copy_if(const T* given) {
  return given == nullptr ? std::nullopt : std::optional<T>(*given);
}

segmentation::Segmentation segment(const LabelMap* labels, const ScalarImage* t1, const LabelMap* brain_mask,
                                   const Surface* surface,
                                   const std::optional<std::vector<std::uint16_t>>& brain_labels,
                                   std::optional<std::uint16_t> skull_label, const Listener& progress,
                                   const py::kwargs& named) {
  segmentation::SegmentOptions options;
  set_options(segmentation::segment_options(), named, options);
  options.brain_labels = brain_labels.value_or(options.brain_labels);
  options.skull_label = skull_label;
  const Free free;
  return segmentation::segment({.t1 = copy_if(t1),
                                .labels = copy_if(labels),
                                .brain_mask = copy_if(brain_mask),
                                .tumour_mask = {},
                                .surface = copy_if(surface)},
                               options, attentive(progress));
}

discretise::Discretisation discretise(const Surface& brain, const LabelMap* labels,
                                      const std::optional<std::vector<std::int32_t>>& brain_labels,
                                      const Listener& progress, const py::kwargs& named) {
  discretise::DiscretiseOptions options;
  set_options(discretise::discretise_options(), named, options);
  options.brain_labels = brain_labels.value_or(options.brain_labels);
  const Free free;
  return discretise::discretise(brain, labels, options, attentive(progress));
}

solve::Material material_of(const py::handle& given) {
  if (py::isinstance<py::str>(given)) {
    const auto name = given.cast<std::string>();
    if (const auto material = solve::named_material(name)) {
      return *material;
    }
    throw std::invalid_argument("there is no material '" + name +
                                "'; there are: " + with_commas(solve::material_names()));
  }
  solve::Material material;
  set_options(solve::material_options(), py::kwargs(given.cast<py::dict>()), material);
  return material;
}

std::map<std::int32_t, solve::Material> materials_of(const py::dict& given) {
  std::map<std::int32_t, solve::Material> materials;
  for (const auto& [label, material] : given) {
    if (!py::isinstance<py::int_>(label) && !py::hasattr(label, "__index__")) {
      throw py::type_error("materials has the key " + py::repr(label).cast<std::string>() +
                           "; a whole number, the label of a tissue, is expected");
    }
    materials[label.cast<std::int32_t>()] = material_of(material);
  }
  return materials;
}

solve::SolveOptions options_of(const py::kwargs& named) {
  solve::SolveOptions options = pipelines::quickest();  // as a scene
  set_options(solve::solve_options(), named, options);
  return options;
}

/// Without materials.
solve::Model model_of(const discretise::Discretisation& body, const solve::CraniotomyLoad& load, const LabelMap* labels,
                      const Surface* skull, const Surface* boundary) {
  solve::Model model;
  model.cloud = body.cloud;
  model.cells = body.cells;
  model.labels = copy_if(labels);
  model.skull = copy_if(skull);
  model.boundary = copy_if(boundary);
  model.conditions = pipelines::imposed(load, {}, model.cloud);
  return model;
}

/// As the program's notes have them.
pipelines::Warnings warnings_on(const solve::CraniotomyLoad& load, const solve::Model& model,
                                const solve::SolveOptions& options, const solve::SolveResult& result) {
  using pipelines::warnings_of;
  pipelines::Warnings all = warnings_of(result.measures);
  pipelines::append(warnings_of(load, model, result.solution.displacement), all);
  if (result.measures.measured) {
    pipelines::append(warnings_of(solve::worst_of_joined(load, solve::inner_points(model.cloud, load)), false), all);
    pipelines::append(warnings_of(solve::outliers(solve::thinned_body(model, options.shape), model.conditions), false),
                      all);
  }
  return all;
}

/// By Python's own warnings, which a caller may turn into exceptions. frames: of Python between the caller and this.
void warn(const pipelines::Warnings& warnings, Py_ssize_t frames = 0) {
  for (const std::string& warning : warnings) {
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1 + frames) != 0) {
      throw py::error_already_set();
    }
  }
}

solve::SolveResult solve_model(const discretise::Discretisation& body, const py::dict& materials,
                               const solve::CraniotomyLoad& load, const LabelMap* labels, const Surface* skull,
                               const Surface* boundary, const Listener& progress, const py::kwargs& named) {
  const solve::SolveOptions options = options_of(named);
  std::map<std::int32_t, solve::Material> given = materials_of(materials);
  solve::SolveResult result;
  pipelines::Warnings warnings;
  {
    const Free free;
    solve::Model model = model_of(body, load, labels, skull, boundary);
    model.materials = std::move(given);
    result = solve::solve(model, options, attentive(progress));
    if (result.failure.empty()) {
      warnings = warnings_on(load, model, options, result);
    }
  }
  warn(warnings, 1);  // init.py has a solve() of its own
  return result;
}

/// The numbers of a matrix that nobody else holds, as an array without a copy.
py::array_t<double> given_away(Points points) {
  auto* kept = new Points(std::move(points));
  return view(py::capsule(kept, [](void* p) { delete static_cast<Points*>(p); }), *kept);
}

/// A member of the answer is None where there is no rest.
py::list solve_each(const discretise::Discretisation& body, const std::vector<py::dict>& materials,
                    const solve::CraniotomyLoad& load, const LabelMap* labels, const Surface* skull,
                    const Surface* boundary, const Listener& progress, const py::kwargs& named) {
  const solve::SolveOptions options = options_of(named);
  std::vector<solve::Constants> constants;
  for (const py::dict& of_one : materials) {
    constants.push_back({.materials = materials_of(of_one)});
  }
  std::vector<std::optional<Points>> moved;
  pipelines::Warnings warnings;
  if (!constants.empty()) {
    const Free free;
    solve::Model model = model_of(body, load, labels, skull, boundary);
    model.materials = constants.front().materials;
    moved = solve::solve_each(model, options, constants, attentive(progress));
    const auto at_rest = std::ranges::find_if(moved, [](const auto& u) { return u.has_value(); });
    if (at_rest != moved.end()) {
      warnings = pipelines::warnings_of(load, model, **at_rest);
    }
  }
  warn(warnings);
  py::list answer;
  for (std::optional<Points>& u : moved) {
    answer.append(u ? py::object(given_away(std::move(*u))) : py::none());
  }
  return answer;
}

registration::Registration register_images(const solve::SolveResult& moved, const Surface& brain, const ScalarImage& t1,
                                           const LabelMap* labels, const std::optional<RowMajor<double>>& landmarks,
                                           const Listener& progress, const py::kwargs& named) {
  registration::RegisterOptions options;
  set_options(registration::register_options(), named, options);
  registration::RegisterInput input{.solution = moved.solution, .brain = brain, .t1 = t1, .labels = copy_if(labels)};
  if (landmarks) {
    input.landmarks = points_of(*landmarks, "landmarks");
  }
  registration::Registration result;
  {
    const Free free;
    result = registration::register_images(input, options, attentive(progress));
  }
  warn(pipelines::warnings_of(result.measures));
  return result;
}

registration::Interpolation interpolation_of(const std::string& name) {
  registration::RegisterOptions options;
  const auto* option = find_option(registration::register_options(), "interpolation");
  if (!set_option(*option, options, name)) {
    throw std::invalid_argument(refusal(*option, name));
  }
  return options.interpolation;
}

py::tuple run(const std::filesystem::path& scene_file, const std::filesystem::path& out, const std::string& until,
              bool force, const std::string& preset, const py::dict& set, const Listener& progress) {
  std::vector<std::string> overrides = pipelines::preset_overrides(preset);
  for (const auto& [path, value] : set) {
    overrides.push_back(path.cast<std::string>() + "=" + option_text(value));
  }
  pipelines::RunOutcome outcome;
  {
    const Free free;
    const pipelines::Scene scene = pipelines::parse_scene(scene_file, overrides);
    pipelines::check_scene(scene);
    pipelines::Interruption interruption;
    const Progress tell = attentive(progress);
    outcome =
        pipelines::run(scene, {.out = out, .until = pipelines::stage_from_name(until), .force = force}, interruption,
                       [&](const pipelines::RunEvent& event) {
                         const std::string stage(pipelines::stage_name(event.stage));
                         tell(event.total_fraction, stage + (event.what.empty() ? "" : ": ") + std::string(event.what));
                       });
  }
  return py::make_tuple(py::module_::import("json").attr("loads")(outcome.record.dump()), outcome.failure);
}

std::vector<std::string> warp_files(const std::filesystem::path& run, const std::vector<std::filesystem::path>& files,
                                    const std::filesystem::path& out, bool inverse, const std::filesystem::path& like,
                                    const std::string& interpolation) {
  pipelines::WarpJob job{.run = run, .files = files, .like = like, .towards = {}, .options = {}};
  job.towards = inverse ? registration::Towards::preop : registration::Towards::intraop;
  if (interpolation == "nearest") {
    job.options.values = registration::Values::labels;
  } else if (interpolation != "auto") {
    job.options.values = registration::Values::intensities;
    job.options.interpolation = interpolation_of(interpolation);
  }
  const Free free;
  pipelines::Interruption interruption;
  pipelines::refuse_stage_folder(out);
  pipelines::StageFolder folder(out, interruption);
  const std::vector<std::string> notes = pipelines::warp_files(job, folder.path());
  pipelines::remove_values_of_earlier(job.files, folder.path(), out);
  folder.merge();
  return notes;
}

/// The stages on arrays.
void add_stages(py::module_& m) {
  const auto none = py::none();
  m.def("segment", &segment, py::arg("labels") = none, py::arg("t1") = none, py::arg("brain_mask") = none,
        py::arg("surface") = none, py::arg("brain_labels") = none, py::arg("skull_label") = none,
        py::arg("progress") = none,
        ("Labels (a LabelMap), or a t1 with a brain_mask, or a surface that may be broken, to closed surfaces.\n"
         "brain_labels: those of the brain [1, 2, 3]; skull_label: of the skull, whose inside holds the brain." +
         options_help(segmentation::segment_options(), segmentation::SegmentOptions{}))
            .c_str());
  m.def("discretise", &discretise, py::arg("brain"), py::arg("labels") = none, py::arg("brain_labels") = none,
        py::arg("progress") = none,
        ("Fills a closed Surface with nodes and background cells. The same input gives the same Body, bit for bit." +
         options_help(discretise::discretise_options(), discretise::DiscretiseOptions{}))
            .c_str());
  m.def("solve", &solve_model, py::arg("body"), py::arg("materials"), py::arg("load"), py::arg("labels") = none,
        py::arg("skull") = none, py::arg("boundary") = none, py::arg("progress") = none,
        ("Computes how a Body moves under a Load. materials: {label: name or options}, as {1: 'brain', 2: "
         "dict(youngs_modulus=3000, poisson_ratio=0.49)}.\nlabels: tissue at each place, a LabelMap; skull: a Surface "
         "that holds the brain; boundary: the brain's own." +
         options_help(solve::solve_options(), pipelines::quickest()))
            .c_str());
  m.def(
      "solve_each", &solve_each, py::arg("body"), py::arg("materials"), py::arg("load"), py::arg("labels") = none,
      py::arg("skull") = none, py::arg("boundary") = none, py::arg("progress") = none,
      "A study of materials: solve() with each of a list of materials, prepared once and stepped together, sixteen in "
      "about three times the time of one. Returns (n, 3) displacements, mm, the same as solve()'s to rounding; None "
      "where it finds no rest; warns of what is odd about the load alone. The load has no noise. Options are those of "
      "solve().");
  m.def("register", &register_images, py::arg("solution"), py::arg("brain"), py::arg("t1"), py::arg("labels") = none,
        py::arg("landmarks") = none, py::arg("progress") = none,
        ("A Solution to fields on the t1's grid and warped images. landmarks: (n, 3) preop, mm, LPS." +
         options_help(registration::register_options(), registration::RegisterOptions{}))
            .c_str());
}

/// Places and images moved by a field.
void add_warps(py::module_& m) {
  m.def(
      "warp_points",
      [](const VectorImage& forward, const RowMajor<double>& points) {
        const Points given = points_of(points, "points");
        Points moved;
        {
          const Free free;
          moved = registration::move_points(forward, given);
        }
        return given_away(std::move(moved));
      },
      py::arg("forward"), py::arg("points"),
      "Points (n, 3), mm, LPS, moved by the field of their own brain: preop points by the forward field. Outside the "
      "field's grid they stay.");
  m.def(
      "warp",
      [](const ScalarImage& image, const VectorImage& resampling, const std::string& interpolation) {
        const registration::Interpolation how = interpolation_of(interpolation);
        const Free free;
        return registration::warp(image, resampling, how);
      },
      py::arg("image"), py::arg("resampling"), py::arg("interpolation") = "linear",
      "An image resampled on its own grid by the field at the places of the result: preop images by the resampling "
      "field. interpolation: linear or bspline; a LabelMap takes the nearest label.");
  m.def(
      "warp", [](const LabelMap& labels, const VectorImage& field) { return registration::warp(labels, field); },
      py::arg("labels"), py::arg("resampling"), py::call_guard<Free>());
}

/// What reads and writes folders.
void add_runs(py::module_& m) {
  m.def("run", &run, py::arg("scene"), py::arg("out"), py::arg("until"), py::arg("force"), py::arg("preset"),
        py::arg("set"), py::arg("progress"));
  m.def(
      "warp_files", &warp_files, py::arg("run"), py::arg("files"), py::arg("out"), py::arg("inverse") = false,
      py::arg("like") = "", py::arg("interpolation") = "auto",
      "Takes files along by a finished run, as `brainshift warp`: images, surfaces, tracts, points. Returns a sentence "
      "on each. inverse: they are intraoperative. like: image whose grid warped images take. interpolation: auto, "
      "nearest, linear or bspline.");
  m.def(
      "write_phantom",
      [](const std::filesystem::path& out, const py::kwargs& named) {
        pipelines::PhantomOptions options;
        set_options(pipelines::phantom_options(), named, options);
        const Free free;
        pipelines::Interruption interruption;
        pipelines::StageFolder folder(out, interruption);
        pipelines::write_phantom(options, folder.path());
        folder.refuse_others_files();
        folder.merge();
      },
      py::arg("out"),
      ("Writes a synthetic head with its load and its scene.xml into a folder." +
       options_help(pipelines::phantom_options(), pipelines::PhantomOptions{}))
          .c_str());
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.attr("knows_numpy_2") = PYBIND11_VERSION_HEX >= 0x020C0000;  // an older one reads sizes at NumPy 1's places
  add_images(m);
  add_results(m);
  add_stages(m);
  add_warps(m);
  add_runs(m);
  m.def(
      "set_threads",
      [](int threads) {
        if (threads < 1) {
          throw std::invalid_argument("threads is " + std::to_string(threads) +
                                      "; a whole number from 1 on is expected");
        }
        pipelines::set_threads(threads);
      },
      py::arg("threads"), "Threads to use; results do not depend on it.");
  m.attr("__version__") = BRAINSHIFT_VERSION;
}

}  // namespace brainshift::python
