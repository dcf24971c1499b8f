// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "segmentation/geometry/distance_grid.hpp"
#include "solve/device/law.hpp"

namespace brainshift::solve::device {

// What a step reads and changes, as it lies in the memory of a device: plain arrays. Numbers of points, patches, slots
// and nodes count from 0 over the whole body where nothing else is said.

/// A point and a node of its support, with ∂φ/∂X, 1/mm. One load of a register.
template <class Scalar>
struct alignas(4 * sizeof(Scalar)) Pair {
  Scalar derivative[3];
  std::int32_t other;  ///< slot, or point, of the cluster: the one that the list is not of
};

constexpr std::int32_t slice_points = 8, slice_lanes = 4;  // of the Slices

/// A vector at a slot.
template <class Scalar>
struct alignas(4 * sizeof(Scalar)) SlotVector {
  Scalar of[4];
};

/// Points that one multiprocessor handles at a time, its patches whole. Its nodes are its slots.
struct Cluster {
  std::int32_t first_point, points, first_patch, patches, slots;
  std::int64_t first_slot;
};

struct PatchPoints {
  std::int32_t first_point, points, material;
};

/// The pairs of a slot with the points of one patch.
struct Touch {
  std::int64_t first;  ///< in `slot_pair`
  std::int32_t pairs, patch;
};

/// A bound, and how the nodes share it: NodeShares.
struct SharedBound {
  double scale;
  double per_firmness;  ///< 1 over that of the firmest node
  double least;
};

/// Shape functions V at some places, compressed rows, and Vᵀ of the nodes that are in any.
struct SparseRows {
  std::int32_t count = 0;
  const std::int64_t* begin;
  const std::int32_t* node;  ///< ascending in a row
  const double* shape;
  std::int32_t moved = 0;  ///< nodes
  const std::int32_t* moved_node;
  const std::int64_t* moved_begin;
  const std::int32_t* moved_row;
  const double* moved_shape;
};

/// Surface nodes within a skull: Contact.
struct NodesInSkull : SparseRows {
  const double* position;    ///< undeformed, mm, 3 a row
  const double* allowed;     ///< mm
  const double* column_sum;  ///< Σ |V|, one a node of the body
  DistanceGrid skull;
};

/// The same with what pushes them.
struct TouchingNodes : NodesInSkull {
  double* inverse_row_sum;  ///< D⁻¹
  double* push;             ///< D⁻¹ δ, 3 a row
  double* pushed;           ///< Vᵀ push of the last step, 4 a node of the body
};

/// Essential conditions of a component: EssentialConditions::Component.
struct Conditions : SparseRows {
  const double* prescribed;  ///< mm
  const double* loaded;      ///< 1, else 0
  const double* compliance;  ///< C/s, dense; nullptr: held exactly
  double* residual;
  double* multiplier[2];
  double* inverse;   ///< −(V M⁻¹ Vᵀ + C/(sα))⁻¹, dense
  double* panel;     ///< of the sweeps: columns, twice as many as are swept at once
  double* diagonal;  ///< before them
  bool own;          ///< false: the inverse is that of the component before
};

constexpr int most_steps = 20;  // of an order
constexpr int most_materials = 32;

/// Sums of some steps, one after the other, which the balance of energies wants: Books::StepsTaken.
struct StepSums {
  enum : int {
    first_before,  ///< of the first step: dᵀMd of the step before it
    two_steps,     ///< dᵀMd of each step and the one before together
    two_steps_last,
    push_work,
    push_work_last,
    force_work,
    force_work_last,
    rate_first,
    rate_last,
    reaction_work,  ///< from the second step on
    count
  };
  static constexpr int sums = count;
  double of[count];
};

/// Of a state that is looked at.
struct LookSums {
  enum : int {
    stiffness,
    inertia_before,
    inertia_now,
    inertia_two,  ///< of the last two steps
    window_stiffness,
    window_inertia,  ///< since the look before
    span_product,
    span_squares,
    push,
    force,
    spring_work,
    reaction_x,
    reaction_y,
    reaction_z,
    strain_energy,
    compressed,
    pressed,
    first_largest = pressed + most_materials,
    longest_step = first_largest,
    farthest,
    span_of_nodes,
    span_longest,
    stretch,
    minus_jacobian,
    count
  };
  static constexpr int sums = first_largest;
  double of[count];
};

/// Of a look at the stiffness.
struct FollowSums {
  enum : int { inertia, inertia_then, stiffer, minus_jacobian, count };
  static constexpr int sums = stiffer;
  double of[count];
};

/// What an order leaves to be read by the host.
struct Record {
  int steps = 0;
  int halted = 0;                    ///< J fell to the order's `halt_below`: the masses must be looked at
  int singular = 0;                  ///< of weigh: conditions repeat each other
  double eigenvalue = 0;             ///< the largest, of measure_tightness
  double jacobian[most_steps] = {};  ///< the smallest of the force of each step
  std::uint64_t squeezed[2] = {};    ///< rising_key() of −J, of steps in turn
  StepSums steps_taken;
  LookSums look;
  FollowSums follow;
};

/// What is to be done, by the numbers of the host.
struct Order {
  int steps = 0;
  int first = 0;   ///< û now is displacement[first % 3], one step ago [(first + 2) % 3], two ago [(first + 1) % 3]
  int parity = 0;  ///< forces and multipliers of the first step go to this one of two
  double alpha = 0, beta = 0;
  double halt_below = 0;
  double fraction[most_steps + 1] = {};  ///< of the load: now, and after each step
  int states = 0;                        ///< looks so far
  int span = 1;                          ///< looks that make a span of SpanBound
  bool glance = false;                   ///< a look is at the nodes alone
  double mass_scale = 1, mass_margin = 1;
  int iterations = 0;    ///< of the power iteration
  double mode_size = 0;  ///< root mean square of its modes, mm
};

template <class Scalar>
struct View {
  std::int32_t clusters, nodes;
  std::int32_t most_slots, most_points, most_patches;  ///< of a cluster
  std::int32_t resident;  ///< turns that a block keeps from step to step, at most, where it has one cluster alone
  const Cluster* cluster;
  const PatchPoints* patch;
  const std::int32_t* patch_of;  ///< one a point
  const std::int32_t* material;  ///< one a point
  const double* volume;
  const double* mode;               ///< pressure modes, 4 a point; nullptr: each point is a patch
  const std::int32_t* slice_begin;  ///< of the clusters
  const std::int64_t* turn_begin;   ///< of the slices
  const std::int32_t* slice_point;
  const Pair<Scalar>* slice_pair;
  const double* reach;  ///< one a cluster
  const std::int32_t* slot_node;
  const std::int64_t* slot_begin;
  const Pair<Scalar>* slot_pair;  ///< by slot
  const std::int64_t* node_begin;
  const std::int32_t* node_slot;
  const Law* law;          ///< one a material
  const double* firmness;  ///< one a node

  const std::int64_t* touch_begin;  ///< (slots + 1)
  const Touch* touch;
  const std::int64_t* patch_touch_begin;  ///< (patches + 1)
  const std::int64_t* patch_touch;        ///< their numbers in `touch`
  const std::int32_t* patch_touch_node;
  SlotVector<double>* touch_norm;  ///< |b| of each pressure mode
  double* touch_reach;
  SharedBound* point_bound;  ///< scale: without the tangent
  double* point_tangent;     ///< w C
  SharedBound* patch_bound;
  SlotVector<double>* patch_total;  ///< Σ |b|/h of each mode

  double* displacement[3];  ///< û, mm, 4 a node
  double* force_at[2];      ///< f_int − f_ext, µN
  double* mass;
  double* inverse_mass;
  double* stiffer_mass;  ///< what weigh takes
  SlotVector<Scalar>* slot_force;
  double* slot_bound;
  double* mode_of_body;  ///< of the power iteration
  double* place_at_look;
  double* force_at_look;
  double* span_state;           ///< û at the last looks, as many as two spans have ends, one after the other
  std::int32_t external_count;  ///< at equal steps of the load's fraction
  const double* external;

  TouchingNodes contact;
  Conditions condition[3];

  double* partial;  ///< sums of the blocks
  Record* record;
};

}  // namespace brainshift::solve::device
