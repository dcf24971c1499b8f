// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solve/device/view.hpp"

namespace brainshift::solve::device {

// What many loads of one body read and change together, as it lies in the memory of a device. What they have in common
// lies as it does of one load. What differs lies member by member: [of what][member], [of what][x, y, z][member].

/// Members that are stepped together: a warp has as many lanes.
constexpr int most_members = 32;

/// Groups of threads that a block of a GPU has, a warp each.
constexpr int groups_of_block = 16;

/// Some of the members, one bit each.
using Members = std::uint32_t;

/// Where the i-th number of a member lies.
BRAINSHIFT_ON_DEVICE inline std::int64_t at_member(std::int64_t i, int member) {
  return i * most_members + member;
}

/// Points of a patch that one group of threads handles one after the other.
struct Piece {
  std::int32_t first_point, points, patch;
};

struct PatchOfPieces {
  std::int32_t first_piece, pieces, material;
};

/// Surface nodes within a skull, and what pushes them.
struct ContactOfEach : NodesInSkull {
  double* inverse_row_sum;  ///< D⁻¹, [row][member]
  Members* touching;        ///< one a row: those that are pushed there
  double* push;             ///< D⁻¹ δ, [row][x, y, z][member], of those that are
};

/// Essential conditions of a component: EssentialConditions::Component.
struct ConditionsOfEach : SparseRows {
  const double* compliance;  ///< C/s, dense; nullptr: held exactly
  double* prescribed;        ///< mm, [row][member]; so are the following
  double* residual;
  double* multiplier[2];
  double* inverse;  ///< −(V M⁻¹ Vᵀ + C/(sα))⁻¹, dense: [row][column][member]
  double* column;   ///< of the elimination: two and the diagonal
  bool own;         ///< false: the inverse is that of the component before
};

/// Sums of one step, of each member; then the largest of something.
struct StepOfEach {
  enum : int { force_work, multiplier_work, minus_jacobian, count };
  static constexpr int sums = minus_jacobian;
  double of[count][most_members];
};

/// Of a state that is looked at.
struct LookOfEach {
  enum : int {
    stiffness,
    inertia_before,
    inertia_now,
    inertia_two,  ///< of the last two steps
    window_stiffness,
    window_inertia,  ///< since the look before
    span_product,
    span_squares,
    spring_work,
    first_largest,
    longest_step = first_largest,  ///< squared
    farthest,
    span_of_nodes,
    span_longest,
    count
  };
  static constexpr int sums = first_largest;
  double of[count][most_members];
};

/// What an order leaves to be read by the host.
struct RecordOfEach {
  int steps;
  Members halted;                   ///< those whose J fell to the order's `halt_below`
  int singular[most_members];       ///< of weigh: conditions repeat each other
  double stiffer[most_members];     ///< of follow: than the masses allow for, times
  double eigenvalue[most_members];  ///< the largest, of measure_tightness
  double energy[most_members];      ///< of measure_energy: strain energy, 1e-9 J
  StepOfEach step[most_steps + 1];  ///< as Record::step
  LookOfEach look;
};

/// What a team does with many members in one go.
enum class TaskOfEach : int { step, look, follow, weigh, hold, measure_tightness, measure_energy };

/// What is to be done, by the numbers of the host.
struct OrderOfEach {
  Members who = 0;  ///< the others are left as they are
  int steps = 0;
  int first = 0, parity = 0;  ///< as in Order
  int states = 0;             ///< looks so far
  int iterations = 0;         ///< of the power iteration
  double mode_size = 0;       ///< root mean square of its modes, mm
  double alpha = 0, mass_margin = 1;
  double beta[most_members] = {}, halt_below[most_members] = {}, mass_scale[most_members] = {};
};

template <class Scalar>
struct ViewOfEach {
  std::int32_t nodes, pieces, patches, shares, slots;
  const Piece* piece;
  const PatchOfPieces* patch;
  const double* volume;
  const double* mode;  ///< pressure modes, 4 a point; nullptr: each point is a patch
  const std::int64_t* pair_begin;
  const Pair<Scalar>* pair;         ///< by point; `other` is a node
  const std::int32_t* share_begin;  ///< (shares + 1): slots that one block handles, about as many pairs each
  const std::int64_t* slot_begin;
  const Pair<Scalar>* slot_pair;  ///< by slot; `other` is a point
  const std::int32_t* slot_node;
  const std::int64_t* node_begin;
  const std::int32_t* node_slot;

  std::int64_t touches;
  const std::int64_t* touch_begin;  ///< (slots + 1)
  const Touch* touch;
  const double* touch_reach;              ///< Σ w |B|
  const std::int64_t* patch_touch_begin;  ///< (patches + 1)
  const std::int64_t* patch_touch;        ///< their numbers in `touch`
  const std::int32_t* patch_touch_node;

  Law* law;                ///< [material][member]
  std::int32_t* is_plain;  ///< one a material: 1 where the law of all members is neo-Hookean
  double* shear_modulus;   ///< [material][member], Pa
  double* bulk_modulus;
  double* firmness;  ///< [node][member]
  double* external;  ///< f_ext under the whole load, [node][x, y, z][member], µN; nullptr: none

  double* displacement[3];  ///< û, mm, [node][x, y, z][member]; so are the following
  double* force_at[2];      ///< f_int − f_ext, µN
  double* mode_of_body;     ///< of the power iteration
  double* place_at_look;
  double* force_at_look;
  double* span_state[3];
  double* mass;  ///< [node][member]; so are the following
  double* inverse_mass;
  double* stiffer_mass;  ///< what weigh takes
  Scalar* tensor;        ///< [point][9][member]: F − 1, then w P; entry by entry
  double* seen;          ///< [piece][mode][member]: Σ w ψ θ
  Scalar* slot_force;    ///< [slot][x, y, z][member]

  double* touch_norm;   ///< [touch][mode][member]: |b|
  double* point_bound;  ///< [point][3][member]: a SharedBound
  double* patch_bound;
  double* patch_total;  ///< [patch][mode][member]: Σ |b|/h
  double* slot_bound;   ///< [slot][member]

  double* fraction;  ///< of each member's load: now, and after each step of an order; [most_steps + 1][member]

  ContactOfEach contact;
  ConditionsOfEach condition[3];

  double* partial;  ///< sums of the blocks
  RecordOfEach* record;
};

}  // namespace brainshift::solve::device
