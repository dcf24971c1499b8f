// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "solve/ensemble/each_kernels.hpp"
#include "solve/force/point_blocks.hpp"
#include "solve/force/point_laws.hpp"

namespace brainshift::solve {

/// A row of the material table as each member has it.
struct LawOfEach {
  std::vector<ElasticLaw> law;  ///< one a member
  bool neo_hookean = true;      ///< all of them: they are handled in registers, others member by member
  NumberOfEach<double> shear_modulus;
  DilatationModuli moduli;
};

/// What a thread works on a block in.
template <class Scalar>
struct EachRoom {
  std::vector<VectorOfEach<Scalar>> displacement;  ///< one a slot: û less that of the block's first slot
  std::vector<TensorOfEach<Scalar>> tensor;        ///< one a point of a batch: H, then stress times volume
  std::vector<NumberOfEach<double>> dilatation, pressure;
};

/// EachForce with slots' values kept as Scalar.
template <class Scalar>
class EachForceIn {
 public:
  EachForceIn(const PointBlocks& points, std::span<const PointLaws> laws);
  void find(const EachVectors& parameters, EachVectors& force);
  Numbers smallest_jacobian() const;
  EachNumbers stiffness_bound(const Chosen& asked) const;
  Numbers strain_energy() const;

 private:
  EachRoom<Scalar> room() const;
  void gather(const Block& block, EachRoom<Scalar>& room) const;
  void block_force(const Block& block, EachRoom<Scalar>& room);
  void find_pressures(std::span<const Patch> patches, EachRoom<Scalar>& room) const;
  void find_gradients(const Patch& patch, EachRoom<Scalar>& room) const;
  const LawOfEach& law_of(const Patch& patch) const { return laws_[static_cast<std::size_t>(patch.material)]; }

  const PointBlocks& points_;
  std::vector<LawOfEach> laws_;                   // one a row
  EachVectors parameters_;                        // of the last find()
  std::vector<VectorOfEach<Scalar>> slot_force_;  // of the blocks
  std::vector<NumberOfEach<double>> smallest_;    // θ, one a block
  std::vector<EachRoom<Scalar>> rooms_;           // one a thread
};

/// Internal force of the members of an ensemble. A block of points is handled by one thread at a time, and the blocks'
/// forces are added in their order: the result does not depend on the number of threads, nor a member's on the others.
class EachForce {
 public:
  /// laws: one a member, 1 to `members`, with the same rows, without swelling, plane stress or Prony terms; members
  /// that are not there have those of the first. points must outlive this.
  EachForce(const PointBlocks& points, std::span<const PointLaws> laws)
      : in_(points.precision() == Precision::single_precision ? In(EachForceIn<float>(points, laws))
                                                              : In(EachForceIn<double>(points, laws))) {}

  /// internal_force() of each member: parameters in mm, force in µN.
  void find(const EachVectors& parameters, EachVectors& force) {
    std::visit([&](auto& in) { in.find(parameters, force); }, in_);
  }

  /// J at the last find(), the least of the points and 1; NaN where one is.
  Numbers smallest_jacobian() const {
    return std::visit([](const auto& in) { return in.smallest_jacobian(); }, in_);
  }

  /// stiffness_bound() of each member that is asked for, at the last find(); of the others nothing that holds.
  EachNumbers stiffness_bound(const Chosen& asked) const {
    return std::visit([&](const auto& in) { return in.stiffness_bound(asked); }, in_);
  }

  /// point_state().strain_energy of each member at the last find(), 1e-9 J.
  Numbers strain_energy() const {
    return std::visit([](const auto& in) { return in.strain_energy(); }, in_);
  }

 private:
  using In = std::variant<EachForceIn<double>, EachForceIn<float>>;
  In in_;
};

/// H of a member at a point, as F.
template <class Scalar>
Eigen::Matrix3d gradient_of(const TensorOfEach<Scalar>& tensor, std::size_t member) {
  Eigen::Matrix3d gradient;
  for (Eigen::Index k = 0; k < 9; ++k) {
    gradient.data()[k] = (k % 4 == 0 ? 1 : 0) + static_cast<double>(tensor.entry[k][member]);
  }
  return gradient;
}

}  // namespace brainshift::solve
