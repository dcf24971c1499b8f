// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/phantom/phantom.hpp"
#include "register/interface/options.hpp"
#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/write_text.hpp"
#include "segmentation/segment.hpp"

namespace brainshift::pipelines {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;
namespace tissue = segmentation::default_label;

json as_json(const Eigen::Vector3d& v) {
  return json::array({v.x(), v.y(), v.z()});
}

// 3D Slicer's markups format.
json markups(const std::vector<Landmark>& landmarks) {
  json points = json::array();
  for (const auto& landmark : landmarks) {
    points.push_back({{"id", std::to_string(points.size() + 1)},
                      {"label", landmark.name},
                      {"position", as_json(landmark.position)},
                      {"positionStatus", "defined"}});
  }
  return {
      {"@schema",
       "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
       "markups-schema-v1.0.3.json#"},
      {"markups",
       {{{"type", "Fiducial"}, {"coordinateSystem", "LPS"}, {"coordinateUnits", "mm"}, {"controlPoints", points}}}}};
}

json answers(const Phantom& phantom) {
  const std::map<std::string, std::uint16_t> tissues = {
      {"parenchyma", tissue::parenchyma}, {"ventricles", tissue::ventricles},
      {"tumour", tissue::tumour},         {"csf", tissue::csf},
      {"skull", tissue::skull},           {"skin", tissue::skin}};
  json volumes;
  for (const auto& [name, label] : tissues) {
    volumes[name] = {{"label", label}, {"volume", tissue_volume(phantom.head, label)}};
  }
  json landmarks;
  for (const auto& landmark : phantom.landmarks) {
    landmarks[landmark.name] = as_json(landmark.position);
  }
  const Opening& opening = phantom.opening;
  return {{"about", "What is known exactly of this phantom: mm, mm³, frame LPS. The run does not read it."},
          {"scale", phantom.head.scale},
          {"tissues", volumes},
          {"brain_volume", phantom.head.brain.volume()},
          {"opening",
           {{"centre", as_json(opening.centre)},
            {"outward_normal", as_json(opening.normal)},
            {"radius", opening.radius},
            {"depth", opening.depth}}},
          {"landmarks", landmarks}};
}

// As many nodes as the voxels can tell apart, 12,000 at most.
int wanted_nodes(const Phantom& phantom) {
  const double voxels = phantom.head.brain.volume() / phantom.geometry.voxel_volume();
  return static_cast<int>(std::clamp(std::round(voxels / 600) * 100, 600.0, 12000.0));
}

/// The stage's line where the voxels are too coarse for the fade that it has by default; else nothing.
std::string fade_of_coarse(const ImageGeometry& geometry) {
  const double shell = 2 * geometry.spacing.norm();
  if (shell < registration::RegisterOptions{}.fade) {
    return {};
  }
  return "  <stage name=\"register\" fade=\"" + std::to_string(std::lround(1.5 * shell)) + "\"/>\n";
}

std::string scene_text(const Phantom& phantom, bool has_gap) {
  const int nodes = wanted_nodes(phantom);
  const double edge = std::round(10 * std::cbrt(phantom.head.brain.volume() / nodes)) / 10;
  std::ostringstream text;
  text << R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- A synthetic head: nested smooth shapes whose volumes are known (answers.json), an oblique image frame, and an
     opening over the tumour through which the brain is seen to sink. -->
<scene version="1">
  <image t1="t1.nii.gz" labels="labels.nii.gz" other_labels="4 5 6")"
       << (has_gap ? " skull_label=\"5\"" : "") << R"(/>
  <!-- E in Pa, density in kg/m³: constants of the brain-shift literature (Wittek, Miller, Joldes and others). -->
  <tissues>
    <tissue label="1" name="parenchyma" youngs_modulus="3000" poisson_ratio="0.49" density="1000"/>
    <tissue label="2" name="ventricles" youngs_modulus="10" poisson_ratio="0.1" density="1000"
            room="drained"/>
    <tissue label="3" name="tumour" youngs_modulus="9000" poisson_ratio="0.49" density="1000"/>
  </tissues>
  <load>
    <craniotomy file="craniotomy.csv"/>
  </load>
  <contact/>
  <landmarks file="landmarks.mrk.json"/>
  <stage name="segment" edge_length=")"
       << edge << R"("/>
  <stage name="discretise" nodes=")"
       << nodes << "\"/>\n"
       << fade_of_coarse(phantom.geometry) << "</scene>\n";
  return text.str();
}

}  // namespace

void write_phantom(const PhantomOptions& options, const fs::path& out) {
  const Phantom phantom = make_phantom(options);
  make_folder(out);
  write_image(out / "t1.nii.gz", sample_t1(phantom, options.seed));
  write_image(out / "labels.nii.gz", sample_labels(phantom));
  solve::write_craniotomy_csv(out / "craniotomy.csv", phantom.load);
  write_text(out / "landmarks.mrk.json", markups(phantom.landmarks).dump(2) + "\n");
  write_text(out / "answers.json", answers(phantom).dump(2) + "\n");
  write_text(out / "scene.xml", scene_text(phantom, options.csf_gap > 0));
}

}  // namespace brainshift::pipelines
