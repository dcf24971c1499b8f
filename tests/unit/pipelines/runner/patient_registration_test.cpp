// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/patient_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/solve/models.hpp"

namespace brainshift::pipelines::patient_registration_test {

using solve::CraniotomyLoad;
using solve::Model;
using solve::model_side;
using solve::RigidMotion;

constexpr double sigma = 0.3;

/// A cube that is held below.
Model held_cube() {
  Model model = solve::box_model(test::box_cells(6, model_side));
  solve::hold_bottom(model);
  return model;
}

std::vector<std::int32_t> upper_nodes(const Model& model) {
  std::vector<std::int32_t> nodes;
  for (Eigen::Index a = 0; a < model.cloud.positions.rows(); ++a) {
    if (model.cloud.positions(a, 2) > model_side - 1e-9) {
      nodes.push_back(static_cast<std::int32_t>(a));
    }
  }
  return nodes;
}

/// What a tracker that is turned by 0.35 and off by 4 mm sees of the upper face, which sinks by `depth` at `x`.
CraniotomyLoad seen_by_tracker(const Model& model, const RigidMotion& tracker, double depth,
                               double x = model_side / 2) {
  CraniotomyLoad load;
  load.positions = model.cloud.positions(upper_nodes(model), Eigen::all);
  Points moved = load.positions;
  for (auto place : moved.rowwise()) {
    const double away = std::hypot(place[0] - x, place[1] - model_side / 2);
    place[2] -= depth * std::exp(-away * away / 200);
  }
  load.displacement = tracker(moved) - load.positions;
  load.sigma = Points::Constant(load.positions.rows(), 3, sigma);
  return load;
}

/// Each point is measured at a node.
void impose(const CraniotomyLoad& load, Model& model) {
  const std::vector<std::int32_t> nodes = upper_nodes(model);
  solve::Measurement& measured = model.conditions.measured.emplace();
  measured.spread.resize(model.cloud.positions.rows(), load.positions.rows());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto point = static_cast<Eigen::Index>(i);
    measured.spread.insert(nodes[i], point) = 1;
    model.conditions.displacement.row(nodes[i]) = load.displacement.row(point);
  }
  measured.sigma = load.sigma;
  measured.cortex = load.positions;
  measured.cortex_displacement = load.displacement;
  measured.inner = measured.inner_displacement = measured.inner_sigma = Points(0, 3);
}

RigidMotion a_tracker() {
  RigidMotion tracker;
  tracker.rotation = Eigen::AngleAxisd(0.35, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  tracker.translation = {4, -1, 2};
  return tracker;
}

/// Largest distance between what two motions make of the places, mm.
double apart(const RigidMotion& a, const RigidMotion& b, const Points& places) {
  return (a(places) - b(places)).rowwise().norm().maxCoeff();
}

TEST(PatientRegistration, FindsHowTheTrackerStandsWhereTheBrainIsAtRest) {
  Model model = held_cube();
  const RigidMotion tracker = a_tracker();
  const CraniotomyLoad load = seen_by_tracker(model, tracker, 0);
  const PatientRegistration found = patient_registration(load, {}, impose, model);
  EXPECT_LE(found.open, registration_at_rest);
  EXPECT_LT(apart(found.motion, tracker, load.positions), 0.01);
}

TEST(PatientRegistration, ComesToRestWhereTheBrainSinksOnOneSide) {
  Model model = held_cube();
  const CraniotomyLoad load = seen_by_tracker(model, a_tracker(), 8, 10);
  EXPECT_LE(patient_registration(load, {}, impose, model).open, registration_at_rest);
}

/// Where the tracker stands does not change what of a load is taken for the brain's own motion.
TEST(PatientRegistration, GoesAlongWithTheTrackerWhereTheBrainSinks) {
  Model model = held_cube();
  const RigidMotion tracker = a_tracker();
  const RigidMotion own = patient_registration(seen_by_tracker(model, {}, 5), {}, impose, model).motion;
  const RigidMotion found = patient_registration(seen_by_tracker(model, tracker, 5), {}, impose, model).motion;
  const RigidMotion both{tracker.rotation * own.rotation, tracker.rotation * own.translation + tracker.translation};
  EXPECT_LT(apart(found, both, model.cloud.positions), 0.05);
  EXPECT_TRUE(model.conditions.measured->registration_unknown);
}

TEST(PatientRegistration, IsKnownAsWellAsItTakesThePlacesOfTheBrain) {
  Model model = held_cube();
  const CraniotomyLoad load = seen_by_tracker(model, {}, 0);
  const Points& places = model.cloud.positions;
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, sigma);
  double squares = 0;
  constexpr int draws = 500;
  for (int draw = 0; draw < draws; ++draw) {
    Points noise = Points::Zero(load.positions.rows(), 3);
    for (double& component : noise.reshaped()) {
      component = normal(random);
    }
    const RigidMotion off = solve::fit_rigid(load.positions, load.positions + noise, load.sigma);
    squares += (off(places) - places).squaredNorm() / static_cast<double>(places.rows()) / draws;
  }
  solve::MeasuredFit fit;
  fit.motion_centre = load.positions.colwise().mean();
  const Points arms = load.positions.rowwise() - fit.motion_centre.transpose();
  fit.motion_size = arms.rowwise().norm().mean();
  const Eigen::Array3d along = (arms / fit.motion_size).cwiseAbs2().colwise().sum();
  fit.motion_deviation.resize(6);
  fit.motion_deviation.head<3>().setConstant(sigma / std::sqrt(static_cast<double>(arms.rows())));
  fit.motion_deviation.tail<3>() = sigma / (along.sum() - along).sqrt();
  EXPECT_NEAR(registration_deviation(fit, places) / std::sqrt(squares), 1, 0.05);
}

}  // namespace brainshift::pipelines::patient_registration_test
