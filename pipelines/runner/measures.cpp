// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/measures.hpp"

#include <cmath>

namespace brainshift::pipelines {

StageReport report_of(const segmentation::Segmentation& result) {
  StageReport report;
  report.sizes["surfaces"] = result.measures.size();
  if (result.labels) {
    report.sizes["voxels"] = result.labels->geometry.voxel_count();
  }
  for (const auto& [name, m] : result.measures) {
    report.measures[name] = {{"vertices", m.vertices},
                             {"triangles", m.triangles},
                             {"volume_mm3", m.volume},
                             {"label_volume_mm3", m.label_volume},
                             {"boundary_distance_95_mm", m.boundary_distance_95},
                             {"edge_length_mean_mm", m.edge_length_mean},
                             {"edge_length_target_mm", m.edge_length_target},
                             {"closed", m.closed},
                             {"outward", m.outward},
                             {"self_intersecting", m.self_intersecting},
                             {"repaired", m.repaired},
                             {"within_bounds", m.within_bounds}};
  }
  if (const auto& body = result.body) {
    report.measures["body"] = {{"tissue_volume_mm3", body->tissue_volume},
                               {"volume_mm3", body->volume},
                               {"loose_volume_mm3", body->loose_volume},
                               {"loose_pieces", body->loose_pieces}};
  }
  report.notes = result.notes;
  return report;
}

StageReport report_of(const discretise::DiscretiseMeasures& m) {
  StageReport report;
  report.sizes = {{"nodes", m.nodes},
                  {"surface_nodes", m.surface_nodes},
                  {"boundary_nodes", m.boundary_nodes},
                  {"cells", m.cells},
                  {"cut_cells", m.cut_cells},
                  {"removed_nodes", m.removed_nodes},
                  {"dropped_cells", m.dropped_cells}};
  report.measures = {{"spacing_mm", m.spacing},
                     {"mean_spacing_mm", m.mean_spacing},
                     {"smallest_distance_ratio", m.smallest_distance_ratio},
                     {"surface_volume_mm3", m.surface_volume},
                     {"cells_inside_volume_mm3", m.cells_inside_volume}};
  return report;
}

namespace {

/// What every solve has.
nlohmann::ordered_json json_of(const solve::SolveMeasures& m) {
  return {{"converged", m.converged},
          {"error_bound_mm", m.error_bound},
          {"mean_support", m.mean_support},
          {"grown_supports", m.grown_supports},
          {"outside_label", m.outside_label},
          {"precision", m.single_precision ? "single" : "double"},
          {"consistency_iterations", m.consistency_iterations},
          {"critical_step_s", m.critical_step},
          {"largest_displacement_mm", m.largest_displacement},
          {"constraint_error_mm", m.constraint_error},
          {"largest_penetration_mm", m.largest_penetration},
          {"smallest_jacobian", m.smallest_jacobian},
          {"largest_stretch", m.largest_stretch},
          {"compressed_share", m.compressed_share},
          {"pressed_share", m.pressed_share},
          {"seconds_setup", m.seconds_setup},
          {"seconds_stepping", m.seconds_stepping}};
}

/// Of a load with noise: beside what every solve has, under no name of its own.
void add_fit(const solve::MeasuredFit& fit, nlohmann::ordered_json& measures) {
  measures["weight_mJ"] = fit.weight;
  measures["noise_factor"] = fit.noise_factor;
  if (const solve::SmoothMotion& smooth = fit.smooth; smooth.length > 0) {
    measures["smooth_motion"] = {{"length_mm", smooth.length},
                                 {"along_mm", smooth.along},
                                 {"across_mm", smooth.across},
                                 {"fades", smooth.fades}};
  }
  for (const solve::WeightRow& row : fit.weights) {
    measures["weights"].push_back({{"weight_mJ", row.weight},
                                   {"misfit", row.misfit},
                                   {"energy_mJ", row.energy},
                                   {"log_likelihood", row.log_likelihood}});
  }
}

nlohmann::ordered_json json_of(const solve::CutMeasures& cut) {
  nlohmann::ordered_json json = {{"split_nodes", cut.split_nodes}, {"added_nodes", cut.added_nodes},
                                 {"advances", cut.advances},       {"touched_supports", cut.touched_supports},
                                 {"extent", cut.extent},           {"seconds", cut.seconds}};
  if (cut.faces) {
    json["touching_nodes"] = cut.faces->touching_nodes;
    json["largest_overlap_mm"] = cut.faces->largest_overlap;
  }
  return json;
}

nlohmann::ordered_json json_of(const solve::SeptumMeasures& septum) {
  return {{"area_mm2", septum.area},
          {"face_nodes", septum.face_nodes},
          {"touching_nodes", septum.touching_nodes},
          {"largest_penetration_mm", septum.largest_penetration}};
}

nlohmann::ordered_json json_of(const solve::ResectionMeasures& resection) {
  nlohmann::ordered_json json = {{"removed_nodes", resection.removed_nodes},
                                 {"removed_volume_mm3", resection.removed_volume}};
  if (resection.wall_nodes > 0) {
    json["wall_nodes"] = resection.wall_nodes;
    json["wall_area_mm2"] = resection.wall_area;
    json["touching_nodes"] = resection.touch.touching_nodes;
    json["largest_overlap_mm"] = resection.touch.largest_overlap;
    if (resection.volume) {
      json["cavity_volume_mm3"] = *resection.volume;
    }
  }
  return json;
}

}  // namespace

StageReport report_of(const solve::SolveResult& result, solve::Dynamics dynamics) {
  const solve::SolveMeasures& m = result.measures;
  StageReport report;
  report.failure = result.failure;
  report.sizes = {{"nodes", m.nodes},
                  {"integration_points", m.integration_points},
                  {"capped_points", m.capped_points},
                  {"pairs", m.pairs},
                  {"loaded_nodes", m.loaded_nodes},
                  {"contact_nodes", m.contact_nodes},
                  {"steps", m.steps}};
  report.measures = json_of(m);
  if (m.measured) {
    add_fit(*m.measured, report.measures);
  }
  if (std::isfinite(m.fewest_points)) {
    report.measures["fewest_points_a_node"] = m.fewest_points;
  }
  if (m.estimated_error_95) {
    report.measures["estimated_error_95_mm"] = *m.estimated_error_95;
  }
  if (!m.took.empty()) {
    report.measures["took"] = m.took;
  }
  if (m.region_nodes > 0) {
    report.measures["region"] = {{"nodes", m.region_nodes},
                                 {"share", static_cast<double>(m.region_nodes) / static_cast<double>(m.nodes)},
                                 {"coarse_error_mm", m.coarse_error}};
  }
  if (m.seconds_coarse > 0) {
    report.measures["seconds_coarse"] = m.seconds_coarse;
  }
  if (m.cut) {
    report.measures["cut"] = json_of(*m.cut);
  }
  if (m.septum) {
    report.measures["septum"] = json_of(*m.septum);
  }
  if (m.resection) {
    report.measures["resection"] = json_of(*m.resection);
  }
  report.measures.erase(dynamics == solve::Dynamics::transient ? "error_bound_mm" : "critical_step_s");
  return report;
}

StageReport report_of(const registration::Registration& result) {
  const registration::RegisterMeasures& m = result.measures;
  StageReport report;
  report.sizes = {{"voxels", result.forward.geometry.voxel_count()},
                  {"brain_voxels", m.brain_voxels},
                  {"moved_voxels", m.moved_voxels},
                  {"landmarks", result.landmarks.rows()}};
  if (m.cavity_voxels > 0) {
    report.sizes["cavity_voxels"] = m.cavity_voxels;
    report.sizes["cavity_landmarks"] = m.cavity_landmarks;
  }
  report.measures = {{"inverse_mean_mm", m.inverse_mean},
                     {"inverse_999_mm", m.inverse_999},
                     {"inverse_max_mm", m.inverse_max},
                     {"not_inverted", m.not_inverted},
                     {"jacobian_min", m.jacobian_min},
                     {"jacobian_max", m.jacobian_max},
                     {"field_jacobian_min", m.field_jacobian_min},
                     {"folded_voxels", m.folded_voxels},
                     {"largest_displacement_mm", m.largest_displacement},
                     {"fit_error_mm", m.fit_error},
                     {"voxels_without_nodes", m.without_nodes},
                     {"seconds_fields_and_images", m.seconds}};
  return report;
}

}  // namespace brainshift::pipelines
