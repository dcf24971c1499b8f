// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace brainshift::pipelines {

/// Smooth noise in [-1, 1] that varies over about `wavelength` (mm): values at the corners of a lattice, drawn from a
/// hash of the corner and the seed, joined with continuous second derivatives. Needs no memory and has no order of
/// evaluation: the same everywhere and for any number of threads. VTK's Perlin noise takes no seed.
double smooth_noise(const Eigen::Vector3d& point, double wavelength, std::uint64_t seed);

}  // namespace brainshift::pipelines
