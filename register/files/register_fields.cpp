// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include <vtkPointData.h>

#include <limits>

#include "register/field/field_sampler.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::registration {

RegisterFields::RegisterFields(std::filesystem::path folder, Towards towards, std::filesystem::path solution)
    : folder_(std::move(folder)), towards_(towards), solution_file_(std::move(solution)) {
  for (const char* name : {forward_name, resampling_name}) {
    if (!std::filesystem::exists(folder_ / name)) {
      refuse(folder_, std::string("there is no ") + name + " in it; give the --out folder of a finished run");
    }
  }
}

const VectorImage& RegisterFields::read(bool forward) {
  std::optional<VectorImage>& field = forward ? forward_ : resampling_;
  if (!field) {
    field = read_vector_image(folder_ / (forward ? forward_name : resampling_name));
  }
  return *field;
}

const std::optional<LabelMap>& RegisterFields::taken_out() {
  if (!looked_for_removed_ && std::filesystem::exists(folder_ / removed_name)) {
    removed_ = read_label_map(folder_ / removed_name);
  }
  looked_for_removed_ = true;
  return removed_;
}

const std::optional<LabelMap>& RegisterFields::removed() {
  static const std::optional<LabelMap> nothing;
  return towards_ == Towards::intraop ? taken_out() : nothing;
}

bool RegisterFields::is_removed(const Eigen::Vector3d& place) {
  if (!taken_out()) {
    return false;
  }
  if (towards_ == Towards::intraop) {
    return label_at(*removed_, place) != 0;
  }
  const FieldSampler sampler(of_points());
  const Eigen::Vector3d index = sampler.to_index(place);
  return sampler.inside(index) && label_at(*removed_, place + sampler.value(index)) != 0;
}

void RegisterFields::read_nodes() {
  if (solution_) {
    return;
  }
  solution_ = std::filesystem::exists(solution_file_) ? read_solution(solution_file_) : Solution{};
  if (!solution_->estimated_error.empty()) {
    at_nodes_.push_back({"estimated_error", solution_->estimated_error});
  }
  const std::filesystem::path deviations = solution_file_.parent_path() / "uncertainty.vtu";
  if (!solution_file_.empty() && std::filesystem::exists(deviations)) {
    at_nodes_.push_back({"uncertainty", read_deviations(deviations)});
  }
  if (at_nodes_.empty()) {
    return;
  }
  Eigen::MatrixXd columns(solution_->positions.rows(), static_cast<Eigen::Index>(at_nodes_.size()));
  for (std::size_t c = 0; c < at_nodes_.size(); ++c) {
    const std::vector<double>& values = at_nodes_[c].values;
    if (values.size() != static_cast<std::size_t>(columns.rows())) {
      refuse(deviations, "has " + std::to_string(values.size()) + " nodes, " + solution_file_.filename().string() +
                             " beside it " + std::to_string(columns.rows()) + "; solve again");
    }
    columns.col(static_cast<Eigen::Index>(c)) = Eigen::VectorXd::Map(values.data(), columns.rows());
  }
  look_up_ = nodal_look_up(*solution_, std::move(columns), towards_ == Towards::preop,
                           std::numeric_limits<double>::quiet_NaN());
}

std::vector<PointValues> RegisterFields::values_of_points(const Points& points) {
  read_nodes();
  if (at_nodes_.empty()) {
    return {};
  }
  Eigen::MatrixXd found = look_up_(points);
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    if (is_removed(points.row(p))) {
      found.row(p).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  std::vector<PointValues> values;
  for (std::size_t c = 0; c < at_nodes_.size(); ++c) {
    const auto column = found.col(static_cast<Eigen::Index>(c));
    values.push_back({at_nodes_[c].name, {column.begin(), column.end()}});
  }
  return values;
}

std::vector<std::pair<std::string, ScalarImage>> RegisterFields::values_on(const ImageGeometry& grid) {
  read_nodes();
  const bool moved = towards_ == Towards::intraop;
  const VectorImage still{{.size = {1, 1, 1}}, {{0, 0, 0}}};  // outside its grid nothing moves either
  std::vector<std::pair<std::string, ScalarImage>> images;
  for (const PointValues& each : at_nodes_) {
    const ScalarImage coarse = nodal_values_on(*solution_, each.values, moved, grid_around_nodes(*solution_, moved));
    images.emplace_back(each.name, warp(coarse, still, Interpolation::linear, grid));
  }
  return images;
}

std::vector<double> read_deviations(const std::filesystem::path& file) {
  const auto grid = vtu::read(file);
  const auto nodes = static_cast<std::size_t>(grid->GetNumberOfPoints());
  std::vector<double> values = vtu::array(file, *grid->GetPointData(), "uncertainty", nodes);
  if (values.empty()) {
    refuse(file, "it has no point array `uncertainty`.");
  }
  return values;
}

}  // namespace brainshift::registration
