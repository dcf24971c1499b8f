// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include "register/field/nodal_values.hpp"
#include "register/warp/warp.hpp"
#include "segmentation/files/refuse.hpp"
#include "solve/output/solution_file.hpp"

namespace brainshift::registration {

namespace {

constexpr const char* forward_name = "preop_to_intraop.nii.gz";
constexpr const char* resampling_name = "intraop_to_preop.nii.gz";

}  // namespace

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

const Solution* RegisterFields::estimate() {
  if (!solution_) {
    solution_ = std::filesystem::exists(solution_file_) ? read_solution(solution_file_) : Solution{};
  }
  return solution_->estimated_error.empty() ? nullptr : &*solution_;
}

std::optional<std::vector<double>> RegisterFields::error_of_points(const Points& points) {
  const Solution* solution = estimate();
  if (solution == nullptr) {
    return std::nullopt;
  }
  return estimated_error_at(*solution, towards_ == Towards::preop, points);
}

std::optional<ScalarImage> RegisterFields::error_on(const ImageGeometry& grid) {
  const Solution* solution = estimate();
  if (solution == nullptr) {
    return std::nullopt;
  }
  const bool moved = towards_ == Towards::intraop;
  const ScalarImage coarse =
      nodal_values_on(*solution, solution->estimated_error, moved, grid_around_nodes(*solution, moved));
  const VectorImage still{{.size = {1, 1, 1}}, {{0, 0, 0}}};  // outside its grid nothing moves either
  return warp(coarse, still, Interpolation::linear, grid);
}

}  // namespace brainshift::registration
