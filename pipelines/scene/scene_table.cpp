// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_table.hpp"

#include "discretise/interface/option_table.hpp"
#include "register/interface/option_table.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/interface/option_table.hpp"
#include "segmentation/labels/label_table.hpp"
#include "solve/interface/option_table.hpp"
#include "solve/load/load_options.hpp"

namespace brainshift::pipelines {
namespace {

// The accessor of a member, for const and non-const scenes.
#define MEMBER(expression) \
  [](auto& s) -> auto& {   \
    return s.expression;   \
  }

Option<Scene> command(StageId stage) {
  return text_option<Scene>(
      "command", [stage](auto& s) -> auto& { return s.commands[index_of(stage)]; },
      "a program that takes the stage's place; {in} is the run's folder, {out} the folder that it writes to, both "
      "absolute; it runs in the scene's folder");
}

bool always(const Scene&) {
  return true;
}
void nothing(Scene&) {}

void add_load(Scene& scene) {
  if (!scene.load) {
    scene.load.emplace();
  }
}

template <class Member>
void add_to_load(Scene& scene, Member Load::*member) {
  add_load(scene);
  if (!(*scene.load.*member)) {
    (*scene.load.*member).emplace();
  }
}

template <class Member>
Element load_part(std::string name, std::string help, std::optional<Member> Load::*member, OptionTable<Scene> options) {
  return {.path = "load." + std::move(name),
          .help = std::move(help),
          .optional = true,
          .present = [member](const Scene& s) { return s.load && (*s.load.*member).has_value(); },
          .add = [member](Scene& s) { add_to_load(s, member); },
          .options = std::move(options)};
}

/// A part that is one member of the scene.
template <class Member>
Element part(std::string path, std::string help, std::optional<Member> Scene::*member, OptionTable<Scene> options) {
  return {.path = std::move(path),
          .help = std::move(help),
          .optional = true,
          .present = [member](const Scene& s) { return (s.*member).has_value(); },
          .add =
              [member](Scene& s) {
                if (!(s.*member)) {
                  (s.*member).emplace();
                }
              },
          .options = std::move(options)};
}

Element image_element() {
  return {
      .path = "image",
      .help = "What comes in: labels, or a T1 with a brain mask, or a brain surface; a T1 is needed to warp it.",
      .present = always,
      .add = nothing,
      .options = {
          file_option<Scene>("t1", MEMBER(image.t1),
                             "T1-weighted MRI: .nii, .nii.gz, .nrrd, .mha, .mgz or a DICOM folder"),
          file_option<Scene>("labels", MEMBER(image.labels),
                             "label map, or a .seg.nrrd of 3D Slicer; on another grid it is taken to the T1's"),
          named_file_option<Scene>("labels_are", MEMBER(image.labels_are), segmentation::label_table_names(),
                                   "whose numbers the label map has, where no <tissue> names them; a table's file is "
                                   "like FreeSurferColorLUT.txt, BIDS _dseg.tsv, .ctbl or .seg.nrrd; without it the "
                                   "names of a .seg.nrrd are taken and FreeSurfer's numbers recognised"),
          file_option<Scene>("brain_mask", MEMBER(image.brain_mask),
                             "non-zero is brain; its tissues are then classified from the T1"),
          file_option<Scene>("tumour_mask", MEMBER(image.tumour_mask), "non-zero is tumour, which becomes label 3"),
          file_option<Scene>(
              "tumour", MEMBER(image.tumour),
              "label map of the tumour, on any grid: BraTS numbers (oedema stays parenchyma), or a mask"),
          file_option<Scene>("surface", MEMBER(image.surface),
                             "brain surface in place of labels: " + std::string(listed_surface_endings)),
          labels_option<Scene>(
              "other_labels", MEMBER(image.other_labels),
              "labels of the map that are not tissue of the brain; every label that is not here needs a "
              "tissue"),
          number_option<Scene>(
              "skull_label", MEMBER(image.skull_label), label_numbers, "",
              "the skull's label; its inner surface is the skull; without it the brain's surface is")}};
}

OptionTable<Scene> load_options() {
  OptionTable<Scene> options = of_whole<Scene>(solve::opening_options(), MEMBER(load->opening));
  options.push_back(number_option<Scene>(
      "noise", MEMBER(load->noise), {solve::smallest_noise, 100}, "mm",
      "standard deviation of each measured displacement along each axis, where the file has no column sigma; without "
      "either the load is imposed exactly"));
  options.push_back(number_option<Scene>("weight", MEMBER(load->weight), not_negative, "mJ",
                                         "of a load with noise: how much energy of deformation a misfit of one "
                                         "standard deviation is worth; 0: chosen from "
                                         "the measured points"));
  options.push_back(choice_option<Scene>("robust", MEMBER(load->robust), {{"no", false}, {"yes", true}},
                                         "of a load with noise: measured points that contradict the others count for "
                                         "less"));
  options.push_back(choice_option<Scene>(
      "registration", MEMBER(load->registration_unknown), {{"known", false}, {"unknown", true}},
      "unknown: what was measured holds a rigid motion of the patient against the image, too, which is estimated with "
      "the deformation; needs a noise"));
  return options;
}

OptionTable<Scene> field_load_options() {
  return {
      required(file_option<Scene>("file", MEMBER(load->field->file),
                                  "displacements, mm, as an image of vectors (.nii, .nii.gz, .nrrd, .mha), or an "
                                  "ITK transform (.h5, .tfm, .txt, .mat), also one of several; of a pair, as ANTs "
                                  "writes a warp and an affine, make one first")),
      file_option<Scene>("where", MEMBER(load->field->where),
                         "the opening: a surface over it (" + std::string(listed_surface_endings) +
                             "), or markups about it or on it "
                             "(.mrk.json, .fcsv); absent: all of the brain's surface where the file is defined, a "
                             "field or B-spline in its grid, an affine transform everywhere, several where all are"),
      choice_option<Scene>("moves", MEMBER(load->field->moves),
                           {{"by_name", FieldLoad::Moves::by_name},
                            {"points", FieldLoad::Moves::points},
                            {"image", FieldLoad::Moves::image}},
                           "what the file takes from preop to intraop: points (it leads from preop places to "
                           "intraop ones) or the image (it resamples, and leads back); by_name: it is named, or "
                           "has a .json beside it, as this program writes them")};
}

std::vector<Element> load_elements() {
  return {
      {.path = "load",
       .help = "What is measured and imposed; one of the parts below.",
       .optional = true,
       .present = [](const Scene& s) { return s.load.has_value(); },
       .add = add_load,
       .options = load_options()},
      load_part("craniotomy", "Displacements measured on the exposed cortex.", &Load::craniotomy,
                {required(file_option<Scene>("file", MEMBER(load->craniotomy.value()),
                                             "x,y,z,ux,uy,uz in mm, with a header and a line '# frame: LPS' or RAS"))}),
      load_part("markups", "Two 3D Slicer markups of the same points (.mrk.json, .fcsv).", &Load::markups,
                {required(file_option<Scene>("before", MEMBER(load->markups->before), "preop positions")),
                 required(file_option<Scene>("after", MEMBER(load->markups->after), "intraop positions"))}),
      load_part("surfaces", "Two surfaces of the exposed cortex.", &Load::surfaces,
                {required(file_option<Scene>("before", MEMBER(load->surfaces->before), "preop surface")),
                 required(file_option<Scene>("after", MEMBER(load->surfaces->after), "intraop surface"))}),
      load_part("field", "Another program's registration of the two brains, on the brain's surface.", &Load::field,
                field_load_options()),
      load_part("simulated", "A craniotomy made up on the brain's surface: say so when you show the result.",
                &Load::simulated,
                of_whole<Scene>(solve::simulated_craniotomy_options(), MEMBER(load->simulated.value())))};
}

Element cuts_element() {
  return part("cuts", "Cuts of the body, one element each.", &Scene::cuts,
              {choice_option<Scene>("contact", MEMBER(cuts->contact), {{"no", false}, {"yes", true}},
                                    "whether the faces of cuts are kept from passing through each other")});
}

Element gravity_element() {
  return part(
      "gravity", "The fluid round the brain drains: tissue above its level loses its buoyancy.", &Scene::gravity,
      {required(vector_option<Scene>("direction", MEMBER(gravity->direction), "LPS",
                                     "in which things fall: 0,0,-1 when the patient sits, 0,1,0 on the back")),
       number_option<Scene>("fluid_level", MEMBER(gravity->fluid_level), any_number, "mm",
                            "of the fluid's surface along the direction, from the world's origin: for 0,0,-1 its -z; "
                            "one of fluid_level, drained and fluid_point says the level"),
       number_option<Scene>("drained", MEMBER(gravity->drained), {.low = 0, .high = 100}, "%",
                            "of the brain's height that lies above the fluid"),
       vector_option<Scene>("fluid_point", MEMBER(gravity->fluid_point), "mm, LPS", "a point on the fluid's surface"),
       number_option<Scene>("fluid_density", MEMBER(gravity->fluid_density), {.low = 0, .high = 2000}, "kg/m3",
                            "of cerebrospinal fluid or what it was replaced by"),
       vector_option<Scene>(
           "image_direction", MEMBER(gravity->image_direction), "LPS",
           "in which things fell when the image was taken, where the patient was turned since: tissues then "
           "need their own densities (brain 1040); absent: the same direction")});
}

Element resection_element() {
  return part("resection", "Tissue that is taken out; the rest relaxes.", &Scene::resection,
              of_whole<Scene>(solve::resection_options(), MEMBER(resection.value())));
}

Element stage_element(StageId stage, std::string help, OptionTable<Scene> options) {
  options.push_back(command(stage));
  return {.path = std::string(stage_name(stage)),
          .help = std::move(help),
          .present = always,
          .add = nothing,
          .options = std::move(options)};
}

Element discretise_element() {
  OptionTable<Scene> options = of_whole<Scene>(discretise::discretise_options(), &Scene::discretise);
  append(options, of_whole<Scene>(discretise::refinement_options(), &Scene::refinement));
  return stage_element(StageId::discretise, "Surface to nodes and background cells.", std::move(options));
}

OptionTable<Scene> loading_options() {
  return {
      number_option<Scene>("duration", MEMBER(loading.duration), above_zero, "s",
                           "transient: of the 3-4-5 curve by which load and forces come, and of the run; 1 when "
                           "absent"),
      file_option<Scene>("curve", MEMBER(loading.curve),
                         "CSV time,factor from 0,0 on, by which load and forces come, in place of the 3-4-5 curve; "
                         "its times are seconds in a transient run, which ends with it"),
      choice_option<Scene>("curve_join", MEMBER(loading.curve_join),
                           {{"smooth", solve::LoadCurve::Join::smooth}, {"straight", solve::LoadCurve::Join::straight}},
                           "of the curve's rows: by 3-4-5 polynomials or straight lines"),
      vector_option<Scene>("gravity", MEMBER(loading.gravity), "m/s2, LPS",
                           "the whole weight of the tissues, as of a body in air that was imaged without weight; for a "
                           "head, which floats "
                           "in the image, take <gravity> with a fluid level")};
}

Element solve_element() {
  OptionTable<Scene> options = of_whole<Scene>(solve::solve_options(), &Scene::solve);
  append(options, loading_options());
  return stage_element(StageId::solve,
                       "MTLED: to the steady state by adaptive dynamic relaxation, or the motion in time.",
                       std::move(options));
}

/// The values of a setting: each must be one that the setting's own option takes.
Option<Scene> values_of(const TradeoffSetting& setting) {
  const auto access = [setting](auto& scene) -> auto& {
    return (*scene.tradeoff).*setting.list;
  };
  Option<Scene> option =
      text_option<Scene>(setting.name, access, "values of " + std::string(setting.element) + "." + setting.name);
  option.allowed = "values of that option, separated by blanks or commas";
  option.read = [=](Scene& scene, const std::string& words) {
    const Option<Scene>* listed = find_option(find_element(setting.element)->options, setting.name);
    const std::vector<std::string> values = split_words(words);
    for (const std::string& value : values) {
      if (Scene scratch; !set_option(*listed, scratch, value)) {
        return false;
      }
    }
    access(scene) = words;
    return !values.empty();
  };
  return option;
}

Element tradeoff_element() {
  Element element =
      part("tradeoff", "What the command tradeoff tries: all combinations of these values.", &Scene::tradeoff, {});
  for (const TradeoffSetting& setting : tradeoff_settings) {
    element.options.push_back(values_of(setting));
  }
  element.options.push_back(number_option<Scene>("reference_nodes", MEMBER(tradeoff->reference_nodes),
                                                 *find_option(discretise::discretise_options(), "nodes")->range, "",
                                                 "of the much finer solution that they are measured against"));
  return element;
}

std::vector<Element> make_elements() {
  std::vector<Element> elements = {image_element()};
  for (Element& element : load_elements()) {
    elements.push_back(std::move(element));
  }
  elements.push_back(part("contact", "The brain slides in the rigid skull, without friction.", &Scene::contact,
                          {file_option<Scene>("skull", MEMBER(contact->skull),
                                              "surface of the skull's inside; empty: the segment stage's")}));
  elements.push_back(gravity_element());
  elements.push_back(cuts_element());
  elements.push_back(part("septa",
                          "Falx and tentorium, rigid sheets along which tissue slides: from the label map, by "
                          "FreeSurfer's numbers.",
                          &Scene::septa, {}));
  elements.push_back(part("septum", "The same from a surface.", &Scene::septum,
                          {required(file_option<Scene>("file", MEMBER(septum->file),
                                                       "sheet of triangles: " + std::string(listed_surface_endings) +
                                                           "; it may branch and end inside the brain"))}));
  elements.push_back(resection_element());
  elements.push_back(
      part("landmarks", "Points to move with the brain.", &Scene::landmarks,
           {required(file_option<Scene>("file", MEMBER(landmarks.value()), "markups: .mrk.json or .fcsv"))}));
  elements.push_back(
      part("uncertainty",
           "How far the answer may be off, by the noise of what is measured and by constants that nobody "
           "knows.",
           &Scene::uncertainty, of_whole<Scene>(solve::uncertainty_options(), MEMBER(uncertainty.value()))));
  elements.push_back(stage_element(StageId::segment, "Labels or image to closed surfaces.",
                                   of_whole<Scene>(segmentation::segment_options(), &Scene::segment)));
  elements.push_back(discretise_element());
  elements.push_back(solve_element());
  elements.push_back(stage_element(StageId::registration, "Displacement to fields and warped images.",
                                   of_whole<Scene>(registration::register_options(), &Scene::registration)));
  elements.push_back(stage_element(StageId::report, "The page of pictures.", {}));
  elements.push_back(tradeoff_element());
  return elements;
}

OptionTable<CutFile> make_cut_options() {
  OptionTable<CutFile> options = {
      required(file_option<CutFile>("file", &CutFile::file,
                                    "the sheet, a surface: " + std::string(listed_surface_endings) +
                                        "; a .vtp may say in the point array "
                                        "time when the cut gets to each point"))};
  append(options, of_whole<CutFile>(solve::cut_timing_options(), &CutFile::timing));
  return options;
}

#undef MEMBER

}  // namespace

const std::vector<Element>& scene_elements() {
  static const std::vector<Element> elements = make_elements();
  return elements;
}

const OptionTable<CutFile>& cut_options() {
  static const OptionTable<CutFile> options = make_cut_options();
  return options;
}

const Element* find_element(const std::string& path) {
  for (const Element& element : scene_elements()) {
    if (element.path == path) {
      return &element;
    }
  }
  return nullptr;
}

}  // namespace brainshift::pipelines
