// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/device/fields_on_device.hpp"

#include <gtest/gtest.h>

#include <random>

#include "register/device/register_on_device.hpp"
#include "register/field/forward_field.hpp"
#include "register/warp/warp.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/shape/node_supports.hpp"
#include "tests/unit/register/builders.hpp"
#include "tests/unit/solve/device/backends.hpp"

namespace brainshift::registration::device {

namespace {

namespace b = builders;

using solve::device::On;

class FieldsOnDevice : public solve::device::OnDevice {
 protected:
  static const Backend& backend() { return GetParam() == On::gpu ? *gpu() : one_thread(); }
};

INSTANTIATE_TEST_SUITE_P(On, FieldsOnDevice, testing::Values(On::one_thread, On::gpu), solve::device::name_of_device);

/// Where two fields are apart, by at most one step of what they are rounded to: rounding may fall either way.
void expect_same(const VectorImage& a, const VectorImage& b) {
  ASSERT_EQ(a.voxels.size(), b.voxels.size());
  std::size_t apart = 0;
  double largest = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    const double distance = (b::at(a, v) - b::at(b, v)).cwiseAbs().maxCoeff();
    largest = std::max(largest, distance);
    apart += distance > 0 ? 1 : 0;
  }
  EXPECT_LE(largest, 1.01 / 4096);
  EXPECT_LE(apart, a.voxels.size() / 20000);
}

/// Where two images are apart.
template <class T>
std::size_t different(const Image<T>& a, const Image<T>& b) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    count += a.voxels[v] == b.voxels[v] ? 0 : 1;
  }
  return count;
}

void expect_as_processor(const Backend& backend, const RegisterInput& input, const RegisterOptions& options) {
  const Registration there = register_images(input, options);
  const BrainZones zones =
      brain_zones(input.brain, input.t1.geometry, options.fade, input.cavity ? &input.cavity->wall : nullptr);
  Registration here;
  register_on(backend, input, {&input.t1, &*input.labels}, options, zones, {}, here);
  expect_same(here.forward, there.forward);
  expect_same(here.resampling, there.resampling);
  EXPECT_EQ(here.measures.not_inverted, there.measures.not_inverted);
  // The images, of fields that are the same.
  const ScalarImage warped = warp(input.t1, here.resampling, options.interpolation);
  const LabelMap labels = warp(*input.labels, here.resampling);
  EXPECT_EQ(different(here.warped, warped), 0U);
  EXPECT_EQ(different(*here.warped_labels, labels), 0U);
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessor) {
  expect_as_processor(backend(), b::head(b::sinking), {});
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessorOnAnObliqueGridThatCutsTheHead) {
  const ImageGeometry grid = b::grid({40, 27, 30}, {1.5, 2.2, 1.9}, b::oblique());
  expect_as_processor(backend(), b::head(b::sinking, grid), {.fade = 15});
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessorWhateverTheBasis) {
  RegisterInput input = b::head(b::sinking, b::grid({28, 25, 24}, {3.2, 3.6, 4.0}));
  for (const Basis basis : {Basis::linear, Basis::quadratic}) {
    input.solution.shape.basis = basis;
    input.solution.shape.dilatation = basis == Basis::quadratic ? 2.6 : 0;
    expect_as_processor(backend(), input, {});
  }
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessorWhereSupportsAreLargerThanWhatIsKept) {
  RegisterInput input = b::head(b::sinking, b::grid({28, 25, 24}, {3.2, 3.6, 4.0}));
  input.solution.shape.dilatation = 3.4;
  const ImageGeometry& grid = input.t1.geometry;
  const BrainZones zones = brain_zones(input.brain, grid, 20);
  const solve::ShapeFunctions shape = shape_functions(input.solution);
  const Points& values = input.solution.displacement;
  const auto at = [&](const Points& places) { return shape.interpolate(places, values); };
  device::FieldsOnDevice on(backend(), input.solution, values, zones, grid, 20, 0.01);
  on.find_forward(shape);
  EXPECT_GT(on.grown(), 500);
  expect_same(on.forward(), forward_field(at, input.solution.spacing.front(), zones, grid, 20, {}));
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessorWhereVoxelsCannotBeInverted) {
  const auto folding = [](const Eigen::Vector3d& x) -> Eigen::Vector3d { return 3 * b::sinking(x); };
  expect_as_processor(backend(), b::head(folding), {});
}

TEST_P(FieldsOnDevice, AreThoseOfTheProcessorRoundACavity) {
  RegisterInput input = b::head(b::sinking);
  input.cavity = Cavity{b::ball(b::centre + Eigen::Vector3d(4, 2, 16), 9), {2}};
  const Registration there = register_images(input, {});
  const BrainZones zones = brain_zones(input.brain, input.t1.geometry, 20, &input.cavity->wall);
  Registration here;
  register_on(backend(), input, {nullptr, nullptr}, {}, zones, {}, here);
  expect_same(here.forward, there.forward);
  expect_same(here.resampling, there.resampling);
}

TEST_P(FieldsOnDevice, LeaveBSplinesToTheProcessor) {
  const RegisterInput input = b::head(b::sinking, b::grid({28, 25, 24}, {3.2, 3.6, 4.0}));
  expect_as_processor(backend(), input, {.interpolation = Interpolation::bspline});
}

TEST_P(FieldsOnDevice, SayWhereNoSupportReaches) {
  RegisterInput input = b::head(b::sinking, b::grid({14, 12, 12}, {6.4, 7.2, 8.0}));
  input.solution.positions.col(2).setConstant(b::centre.z());  // all nodes in one plane
  const BrainZones zones = brain_zones(input.brain, input.t1.geometry, 40);
  const Points values = input.solution.displacement;
  device::FieldsOnDevice on(backend(), input.solution, values, zones, input.t1.geometry, 40, 0.01);
  EXPECT_THROW(on.find_forward(shape_functions(input.solution)), std::invalid_argument);
}

TEST_P(FieldsOnDevice, MayBeFoundAgain) {
  const RegisterInput input = b::head(b::sinking, b::grid({28, 25, 24}, {3.2, 3.6, 4.0}));
  const BrainZones zones = brain_zones(input.brain, input.t1.geometry, 20);
  const solve::ShapeFunctions shape = shape_functions(input.solution);
  device::FieldsOnDevice on(backend(), input.solution, input.solution.displacement, zones, input.t1.geometry, 20, 0.01);
  on.find_forward(shape);
  const VectorImage once = on.forward();
  on.find_forward(shape);
  EXPECT_EQ(once.voxels, on.forward().voxels);
}

TEST(RegisterIfAsked, SaysWhyThereIsNoGpu) {
  if (gpu() != nullptr) {
    GTEST_SKIP() << "there is one";
  }
  const RegisterInput input = b::head(b::sinking, b::grid({14, 12, 12}, {6.4, 7.2, 8.0}));
  RegisterOptions options{.fade = 40};
  const Registration there = register_images(input, options);
  options.device = solve::Device::automatic;
  EXPECT_EQ(register_images(input, options).warped.voxels, there.warped.voxels);
  options.device = solve::Device::cuda;
  EXPECT_THROW(register_images(input, options), std::invalid_argument);
}

/// Nodes whose spacing varies twentyfold, and places among and beyond them.
struct Graded {
  Points positions = Points(3000, 3), values = Points(3000, 3), places = Points(400, 3);
  std::vector<double> spacing;

  Graded() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    for (Eigen::Index a = 0; a < positions.rows(); ++a) {
      Eigen::Vector3d x(anywhere(random), anywhere(random), anywhere(random));
      x *= std::pow(x.norm(), 1.5);
      positions.row(a) = 60 * x.transpose();
      spacing.push_back(std::max(1.0, 14 * x.norm()));
      values.row(a) << anywhere(random), anywhere(random), anywhere(random);
    }
    for (Eigen::Index p = 0; p < places.rows(); ++p) {
      places.row(p) << 70 * anywhere(random), 70 * anywhere(random), 70 * anywhere(random);
    }
  }
};

TEST(Fit, IsThatOfTheSolver) {
  const Graded cloud;
  for (const Basis basis : {Basis::linear, Basis::quadratic, Basis::modified_quadratic}) {
    const ShapeOptions options{.basis = basis};
    const solve::ShapeFunctions shape(cloud.positions, cloud.spacing, options);
    const Points expected = shape.interpolate(cloud.places, cloud.values);
    const NodeBins bins = node_bins(cloud.positions, solve::support_radii(cloud.spacing, options), cloud.values);
    const NodeView nodes = view_of(bins, bins.node.data(), bins.begin.data());
    const FitRules rules{basis == Basis::linear ? 1 : 2, basis == Basis::modified_quadratic ? options.penalty : 0};
    EXPECT_GT(bins.level.size(), 2U);
    int at_once = 0;
    for (Eigen::Index p = 0; p < cloud.places.rows(); ++p) {
      const Eigen::Vector3d x = cloud.places.row(p), there = expected.row(p);
      Eigen::Vector3d u, first;
      ASSERT_TRUE(displacement_by_growth(nodes, rules, x, u));
      EXPECT_LT((u - there).norm(), 1e-7 * (1 + there.norm())) << p;
      if (displacement_at(nodes, rules, x, first)) {
        ++at_once;
        EXPECT_LT((first - u).norm(), 1e-9 * (1 + u.norm()));
      }
    }
    EXPECT_GT(at_once, 20);
    EXPECT_LT(at_once, 400);
  }
}

TEST(NodeView, SeesWhatIsNear) {
  const Graded cloud;
  const std::vector<double> radius = solve::support_radii(cloud.spacing, {});
  const NodeBins bins = node_bins(cloud.positions, radius, cloud.values);
  const NodeView nodes = view_of(bins, bins.node.data(), bins.begin.data());
  for (const double scale : {1.0, 1.7, 6.0}) {
    for (Eigen::Index p = 0; p < cloud.places.rows(); ++p) {
      std::vector<int> seen;
      nodes.for_each_seen(cloud.places.row(p), scale, [&](int n, double, double) { seen.push_back(n); });
      std::sort(seen.begin(), seen.end());
      EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
      const auto distance = (cloud.positions.rowwise() - cloud.places.row(p)).rowwise().norm().eval();
      std::size_t expected = 0;
      for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
        expected += distance[a] < scale * radius[static_cast<std::size_t>(a)] ? 1 : 0;
      }
      EXPECT_EQ(seen.size(), expected);
    }
  }
}

}  // namespace

}  // namespace brainshift::registration::device
