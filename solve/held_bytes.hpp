// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace brainshift::solve {

/// Bytes that the solver holds while it steps, part by part; what a model does not have is 0. The model itself and what
/// was only needed to prepare it do not count.
struct HeldBytes {
  std::size_t shape_functions = 0;       ///< derivatives and slots of all pairs, volumes, blocks; values at the nodes
  std::size_t nodal_vectors = 0;         ///< parameters, forces, masses, and the scratch of blocks and points
  std::size_t pressure_patches = 0;      ///< pressure modes
  std::size_t essential_conditions = 0;  ///< their shape functions and sparse factor
  std::size_t contact = 0;    ///< distances to the skull, shape functions of nodes that may touch it, or the other face
  std::size_t viscosity = 0;  ///< what points remember of their stress
  std::size_t external_forces = 0;
  std::size_t cuts = 0;  ///< the body that is cut; where cuts go on what it is laid out from, too

  std::size_t total() const {
    return shape_functions + nodal_vectors + pressure_patches + essential_conditions + contact + viscosity +
           external_forces + cuts;
  }
};

template <class T>
std::size_t bytes(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace brainshift::solve
