// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_table.hpp"

#include "solve/material/named_materials.hpp"

namespace brainshift::pipelines {
namespace {

constexpr Range not_negative{.low = 0};
constexpr Range any_number{};

// The accessor of a member, for const and non-const scenes.
#define MEMBER(expression) \
  [](auto& s) -> auto& {   \
    return s.expression;   \
  }

Option<Scene> command(StageId stage) {
  return text<Scene>(
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
Element load_part(std::string name, std::string help, std::optional<Member> Load::*member,
                  std::vector<Option<Scene>> options) {
  return {"load." + std::move(name),
          std::move(help),
          true,
          [member](const Scene& s) { return s.load && (*s.load.*member).has_value(); },
          [member](Scene& s) { add_to_load(s, member); },
          std::move(options)};
}

/// A part that is one member of the scene.
template <class Member>
Element part(std::string path, std::string help, std::optional<Member> Scene::*member,
             std::vector<Option<Scene>> options) {
  return {std::move(path),
          std::move(help),
          true,
          [member](const Scene& s) { return (s.*member).has_value(); },
          [member](Scene& s) {
            if (!(s.*member)) {
              (s.*member).emplace();
            }
          },
          std::move(options)};
}

Element image_element() {
  return {"image",
          "What comes in: labels, or a T1 with a brain mask, or a brain surface; a T1 is needed to warp it.",
          false,
          always,
          nothing,
          {file<Scene>("t1", MEMBER(image.t1), "T1-weighted MRI: .nii, .nii.gz, .nrrd, .mha or a DICOM folder"),
           file<Scene>("labels", MEMBER(image.labels), "label map on the T1's grid"),
           file<Scene>("brain_mask", MEMBER(image.brain_mask),
                       "non-zero is brain; its tissues are then classified from the T1"),
           file<Scene>("tumour_mask", MEMBER(image.tumour_mask), "non-zero is tumour, which becomes label 3"),
           file<Scene>("surface", MEMBER(image.surface), "brain surface in place of labels: .vtp, .stl, .ply, .obj"),
           labels<Scene>("other_labels", MEMBER(image.other_labels),
                         "labels of the map that are not tissue of the brain; every label that is not here needs a "
                         "tissue"),
           number<Scene>("skull_label", MEMBER(image.skull_label), {.low = 1, .high = 32767}, "",
                         "the skull's label; its inner surface is the skull; without it the brain's surface is")}};
}

std::vector<Element> load_elements() {
  return {
      {"load",
       "What is measured and imposed; one of the parts below.",
       true,
       [](const Scene& s) { return s.load.has_value(); },
       add_load,
       {number<Scene>("margin", MEMBER(load->opening.margin), any_number, "mm",
                      "how far past the outermost measured points the opening reaches; negative: half their median "
                      "distance to each other"),
        number<Scene>("depth", MEMBER(load->opening.depth), above_zero, "mm",
                      "a node this far above or below the measured surface is not under the opening"),
        number<Scene>("farthest", MEMBER(load->opening.farthest), above_zero, "mm",
                      "a measured point farther than this from any surface node is an error")}},
      load_part("craniotomy", "Displacements measured on the exposed cortex.", &Load::craniotomy,
                {required(file<Scene>("file", MEMBER(load->craniotomy.value()),
                                      "x,y,z,ux,uy,uz in mm, with a header and a line '# frame: LPS' or RAS"))}),
      load_part("markups", "Two 3D Slicer markups of the same points (.mrk.json, .fcsv).", &Load::markups,
                {required(file<Scene>("before", MEMBER(load->markups->before), "preop positions")),
                 required(file<Scene>("after", MEMBER(load->markups->after), "intraop positions"))}),
      load_part("surfaces", "Two surfaces of the exposed cortex.", &Load::surfaces,
                {required(file<Scene>("before", MEMBER(load->surfaces->before), "preop surface")),
                 required(file<Scene>("after", MEMBER(load->surfaces->after), "intraop surface"))}),
      load_part("simulated", "A craniotomy made up on the brain's surface: say so when you show the result.",
                &Load::simulated,
                {required(vector<Scene>("centre", MEMBER(load->simulated->centre), "mm, LPS",
                                        "near the middle of the opening; the nearest point of the surface is taken")),
                 number<Scene>("radius", MEMBER(load->simulated->radius), above_zero, "mm", "of the opening"),
                 number<Scene>("depth", MEMBER(load->simulated->depth), above_zero, "mm",
                               "inward displacement at the centre")})};
}

Element cuts_element() {
  return part("cuts", "Cuts of the body, one element each.", &Scene::cuts,
              {choice<Scene>("contact", MEMBER(cuts->contact),
                             std::vector<std::pair<std::string, bool>>{{"no", false}, {"yes", true}},
                             "whether the faces of cuts are kept from passing through each other")});
}

Element resection_element() {
  return part("resection", "Tissue that is taken out; the rest relaxes.", &Scene::resection,
              {required(labels<Scene>("labels", MEMBER(resection->labels), "of the tissues that are taken out")),
               number<Scene>("pressure", MEMBER(resection->pressure), any_number, "Pa",
                             "in the cavity, on its undeformed wall")});
}

Element segment_element() {
  return {"segment",
          "Labels or image to closed surfaces.",
          false,
          always,
          nothing,
          {number<Scene>("edge_length", MEMBER(segment.edge_length), above_zero, "mm",
                         "target edge of the remeshed surfaces"),
           number<Scene>("classes", MEMBER(segment.classes), {.low = 2, .high = 10}, "",
                         "fuzzy c-means classes (CSF, grey, white) when there are no labels"),
           number<Scene>("ventricle_depth", MEMBER(segment.ventricle_depth), not_negative, "mm",
                         "CSF is ventricle when its component reaches this deep under the brain's surface"),
           command(StageId::segment)}};
}

Element discretise_element() {
  return {"discretise",
          "Surface to nodes and background cells.",
          false,
          always,
          nothing,
          {number<Scene>("nodes", MEMBER(discretise.nodes), {.low = 20, .high = 10000000}, "",
                         "wanted number of nodes, or spacing; 12000 when neither is given"),
           number<Scene>("spacing", MEMBER(discretise.spacing), above_zero, "mm", "distance between nodes, or nodes"),
           number<Scene>("minimum_distance", MEMBER(discretise.minimum_distance), {.low = 0, .high = 0.7}, "",
                         "no two nodes nearer than this fraction of the local spacing"),
           number<Scene>("craniotomy_factor", MEMBER(refinement.factor), {.low = 0.1, .high = 1}, "",
                         "spacing near the load / uniform spacing"),
           number<Scene>("craniotomy_radius", MEMBER(refinement.radius), above_zero, "mm", "how far near the load is"),
           number<Scene>("tumour_factor", MEMBER(discretise.tumour_factor), {.low = 0.1, .high = 1}, "",
                         "spacing in and at the tumour / uniform spacing"),
           number<Scene>("tumour_label", MEMBER(discretise.tumour_label), {.low = 1, .high = 32767}, "",
                         "label of the tumour"),
           number<Scene>("tissue_boundary_factor", MEMBER(discretise.tissue_boundary_factor), {.low = 0.1, .high = 1},
                         "", "spacing at boundaries between tissues / uniform spacing"),
           choice<Scene>("cells", MEMBER(discretise.cells),
                         std::vector<std::pair<std::string, CellKind>>{{"hexahedra", CellKind::hexahedron},
                                                                       {"tetrahedra", CellKind::tetrahedron}},
                         "background cells for integration"),
           number<Scene>("cells_per_node", MEMBER(discretise.cells_per_node), {.low = 0.1, .high = 100}, "",
                         "hexahedra: cells a node"),
           number<Scene>("seed", MEMBER(discretise.seed), not_negative, "",
                         "of the randomness; the same seed gives the same files"),
           command(StageId::discretise)}};
}

Element solve_element() {
  return {
      "solve",
      "MTLED: to the steady state by adaptive dynamic relaxation, or the motion in time.",
      false,
      always,
      nothing,
      {choice<Scene>("basis", MEMBER(solve.shape.basis),
                     std::vector<std::pair<std::string, Basis>>{{"linear", Basis::linear},
                                                                {"quadratic", Basis::quadratic},
                                                                {"modified_quadratic", Basis::modified_quadratic}},
                     "of the shape functions: MLS, or MMLS (modified_quadratic)"),
       choice<Scene>("derivatives", MEMBER(solve.shape.derivatives),
                     std::vector<std::pair<std::string, Derivatives>>{{"full", Derivatives::full},
                                                                      {"diffuse", Derivatives::diffuse}},
                     "of the shape functions; diffuse is cheaper and inexact"),
       number<Scene>(
           "dilatation", MEMBER(solve.shape.dilatation), {.low = 0, .high = 10}, "",
           "support radius / local spacing; 0: what suits the basis, 1.6 (linear) or 2.2, in a plane 1.8 or 2.4"),
       number<Scene>("penalty", MEMBER(solve.shape.penalty), {.low = 0, .high = 1}, "",
                     "on the quadratic terms of MMLS"),
       choice<Scene>(
           "volumetric", MEMBER(solve.volumetric),
           std::vector<std::pair<std::string, solve::Volumetric>>{
               {"mean_dilatation", solve::Volumetric::mean_dilatation}, {"pointwise", solve::Volumetric::pointwise}},
           "volumetric strain energy: pressures linear over patches of a few nodes, or pointwise, the plain "
           "method, which locks"),
       number<Scene>("nodes_per_patch", MEMBER(solve.nodes_per_patch), above_zero, "",
                     "of mean_dilatation: nodes to a patch, on average"),
       choice<Scene>("integration", MEMBER(solve.integration),
                     std::vector<std::pair<std::string, solve::Integration>>{
                         {"plain", solve::Integration::plain}, {"consistent", solve::Integration::consistent}},
                     "derivatives as they are, or corrected for cells that do not conform to the body, so that "
                     "the linear patch test holds"),
       choice<Scene>("imposition", MEMBER(solve.imposition),
                     std::vector<std::pair<std::string, solve::Imposition>>{
                         {"exact", solve::Imposition::exact}, {"simplified", solve::Imposition::simplified}},
                     "of prescribed displacements: factorised, or lumped, which is cheaper and off by what the "
                     "next step takes back"),
       choice<Scene>("points_per_cell", MEMBER(solve.points_per_cell),
                     std::vector<std::pair<std::string, std::optional<int>>>{
                         {"auto", std::nullopt}, {"1", 1}, {"3", 3}, {"4", 4}, {"8", 8}},
                     "integration points a cell: hexahedra 1 or 8 (auto), tetrahedra 1 or 4 (auto); planar cells: "
                     "quadrilaterals 1 or 4 (auto), triangles 1 or 3 (auto); in adaptive integration of each part of "
                     "a cell, where auto is 1"),
       number<Scene>("integration_tolerance", MEMBER(solve.integration_tolerance), not_negative, "",
                     "of adaptive integration, relative: cells are split until their parts agree with them to it, "
                     "points_per_cell in each part; 0: in every cell"),
       number<Scene>("integration_depth", MEMBER(solve.integration_depth), {.low = 1, .high = 6}, "",
                     "of adaptive integration: how often a cell may be split"),
       choice<Scene>(
           "precision", MEMBER(solve.precision),
           std::vector<std::pair<std::string, solve::Precision>>{{"double", solve::Precision::double_precision},
                                                                 {"single", solve::Precision::single_precision}},
           "of the derivatives while stepping and of the sums over pairs of points and nodes; stresses are double in "
           "any "
           "case. On the demo single is within 0.0001 mm of double"),
       choice<Scene>("dynamics", MEMBER(solve.dynamics),
                     std::vector<std::pair<std::string, solve::Dynamics>>{{"relaxation", solve::Dynamics::relaxation},
                                                                          {"transient", solve::Dynamics::transient}},
                     "the steady state under the full load, where relaxing materials have relaxed; or the motion "
                     "in time, with the physical mass"),
       number<Scene>("tolerance", MEMBER(solve.tolerance), above_zero, "mm",
                     "relaxation: stop when the bound of the remaining error is below this"),
       number<Scene>("load_steps", MEMBER(solve.load_steps), {.low = 1}, "", "relaxation: steps over the load's curve"),
       choice<Scene>("start", MEMBER(solve.start),
                     std::vector<std::pair<std::string, solve::Start>>{{"coarse", solve::Start::coarse},
                                                                       {"rest", solve::Start::rest}},
                     "of relaxation: under the full load, as a coarse cloud's solution lies, or undeformed, with a "
                     "history of the load; also where a body is cut or snapshots are wanted"),
       number<Scene>("time_step", MEMBER(solve.time_step), not_negative, "s",
                     "transient: at most the critical one; 0: nine tenths of that"),
       number<Scene>("damping", MEMBER(solve.damping), not_negative, "1/s", "transient: proportional to mass; 0: none"),
       number<Scene>("duration", MEMBER(loading.duration), above_zero, "s",
                     "transient: of the 3-4-5 curve by which load and forces come, and of the run; 1 when absent"),
       file<Scene>("curve", MEMBER(loading.curve),
                   "CSV time,factor from 0,0 on, by which load and forces come, in place of the 3-4-5 curve; its "
                   "times are seconds in a transient run, which ends with it"),
       choice<Scene>("curve_join", MEMBER(loading.curve_join),
                     std::vector<std::pair<std::string, solve::LoadCurve::Join>>{
                         {"smooth", solve::LoadCurve::Join::smooth}, {"straight", solve::LoadCurve::Join::straight}},
                     "of the curve's rows: by 3-4-5 polynomials or straight lines"),
       vector<Scene>("gravity", MEMBER(loading.gravity), "m/s2, LPS",
                     "on a patient who sits 0,0,-9.81, who lies on the back 0,9.81,0; it comes with the load's curve"),
       number<Scene>(
           "region",
           MEMBER(solve.region), not_negative, "mm",
           "solve only what a coarse solution moves by more, elsewhere that is the result; 0: the whole body"),
       number<Scene>("max_steps", MEMBER(solve.max_steps), {.low = 1}, "", "give up after so many steps"),
       number<Scene>(
           "snapshot_every", MEMBER(solve.snapshot_every), not_negative, "",
           "steps between displacements kept for steps.pvd, each 20th at the most, in time each 50th; 0: none"),
       command(StageId::solve)}};
}

Element register_element() {
  return {"register",
          "Displacement to fields and warped images.",
          false,
          always,
          nothing,
          {number<Scene>("fade", MEMBER(registration.fade), above_zero, "mm",
                         "outside the brain the field goes to zero over this distance"),
           choice<Scene>(
               "interpolation", MEMBER(registration.interpolation),
               std::vector<std::pair<std::string, registration::Interpolation>>{
                   {"linear", registration::Interpolation::linear}, {"bspline", registration::Interpolation::bspline}},
               "of the warped image"),
           number<Scene>("inverse_tolerance", MEMBER(registration.inverse_tolerance), above_zero, "mm",
                         "of the inversion of the field"),
           command(StageId::registration)}};
}

/// The values of a setting: each must be one that the setting's own option takes.
Option<Scene> values_of(const TradeoffSetting& setting) {
  const auto access = [setting](auto& scene) -> auto& {
    return (*scene.tradeoff).*setting.list;
  };
  Option<Scene> option =
      text<Scene>(setting.name, access, "values of " + std::string(setting.element) + "." + setting.name);
  option.allowed = "values of that option, separated by blanks or commas";
  option.set = [=](Scene& scene, const std::string& words) {
    const Option<Scene>* listed = find_option(find_element(setting.element)->options, setting.name);
    const std::vector<std::string> values = split_words(words);
    for (const std::string& value : values) {
      if (Scene scratch; !listed->set(scratch, value)) {
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
  element.options.push_back(number<Scene>("reference_nodes", MEMBER(tradeoff->reference_nodes),
                                          {.low = 20, .high = 10000000}, "",
                                          "of the much finer solution that they are measured against"));
  return element;
}

std::vector<Element> make_elements() {
  std::vector<Element> elements = {image_element()};
  for (Element& element : load_elements()) {
    elements.push_back(std::move(element));
  }
  elements.push_back(part(
      "contact", "The brain slides in the rigid skull, without friction.", &Scene::contact,
      {file<Scene>("skull", MEMBER(contact->skull), "surface of the skull's inside; empty: the segment stage's")}));
  elements.push_back(cuts_element());
  elements.push_back(resection_element());
  elements.push_back(part("landmarks", "Points to move with the brain.", &Scene::landmarks,
                          {required(file<Scene>("file", MEMBER(landmarks.value()), "markups: .mrk.json or .fcsv"))}));
  elements.push_back(segment_element());
  elements.push_back(discretise_element());
  elements.push_back(solve_element());
  elements.push_back(register_element());
  elements.push_back({"report", "The page of pictures.", false, always, nothing, {command(StageId::report)}});
  elements.push_back(tradeoff_element());
  return elements;
}

/// Sets law and all constants; those that come after it override them.
Option<Tissue> material_option() {
  Option<Tissue> option{"material", "",    "", "law and constants from the literature; others beside it override them",
                        false,      false, {}, {}};
  for (const std::string& name : solve::material_names()) {
    option.allowed += name + " | ";
  }
  option.allowed += "nothing";
  option.set = [](Tissue& tissue, const std::string& name) {
    const auto material = solve::named_material(name);
    if (material) {
      tissue.material = *material;
    }
    if (material || name.empty()) {
      tissue.named_material = name;
    }
    return material || name.empty();
  };
  option.get = [](const Tissue& tissue) { return tissue.named_material; };
  return option;
}

std::vector<Option<Tissue>> make_tissue_options() {
  return {required(number<Tissue>("label", MEMBER(label), {.low = 1, .high = 32767}, "", "in the label map")),
          text<Tissue>("name", MEMBER(name), "for people"),
          material_option(),
          choice<Tissue>("law", MEMBER(material.law),
                         std::vector<std::pair<std::string, solve::Law>>{
                             {"neo_hookean", solve::Law::neo_hookean},
                             {"ogden", solve::Law::ogden},
                             {"saint_venant_kirchhoff", solve::Law::saint_venant_kirchhoff},
                             {"linear_elastic", solve::Law::linear_elastic}},
                         "material law"),
          number<Tissue>("youngs_modulus", MEMBER(material.youngs_modulus), above_zero, "Pa",
                         "stiffness at rest; the law ogden takes its terms instead"),
          number<Tissue>("poisson_ratio", MEMBER(material.poisson_ratio),
                         {.low = -1, .high = 0.5, .low_allowed = false, .high_allowed = false}, "",
                         "0.5 would be incompressible"),
          number<Tissue>("density", MEMBER(material.density), above_zero, "kg/m3", "mass"),
          pairs<Tissue>("ogden", MEMBER(material.ogden), "pairs mu,alpha separated by semicolons, or nothing",
                        "Pa and 1", "terms of the law ogden, as 842,-4.7"),
          pairs<Tissue>("prony", MEMBER(material.prony), "pairs share,time separated by semicolons, or nothing",
                        "1 and s", "how the isochoric stress relaxes, as 0.450,0.50; 0.365,50")};
}

std::vector<Option<CutFile>> make_cut_options() {
  return {required(file<CutFile>("file", MEMBER(file),
                                 "the sheet, a surface: .vtp, .stl, .ply, .obj; a .vtp may say "
                                 "in the point array time when the cut gets to each point")),
          number<CutFile>("start", MEMBER(timing.start), not_negative, "time of the load's curve",
                          "when it begins; without it and a speed the body is cut from the start"),
          number<CutFile>("speed", MEMBER(timing.speed), above_zero, "mm in a unit of that time",
                          "at which it goes on; without it the whole cut is there at its start"),
          vector<CutFile>("direction", MEMBER(timing.direction), "any length",
                          "in which a sheet is cut at that speed; 0 0 0: none")};
}

#undef MEMBER

}  // namespace

const std::vector<Element>& scene_elements() {
  static const std::vector<Element> elements = make_elements();
  return elements;
}

const std::vector<Option<Tissue>>& tissue_options() {
  static const std::vector<Option<Tissue>> options = make_tissue_options();
  return options;
}

const std::vector<Option<CutFile>>& cut_options() {
  static const std::vector<Option<CutFile>> options = make_cut_options();
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
