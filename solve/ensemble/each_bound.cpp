// SPDX-License-Identifier: GPL-3.0-or-later
// What EachForce says of the stiffness and the energy of its members, between steps.
#include <omp.h>

#include <algorithm>
#include <vector>

#include "solve/arrays/shared_work.hpp"
#include "solve/ensemble/each_force.hpp"
#include "solve/force/firmness.hpp"
#include "solve/force/patch_dilatation.hpp"
#include "solve/force/point_derivatives.hpp"
#include "solve/force/stiffness_bound.hpp"

namespace brainshift::solve {

namespace {

/// b of the four pressure modes at a node of a patch, of each member.
struct alignas(64) ModesOfEach {
  double of[4][3][members];
};

/// Room of one thread for the nodes that a patch touches.
struct PatchNodes {
  std::vector<std::int32_t> place;    ///< one a slot of the block: in what follows; -1: not touched
  std::vector<std::uint16_t> slot;    ///< of the touched ones
  std::vector<ModesOfEach> mode;      ///< one a touched one
  std::vector<double> reach;          ///< Σ w |B|, one a touched one
  std::vector<std::int32_t> of_pair;  ///< of the point at hand: places

  explicit PatchNodes(const Block& block) : place(static_cast<std::size_t>(block.slots), -1) {}

  void touch(std::span<const std::uint16_t> slots) {
    of_pair.clear();
    for (const std::uint16_t s : slots) {
      if (place[s] < 0) {
        place[s] = static_cast<std::int32_t>(slot.size());
        slot.push_back(s);
        mode.emplace_back(ModesOfEach{});
        reach.push_back(0);
      }
      of_pair.push_back(place[s]);
    }
  }
  void leave() {
    for (const std::uint16_t s : slot) {
      place[s] = -1;
    }
    slot.clear();
    mode.clear();
    reach.clear();
  }
};

/// mode += slope · b ⊗ modes of a point's pairs. derivative: 3 a pair.
BRAINSHIFT_CLONES
void add_modes(const double* derivative, const std::int32_t* place, std::size_t pairs,
               const TensorOfEach<double>& slope, const double* psi, ModesOfEach* mode) {
  for (std::size_t k = 0; k < pairs; ++k) {
    const double* b = derivative + 3 * k;
    double(&to)[4][3][members] = mode[place[k]].of;
    for (std::size_t row = 0; row < 3; ++row) {
      double along[members];
      for (std::size_t m = 0; m < members; ++m) {
        along[m] = slope.entry[row][m] * b[0] + slope.entry[3 + row][m] * b[1] + slope.entry[6 + row][m] * b[2];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t m = 0; m < members; ++m) {
          to[i][row][m] += along[m] * psi[i];
        }
      }
    }
  }
}

/// NodeShares of each member, and the norm that they give a point.
class SharesOfEach {
 public:
  /// firmness: one a member, or one that serves all.
  SharesOfEach(const PointBlocks& points, const Block& block, std::span<const std::vector<double>> firmness) {
    for (const std::vector<double>& of_member : firmness) {
      of_.emplace_back(points, block, of_member);
    }
  }

  /// One a slot.
  std::span<const NumberOfEach<double>> of(std::span<const std::uint16_t> slots, std::span<const double> reach) {
    find(slots, reach, [](std::size_t, std::span<const double>) {});
    return share_;
  }

  /// The same, and weighted_norm() of the point's derivatives, which reach has the norms of.
  std::span<const NumberOfEach<double>> of(std::span<const std::uint16_t> slots, std::span<const double> reach,
                                           const Eigen::Matrix3Xd& b, NumberOfEach<double>& norm) {
    find(slots, reach, [&](std::size_t m, std::span<const double> share) {
      norm.of[m] = is_as_before(m) ? norm.of[m - 1] : weighted_norm(b, share);
    });
    if (of_.size() == 1) {
      std::fill_n(norm.of, members, norm.of[0]);
    }
    return share_;
  }

 private:
  template <class Use>
  void find(std::span<const std::uint16_t> slots, std::span<const double> reach, const Use& use) {
    share_.resize(slots.size());
    for (std::size_t m = 0; m < of_.size(); ++m) {
      const std::span<const double> share = of_[m].of(slots, reach);
      const std::size_t last = of_.size() == 1 ? members : m + 1;
      for (std::size_t a = 0; a < slots.size(); ++a) {
        std::fill(share_[a].of + m, share_[a].of + last, share[a]);
      }
      use(m, share);
    }
  }

  /// Whether a member has the shares of the one before it, as away from where tissues meet all have.
  bool is_as_before(std::size_t m) const {
    return m > 0 && std::all_of(share_.begin(), share_.end(), [m](const auto& s) { return s.of[m] == s.of[m - 1]; });
  }

  std::vector<NodeShares> of_;
  std::vector<NumberOfEach<double>> share_;
};

/// Adds K Σ_k (Σ_b |b_b|/h_b) h_a |b_a| to the bounds of the patch's nodes. share: their h.
BRAINSHIFT_CLONES
void add_volume_bound(const std::uint16_t* slot, const NumberOfEach<double>* share, std::size_t touched,
                      const double* bulk, ModesOfEach* mode, NumberOfEach<double>* bound) {
  double total[4][members] = {};
  for (std::size_t t = 0; t < touched; ++t) {
    double(&of)[4][3][members] = mode[t].of;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t m = 0; m < members; ++m) {
        of[i][0][m] = __builtin_sqrt(of[i][0][m] * of[i][0][m] + of[i][1][m] * of[i][1][m] + of[i][2][m] * of[i][2][m]);
        total[i][m] += of[i][0][m] / share[t].of[m];
      }
    }
  }
  for (std::size_t t = 0; t < touched; ++t) {
    const double(&norm)[4][3][members] = mode[t].of;
    for (std::size_t m = 0; m < members; ++m) {
      const double sum = total[0][m] * norm[0][0][m] + total[1][m] * norm[1][0][m] + total[2][m] * norm[2][0][m] +
                         total[3][m] * norm[3][0][m];
      bound[slot[t]].of[m] += bulk[m] * share[t].of[m] * sum;
    }
  }
}

/// Slope of the dilatation and the largest tangent, times volume, of those members that are asked for.
void find_tangents(const LawOfEach& law, const Chosen& asked, std::span<const Eigen::Matrix3d> gradients,
                   const NumberOfEach<double>& pressure, const NumberOfEach<double>& dilatation, double volume,
                   TensorOfEach<double>& slope, NumberOfEach<double>& tangent) {
  for (std::size_t m = 0; m < members; ++m) {
    if (!asked[m]) {
      continue;
    }
    std::visit(
        [&](const auto& one) {
          tangent.of[m] = volume * shape_tangent(one, gradients[m], pressure.of[m], dilatation.of[m]);
          const Eigen::Matrix3d of_member = volume * one.dilatation_slope(Deformation(gradients[m]));
          for (Eigen::Index k = 0; k < 9; ++k) {
            slope.entry[k][m] = of_member.data()[k];
          }
        },
        law.law[m]);
  }
}

template <class Scalar>
void add_patch_bound(const PointBlocks& points, const Patch& patch, const LawOfEach& law, const Chosen& asked,
                     const EachRoom<Scalar>& room, PatchNodes& nodes, SharesOfEach& shares,
                     NumberOfEach<double>* bound) {
  std::array<Eigen::Matrix3d, members> gradients;
  TensorOfEach<double> slope = {};
  NumberOfEach<double> tangent = {}, norm = {};
  for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
    const auto i = static_cast<std::size_t>(p - patch.first_point);
    for (std::size_t m = 0; m < members; ++m) {
      gradients[m] = gradient_of(room.tensor[i], m);
    }
    find_tangents(law, asked, gradients, room.pressure[i], room.dilatation[i],
                  points.volume[static_cast<std::size_t>(p)], slope, tangent);
    const Eigen::Matrix3Xd b = derivatives(points, p);
    const std::vector<double> reach = column_norms(b);
    const std::span<const std::uint16_t> slots = points.slots_of(p);
    const std::span<const NumberOfEach<double>> share = shares.of(slots, reach, b, norm);
    nodes.touch(slots);
    for (std::size_t k = 0; k < slots.size(); ++k) {
      numbers(bound[slots[k]].of) += numbers(tangent.of) * numbers(norm.of) * numbers(share[k].of) * reach[k];
      nodes.reach[static_cast<std::size_t>(nodes.of_pair[k])] += points.volume[static_cast<std::size_t>(p)] * reach[k];
    }
    const Eigen::Vector4d psi = points.modes_of(p);
    add_modes(b.data(), nodes.of_pair.data(), slots.size(), slope, psi.data(), nodes.mode.data());
  }
  const std::span<const NumberOfEach<double>> share = shares.of(nodes.slot, nodes.reach);
  add_volume_bound(nodes.slot.data(), share.data(), share.size(), law.moduli.seen.of, nodes.mode.data(), bound);
  nodes.leave();
}

/// node_firmness() of each member; one, empty, that serves all where there is none.
std::vector<std::vector<double>> firmness_of_each(const PointBlocks& points, std::span<const LawOfEach> laws) {
  std::vector<std::vector<double>> firmness;
  for (std::size_t m = 0; m < (points.felt.empty() ? 1 : members); ++m) {
    std::vector<double> moduli;
    for (const LawOfEach& row : laws) {
      moduli.push_back(std::visit([](const auto& law) { return double{law.shear_modulus}; }, row.law[m]));
    }
    firmness.push_back(node_firmness(points, moduli));
  }
  return firmness;
}

/// Of the points of a patch, whose H and θ are known.
template <class Scalar>
Numbers patch_energy(const PointBlocks& points, const Patch& patch, const LawOfEach& law,
                     const EachRoom<Scalar>& room) {
  Numbers energy = Numbers::Zero();
  for (std::size_t m = 0; m < members; ++m) {
    Eigen::Vector4d seen = Eigen::Vector4d::Zero();
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto i = static_cast<std::size_t>(p - patch.first_point);
      seen += points.volume[static_cast<std::size_t>(p)] * room.dilatation[i].of[m] * points.modes_of(p);
    }
    for (std::int32_t p = patch.first_point; p < patch.last_point; ++p) {
      const auto i = static_cast<std::size_t>(p - patch.first_point);
      const Deformation d(gradient_of(room.tensor[i], m));
      const double of_point = std::visit(
          [&](const auto& one) {
            return one.isochoric_energy(d) + point_energy(one, seen.dot(points.modes_of(p)), room.dilatation[i].of[m]);
          },
          law.law[m]);
      energy[static_cast<Eigen::Index>(m)] += points.volume[static_cast<std::size_t>(p)] * of_point;
    }
  }
  return energy;
}

}  // namespace

/// H, θ and pressures of a patch's points at the parameters that were gathered.
template <class Scalar>
void EachForceIn<Scalar>::find_gradients(const Patch& patch, EachRoom<Scalar>& room) const {
  const auto points = static_cast<std::size_t>(patch.last_point - patch.first_point);
  each_kernels().front().of<Scalar>().gradients(points_.rows<Scalar>(), patch.first_point, patch.last_point,
                                                room.displacement.data(), room.tensor.data());
  const LawOfEach& law = law_of(patch);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t m = 0; m < members; ++m) {
      const Deformation d(gradient_of(room.tensor[i], m));
      room.dilatation[i].of[m] = std::visit([&](const auto& one) { return one.dilatation(d); }, law.law[m]);
    }
  }
  find_pressures(std::span(&patch, 1), room);
}

template <class Scalar>
EachNumbers EachForceIn<Scalar>::stiffness_bound(const Chosen& asked) const {
  EachNumbers at_slots(points_.slots(), NumberOfEach<double>{});
  const auto blocks = static_cast<std::int64_t>(points_.blocks.size());
  std::vector<EachRoom<Scalar>> rooms(static_cast<std::size_t>(omp_get_max_threads()), room());
  const std::vector<std::vector<double>> firmness = firmness_of_each(points_, laws_);
  share_work(blocks, 1, [&](std::int64_t i, int worker) {
    EachRoom<Scalar>& room = rooms[static_cast<std::size_t>(worker)];
    const Block& block = points_.blocks[static_cast<std::size_t>(i)];
    NumberOfEach<double>* bound = at_slots.data() + block.first_slot;
    PatchNodes nodes(block);
    SharesOfEach shares(points_, block, firmness);
    gather(block, room);
    for (std::int32_t k = block.first_patch; k < block.last_patch; ++k) {
      const Patch& patch = points_.patches[static_cast<std::size_t>(k)];
      find_gradients(patch, room);
      add_patch_bound(points_, patch, law_of(patch), asked, room, nodes, shares, bound);
    }
  });
  EachNumbers sum(points_.nodes(), NumberOfEach<double>{});
  for (std::size_t slot = 0; slot < at_slots.size(); ++slot) {
    auto total = numbers(sum[static_cast<std::size_t>(points_.slot_node[slot])].of);
    total += numbers(at_slots[slot].of);
  }
  return sum;
}

template <class Scalar>
Numbers EachForceIn<Scalar>::strain_energy() const {
  std::vector<Numbers> of_block(points_.blocks.size(), Numbers::Zero());
  const auto blocks = static_cast<std::int64_t>(points_.blocks.size());
  std::vector<EachRoom<Scalar>> rooms(static_cast<std::size_t>(omp_get_max_threads()), room());
  share_work(blocks, 1, [&](std::int64_t i, int worker) {
    EachRoom<Scalar>& room = rooms[static_cast<std::size_t>(worker)];
    const Block& block = points_.blocks[static_cast<std::size_t>(i)];
    gather(block, room);
    for (std::int32_t k = block.first_patch; k < block.last_patch; ++k) {
      const Patch& patch = points_.patches[static_cast<std::size_t>(k)];
      find_gradients(patch, room);
      of_block[static_cast<std::size_t>(i)] += patch_energy(points_, patch, law_of(patch), room);
    }
  });
  Numbers sum = Numbers::Zero();
  for (const Numbers& part : of_block) {
    sum += part;
  }
  return sum;
}

template EachNumbers EachForceIn<double>::stiffness_bound(const Chosen&) const;
template EachNumbers EachForceIn<float>::stiffness_bound(const Chosen&) const;
template Numbers EachForceIn<double>::strain_energy() const;
template Numbers EachForceIn<float>::strain_energy() const;

}  // namespace brainshift::solve
