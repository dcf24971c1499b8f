// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace brainshift::pipelines {

/// An egg: an ellipsoid that tapers along y and is flatter below than above. Axes along the world's (LPS), mm.
/// Its boundary is level() = 1; inside is less.
struct Egg {
  Eigen::Vector3d centre;
  double half_width;   ///< along x, at the centre
  double half_length;  ///< along y
  double height;       ///< upwards from the centre
  double depth;        ///< downwards from the centre
  double taper;        ///< relative change of the width from the centre to the back

  double level(const Eigen::Vector3d& point) const;
  double volume() const;  ///< exact, mm³
};

/// An ellipsoid with its own axes (columns of `axes`, orthonormal). Boundary at level() = 1.
struct Ellipsoid {
  Eigen::Vector3d centre;
  Eigen::Vector3d semi_axes;
  Eigen::Matrix3d axes;

  double level(const Eigen::Vector3d& point) const;
  double volume() const;  ///< exact, mm³
};

/// A synthetic head. The shapes are nested; ventricles and tumour lie in the brain and do not meet, so that the volume
/// of every tissue is known exactly.
struct Head {
  double scale;  ///< 1: a brain 116 mm wide and 150 mm long
  Egg skin;
  Egg skull;
  Egg skull_inside;
  Egg brain;
  std::array<Ellipsoid, 2> ventricles;  ///< left, right
  Ellipsoid tumour;
};

/// csf_gap: thickness of the fluid between brain and skull, mm at scale 1; 0 for none.
Head make_head(const Eigen::Vector3d& centre, double scale, double csf_gap);

/// Label at a point (numbers of segmentation::default_label), 0 outside the head.
std::uint16_t tissue_at(const Head& head, const Eigen::Vector3d& point);

/// Exact volume of a tissue, mm³.
double tissue_volume(const Head& head, std::uint16_t label);

/// What a T1-weighted image would show at a point: tissue contrast, folds, texture. A function of the place in the
/// head alone, so that any image grid samples the same head.
double t1_intensity(const Head& head, const Eigen::Vector3d& point, std::uint64_t seed);

}  // namespace brainshift::pipelines
