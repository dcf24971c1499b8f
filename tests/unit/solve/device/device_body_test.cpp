// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/device_body.hpp"

#include "solve/dynamics/relaxation_rules.hpp"
#include "solve/force/firmness.hpp"
#include "solve/force/stiffness_bound.hpp"
#include "tests/unit/solve/device/backends.hpp"
#include "tests/unit/solve/material_cases.hpp"
#include "tests/unit/solve/specimen_body.hpp"

namespace brainshift::solve::device {

namespace {

constexpr double side = 50;
const Material soft{.youngs_modulus = 10, .poisson_ratio = 0.1};

/// A specimen on the device, moved at random.
template <class Scalar>
class Moved {
 public:
  Moved(const Backend& backend, const Material& material, const SpecimenOptions& options, int nodes = 6)
      : specimen(test::irregular_box(nodes, side, 0.3), test::box_cells(4, side), {material, soft}, options),
        u(specimen.random_parameters(0.4)),
        on_(backend, body_of(specimen)) {
    specimen.force(u);
  }

  /// f_int of one step, and the record of it.
  NodalVectors force() {
    on_.write(u, on_.view().displacement[0]);
    Order order;
    order.steps = 1;
    order.alpha = 1;
    order.halt_below = -1e9;
    on_.perform(Task::step, order);
    return on_.read(on_.view().force_at[0]);
  }
  std::vector<double> bound() {
    on_.write(u, on_.view().displacement[2]);
    on_.perform(Task::follow, {});
    std::vector<double> values(on_.nodes());
    on_.backend().from_device(values.data(), on_.view().stiffer_mass, values.size() * sizeof(double));
    return values;
  }
  LookSums look() {
    on_.write(u, on_.view().displacement[2]);
    Order order;
    order.alpha = 1;
    on_.perform(Task::look, order);
    return on_.record().look;
  }
  Record record() const { return on_.record(); }

  Specimen specimen;
  NodalVectors u;

 private:
  static Body body_of(const Specimen& specimen) {
    Body body = free_body(specimen);
    body.points.felt = felt_tissues(body.points, body.laws.elastic.size());
    return body;
  }
  DeviceBody<Scalar> on_;
};

template <class Scalar>
SpecimenOptions with_precision(SpecimenOptions options) {
  options.precision = std::is_same_v<Scalar, float> ? Precision::single_precision : Precision::double_precision;
  return options;
}

template <class Scalar>
void expect_same_as_on_the_host(const Backend& backend, const Material& material, const SpecimenOptions& options,
                                double rounding, int nodes = 6) {
  Moved<Scalar> moved(backend, material, with_precision<Scalar>(options), nodes);
  const NodalVectors expected = moved.specimen.force(moved.u);
  const NodalVectors force = moved.force();
  EXPECT_LT(largest_difference(force, expected), rounding * largest(expected)) << name_of(material);
  const double jacobian = jacobian_range(moved.specimen.scratch).smallest;
  EXPECT_NEAR(moved.record().jacobian[0], jacobian, rounding);
  EXPECT_EQ(moved.force(), force) << "not the same bits";
}

}  // namespace

class DeviceForce : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Of, DeviceForce, testing::Values(On::one_thread, On::gpu), name_of_device);

TEST_P(DeviceForce, IsThatOfTheHostForEveryLaw) {
  for (const Material& material : library_laws) {
    expect_same_as_on_the_host<double>(backend(), material, {}, 1e-12);
    expect_same_as_on_the_host<float>(backend(), material, {}, 1e-5);
  }
}

TEST_P(DeviceForce, IsThatOfTheHostForPointsAlonePatchesOfManyAndLargeSupports) {
  expect_same_as_on_the_host<double>(backend(), library_laws.front(), {.nodes_per_patch = 0}, 1e-12);
  expect_same_as_on_the_host<double>(backend(), library_laws.front(), {.nodes_per_patch = 40}, 1e-12);
  expect_same_as_on_the_host<double>(backend(), library_laws.front(), {.basis = Basis::modified_quadratic}, 1e-12);
  expect_same_as_on_the_host<float>(backend(), library_laws.front(), {.basis = Basis::modified_quadratic}, 1e-5);
}

TEST_P(DeviceForce, IsThatOfTheHostWhateverTheNumberOfPointsAndNodes) {
  for (const int nodes : {3, 4, 5, 7, 9}) {
    for (const int points_per_cell : {1, 8}) {
      expect_same_as_on_the_host<float>(backend(), library_laws.front(),
                                        {.nodes_per_patch = 2, .points_per_cell = points_per_cell}, 1e-5, nodes);
    }
  }
}

class DeviceBound : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Of, DeviceBound, testing::Values(On::one_thread, On::gpu), name_of_device);

TEST_P(DeviceBound, IsThatOfTheHostForEveryLaw) {
  for (const Material& material : library_laws) {
    for (const double nodes_per_patch : {0.0, 6.0}) {
      Moved<double> moved(backend(), material, {.nodes_per_patch = nodes_per_patch});
      PointBlocks points = moved.specimen.points;
      points.felt = felt_tissues(points, 2);
      const std::vector<double> expected = stiffness_bound(points, moved.specimen.laws, moved.specimen.scratch);
      const std::vector<double> bound = moved.bound();
      for (std::size_t a = 0; a < bound.size(); ++a) {
        ASSERT_NEAR(bound[a], expected[a], 1e-9 * expected[a]) << name_of(material) << ", node " << a;
      }
    }
  }
}

class DeviceLook : public OnDevice {};
INSTANTIATE_TEST_SUITE_P(Of, DeviceLook, testing::Values(On::one_thread, On::gpu), name_of_device);

TEST_P(DeviceLook, SeesThePointsAsTheHostDoes) {
  for (const Material& material : library_laws) {
    Moved<double> moved(backend(), material, {});
    const PointState expected = point_state(moved.specimen.points, moved.specimen.laws, moved.specimen.scratch);
    const LookSums seen = moved.look();
    EXPECT_NEAR(seen.of[LookSums::strain_energy], expected.strain_energy, 1e-9 * expected.strain_energy);
    EXPECT_NEAR(seen.of[LookSums::stretch], expected.largest_stretch, 1e-9);
    EXPECT_NEAR(-seen.of[LookSums::minus_jacobian], expected.smallest_jacobian, 1e-12);
  }
}

TEST(WhyNot, NamesWhatADeviceDoesNotDo) {
  Body body;
  body.laws.elastic = {elastic_law({})};
  EXPECT_EQ(why_not(body), "");
  body.laws.swelling = {0.1};
  EXPECT_EQ(why_not(body), "is in plane stress, moves in time or swells");
  body.laws.swelling.clear();
  body.laws.elastic.push_back(elastic_law(fung(1000, 0.5, 0.49)));
  EXPECT_EQ(why_not(body), "has a material with a law of its own");
  body.laws.elastic.assign(33, elastic_law({}));
  EXPECT_EQ(why_not(body), "has more than 32 materials");
}

}  // namespace brainshift::solve::device
