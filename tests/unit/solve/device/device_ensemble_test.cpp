// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/device_ensemble.hpp"

#include <algorithm>
#include <deque>
#include <memory>

#include "solve/device/each/pieces.hpp"
#include "solve/force/firmness.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/device/backends.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen_body.hpp"

namespace brainshift::solve::device {

namespace device_ensemble_test {

constexpr double side = 50;
const Material soft{.youngs_modulus = 10, .poisson_ratio = 0.1};

/// Specimens that differ by the law of a tissue, on the device side by side, moved at random.
template <class Scalar>
class Moved {
 public:
  Moved(const Backend& backend, const std::vector<Material>& materials, SpecimenOptions options, int nodes = 6) {
    options.precision = std::is_same_v<Scalar, float> ? Precision::single_precision : Precision::double_precision;
    std::vector<Member> loads;
    for (const Material& material : materials) {
      specimens.emplace_back(test::irregular_box(nodes, side, 0.3), test::box_cells(4, side),
                             std::vector<Material>{material, soft}, options);
      specimens.back().points.felt = felt_tissues(specimens.back().points, 2);
      loads.push_back({.laws = specimens.back().laws,
                       .external = {},
                       .start = specimens.back().random_parameters(0.4, static_cast<unsigned>(loads.size()) + 3)});
      u.push_back(loads.back().start);
      force.push_back(specimens.back().force(u.back()));
    }
    body_ = free_body(specimens.front());
    on_ = std::make_unique<DeviceEnsemble<Scalar>>(backend, body_, false);
    on_->load(loads);
    order_.who = static_cast<Members>((std::uint64_t{1} << loads.size()) - 1);
    order_.alpha = 1;
    std::fill_n(order_.mass_scale, most_members, 1.0);
    std::fill_n(order_.halt_below, most_members, -1e9);
    for (double* to : on_->view().displacement) {
      on_->write(on_->starts(loads), to);
    }
  }

  RecordOfEach perform(TaskOfEach task, int steps = 0) {
    order_.steps = steps;
    on_->perform(task, order_);
    RecordOfEach record{};
    on_->read(record);
    return record;
  }
  std::vector<double> vectors(const double* from) const { return on_->read(from, on_->values()); }
  std::vector<double> masses() const { return on_->read(view().stiffer_mass, on_->nodes() * most_members); }
  const ViewOfEach<Scalar>& view() const { return on_->view(); }

  std::deque<Specimen> specimens;  // which do not move
  std::vector<NodalVectors> u, force;

 private:
  Body body_;
  std::unique_ptr<DeviceEnsemble<Scalar>> on_;
  OrderOfEach order_;
};

template <class Scalar>
void expect_forces_of_the_host(const Backend& backend, const std::vector<Material>& materials,
                               const SpecimenOptions& options, double rounding, int nodes = 6) {
  Moved<Scalar> moved(backend, materials, options, nodes);
  const RecordOfEach record = moved.perform(TaskOfEach::step, 1);
  const std::vector<double> of_each = moved.vectors(moved.view().force_at[0]);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const NodalVectors& expected = moved.force[m];
    EXPECT_LT(largest_difference(vectors_of_member(of_each, m), expected), rounding * largest_component(expected))
        << name_of(materials[m]);
    EXPECT_NEAR(-record.step[0].of[StepOfEach::minus_jacobian][m],
                std::min(1.0, jacobian_range(moved.specimens[m].scratch).smallest), rounding);
  }
}

class EachOnDevice : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Of, EachOnDevice, testing::Values(On::one_thread, On::gpu), name_of_device);

TEST_P(EachOnDevice, HasTheForceOfTheHostForEveryLaw) {
  expect_forces_of_the_host<double>(backend(), library_laws, {}, 1e-12);
  expect_forces_of_the_host<float>(backend(), library_laws, {}, 1e-5);
  expect_forces_of_the_host<double>(backend(), {library_laws[0], library_laws[1]}, {}, 1e-12);  // neo-Hookean alone
}

TEST_P(EachOnDevice, HasTheForceOfTheHostForPointsAlonePatchesOfManyAndLargeSupports) {
  expect_forces_of_the_host<double>(backend(), library_laws, {.nodes_per_patch = 0}, 1e-12);
  expect_forces_of_the_host<double>(backend(), library_laws, {.nodes_per_patch = 40}, 1e-12);
  expect_forces_of_the_host<float>(backend(), library_laws, {.basis = Basis::modified_quadratic}, 1e-5);
  for (const int nodes : {3, 5, 9}) {
    expect_forces_of_the_host<float>(backend(), {library_laws[0]}, {.nodes_per_patch = 2, .points_per_cell = 1}, 1e-5,
                                     nodes);
  }
}

TEST_P(EachOnDevice, HasTheBoundAndTheEnergyOfTheHostForEveryLaw) {
  for (const double nodes_per_patch : {0.0, 6.0}) {
    Moved<double> moved(backend(), library_laws, {.nodes_per_patch = nodes_per_patch});
    const RecordOfEach record = moved.perform(TaskOfEach::measure_energy);
    moved.perform(TaskOfEach::follow);
    const std::vector<double> masses = moved.masses();
    for (std::size_t m = 0; m < library_laws.size(); ++m) {
      const Specimen& specimen = moved.specimens[m];
      const std::vector<double> expected = stiffness_bound(specimen.points, specimen.laws, specimen.scratch);
      for (std::size_t a = 0; a < expected.size(); ++a) {
        ASSERT_NEAR(masses[a * most_members + m], expected[a], 1e-9 * expected[a])
            << name_of(library_laws[m]) << ", " << a;
      }
      const double energy = point_state(specimen.points, specimen.laws, specimen.scratch).strain_energy;
      EXPECT_NEAR(record.energy[m], energy, 1e-9 * energy) << name_of(library_laws[m]);
    }
  }
}

TEST(Pieces, HoldAllPointsAndSlotsOnceInTheirOrder) {
  const Specimen specimen(test::irregular_box(6, side, 0.3), test::box_cells(4, side), {soft, soft}, {});
  for (const int blocks : {1, 3, 1000}) {
    const Pieces<double> made = make_pieces<double>(specimen.points, blocks);
    std::int32_t point = 0;
    for (std::size_t k = 0; k < made.patches.size(); ++k) {
      const PatchOfPieces& patch = made.patches[k];
      for (std::int32_t i = patch.first_piece; i < patch.first_piece + patch.pieces; ++i) {
        const Piece& piece = made.pieces[static_cast<std::size_t>(i)];
        EXPECT_EQ(piece.patch, static_cast<std::int32_t>(k));
        EXPECT_EQ(piece.first_point, point);
        EXPECT_GT(piece.points, 0);
        point += piece.points;
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(point), specimen.points.points());
    EXPECT_EQ(made.share_begin.size(), static_cast<std::size_t>(blocks) + 1);
    EXPECT_EQ(made.share_begin.front(), 0);
    EXPECT_EQ(static_cast<std::size_t>(made.share_begin.back()), made.of.slot_node.size());
    EXPECT_TRUE(std::is_sorted(made.share_begin.begin(), made.share_begin.end()));
  }
}

}  // namespace device_ensemble_test

}  // namespace brainshift::solve::device
