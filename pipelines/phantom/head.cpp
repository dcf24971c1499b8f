// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/head.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "segmentation/segment.hpp"

namespace brainshift::pipelines {

namespace tissue = segmentation::default_label;
using Eigen::Vector3d;

double Egg::level(const Vector3d& point) const {
  const Vector3d p = point - centre;
  const double along = p.y() / half_length;
  const double width = half_width * std::max(0.1, 1.0 + taper * along);
  return Vector3d(p.x() / width, along, p.z() / (p.z() > 0 ? height : depth)).norm();
}

// A cut across y is two half ellipses of half width w(1 - η²)½(1 + taper η); the odd term integrates to nothing.
double Egg::volume() const {
  return 2.0 / 3.0 * std::numbers::pi * half_width * half_length * (height + depth);
}

double Ellipsoid::level(const Vector3d& point) const {
  return (axes.transpose() * (point - centre)).cwiseQuotient(semi_axes).norm();
}

double Ellipsoid::volume() const {
  return 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
}

namespace {

Egg make_egg(const Vector3d& centre, double scale, double thickness) {
  const double t = thickness;
  return {.centre = centre,
          .half_width = scale * (58 + t),
          .half_length = scale * (75 + t),
          .height = scale * (60 + t),
          .depth = scale * (50 + t),
          .taper = 0.10};
}

// side: +1 for the patient's left (x of LPS points left), -1 for the right.
Ellipsoid make_ventricle(const Vector3d& centre, double scale, double side) {
  const Eigen::AngleAxisd outward(-0.25 * side, Vector3d::UnitZ());
  const Eigen::AngleAxisd upward(0.20, Vector3d::UnitX());
  return {.centre = centre + scale * Vector3d(14 * side, 2, 6),
          .semi_axes = scale * Vector3d(7, 26, 10),
          .axes = (outward * upward).toRotationMatrix()};
}

}  // namespace

Head make_head(const Vector3d& centre, double scale, double csf_gap) {
  return {.scale = scale,
          .skin = make_egg(centre, scale, csf_gap + 12),
          .skull = make_egg(centre, scale, csf_gap + 6),
          .skull_inside = make_egg(centre, scale, csf_gap),
          .brain = make_egg(centre, scale, 0),
          .ventricles = {make_ventricle(centre, scale, 1), make_ventricle(centre, scale, -1)},
          .tumour = {.centre = centre + scale * Vector3d(30, -22, 26),
                     .semi_axes = scale * Vector3d(11, 13, 10),
                     .axes = Eigen::AngleAxisd(0.5, Vector3d(1, 1, 0).normalized()).toRotationMatrix()}};
}

std::uint16_t tissue_at(const Head& head, const Vector3d& point) {
  if (head.skin.level(point) > 1) {
    return 0;
  }
  if (head.skull.level(point) > 1) {
    return tissue::skin;
  }
  if (head.skull_inside.level(point) > 1) {
    return tissue::skull;
  }
  if (head.brain.level(point) > 1) {
    return tissue::csf;
  }
  if (head.tumour.level(point) <= 1) {
    return tissue::tumour;
  }
  const bool in_ventricle = std::ranges::any_of(head.ventricles, [&](const auto& v) { return v.level(point) <= 1; });
  return in_ventricle ? tissue::ventricles : tissue::parenchyma;
}

double tissue_volume(const Head& head, std::uint16_t label) {
  const double ventricles = head.ventricles[0].volume() + head.ventricles[1].volume();
  switch (label) {
    case tissue::parenchyma:
      return head.brain.volume() - ventricles - head.tumour.volume();
    case tissue::ventricles:
      return ventricles;
    case tissue::tumour:
      return head.tumour.volume();
    case tissue::csf:
      return head.skull_inside.volume() - head.brain.volume();
    case tissue::skull:
      return head.skull.volume() - head.skull_inside.volume();
    case tissue::skin:
      return head.skin.volume() - head.skull.volume();
    default:
      throw std::invalid_argument("the phantom has no tissue " + std::to_string(label));
  }
}

}  // namespace brainshift::pipelines
