// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/force/point_strain.hpp"

#include <Eigen/Eigenvalues>

#include "solve/force/internal_force.hpp"
#include "solve/force/patch_dilatation.hpp"

namespace brainshift::solve {

namespace {

double largest_eigenvalue(const Eigen::Matrix2d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[1];
}

template <class ElasticLaw>
void add_patch(const PointBlocks& points, const Patch& patch, const ElasticLaw& law, const ForceScratch& scratch,
               std::vector<PointStrain>& strains) {
  const std::vector<Eigen::Matrix3d> gradients = gradients_of(points, patch, scratch);
  const Eigen::Vector4d dilatations = projected_dilatation(points, patch, law, gradients);
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const Deformation d(gradients[static_cast<std::size_t>(p - patch.first_point)]);
    const double pressure = point_pressure(law, dilatations.dot(points.modes_of(p)), law.dilatation(d));
    const Eigen::Matrix3d first_piola = law.isochoric_stress(d) + pressure * law.dilatation_slope(d);
    const Eigen::Matrix3d cauchy = first_piola * d.gradient.transpose() / d.jacobian;
    const Eigen::Matrix2d in_plane = d.gradient.topLeftCorner<2, 2>();
    const Eigen::Matrix2d c = in_plane.transpose() * in_plane;
    const Eigen::Matrix2d stress = cauchy.topLeftCorner<2, 2>();
    strains[static_cast<std::size_t>(p)] = {c, std::sqrt(largest_eigenvalue(c)),
                                            largest_eigenvalue((stress + stress.transpose()) / 2)};
  }
}

}  // namespace

std::vector<PointStrain> point_strains(const PointBlocks& points, const PointLaws& laws, const ForceScratch& scratch) {
  std::vector<PointStrain> strains(points.points());
  const auto patches = static_cast<std::int64_t>(points.patches.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < patches; ++i) {
    const Patch& patch = points.patches[static_cast<std::size_t>(i)];
    std::visit([&](const auto& law) { add_patch(points, patch, law, scratch, strains); },
               laws.elastic[static_cast<std::size_t>(patch.material)]);
  }
  return strains;
}

}  // namespace brainshift::solve
