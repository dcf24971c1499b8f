// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/phantom/texture.hpp"

#include <cmath>

namespace brainshift::pipelines {

namespace {

// SplitMix64 (Steele, Lea & Flood 2014): every bit of the result depends on every bit of the input.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double corner_value(const Eigen::Vector3d& corner, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (int axis = 0; axis < 3; ++axis) {
    hash = mix(hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(corner[axis])));
  }
  return static_cast<double>(hash >> 11) * 0x1.0p-52 - 1.0;
}

double smooth_step(double t) {
  return t * t * t * (10 + t * (6 * t - 15));
}

double mix_values(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

double smooth_noise(const Eigen::Vector3d& point, double wavelength, std::uint64_t seed) {
  const Eigen::Vector3d p = point / wavelength;
  const Eigen::Vector3d base = p.array().floor();
  const Eigen::Vector3d t = (p - base).unaryExpr(&smooth_step);
  double along_z[2];
  for (int k = 0; k < 2; ++k) {
    double along_y[2];
    for (int j = 0; j < 2; ++j) {
      const double a = corner_value(base + Eigen::Vector3d(0, j, k), seed);
      const double b = corner_value(base + Eigen::Vector3d(1, j, k), seed);
      along_y[j] = mix_values(a, b, t.x());
    }
    along_z[k] = mix_values(along_y[0], along_y[1], t.y());
  }
  return mix_values(along_z[0], along_z[1], t.z());
}

}  // namespace brainshift::pipelines
