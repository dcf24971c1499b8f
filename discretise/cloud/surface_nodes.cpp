// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/surface_nodes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "discretise/cloud/boundary_nodes.hpp"
#include "discretise/cloud/dart_grid.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/surface_tree.hpp"

namespace brainshift::discretise {
namespace {

constexpr int samples_per_node = 30;
constexpr int lloyd_sweeps = 8;
/// Random places at this fraction of the spacing nearly fill a surface at the density that is wanted.
constexpr double first_share = 0.8;
/// How far inside the surface its nodes lie, in spacings.
constexpr double inward = 1e-6;

/// A place on the surface; `factor` is the sizing field there.
struct Sample {
  Eigen::Vector3d x;
  double factor;
};

/// Nodes that each triangle takes, up to a constant: area / factor².
std::vector<double> demands(const Surface& surface, const SizingField& sizing) {
  std::vector<double> demand(static_cast<std::size_t>(surface.triangles.rows()));
  for (std::size_t t = 0; t < demand.size(); ++t) {
    const Triangle part = triangle(surface, static_cast<Eigen::Index>(t));
    const Eigen::Vector3d middle = part.centroid();
    double mean = 1 / std::pow(sizing.factor(middle), 2);
    for (const Eigen::Vector3d& corner : {part.a, part.b, part.c}) {
      mean += 1 / std::pow(sizing.factor(0.5 * (corner + middle)), 2);
    }
    demand[t] = part.area_vector().norm() * mean / 4;
  }
  return demand;
}

/// Random places, stratified: triangle after triangle in proportion to their demand.
std::vector<Sample> sample(const Surface& surface, const SizingField& sizing, std::size_t count, Random& random) {
  const std::vector<double> demand = demands(surface, sizing);
  const double total = std::accumulate(demand.begin(), demand.end(), 0.0);
  std::vector<Sample> samples;
  samples.reserve(count);
  std::size_t t = 0;
  double passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * total;
    while (t + 1 < demand.size() && passed + demand[t] < target) {
      passed += demand[t++];
    }
    const double root = std::sqrt(random.uniform());
    const double along = random.uniform();
    const auto [a, b, c] = triangle(surface, static_cast<Eigen::Index>(t));
    const Eigen::Vector3d x = (1 - root) * a + root * (1 - along) * b + root * along * c;
    samples.push_back({x, sizing.factor(x)});
  }
  return samples;
}

/// Picks samples that keep a distance from each other, the largest that leaves room for `count` of them.
Points pick_apart(const Surface& surface, const std::vector<Sample>& samples, double spacing, std::size_t count,
                  Random& random) {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  DartGrid darts(surface.vertices.colwise().minCoeff(), surface.vertices.colwise().maxCoeff(), first_share * spacing);
  std::vector<Eigen::Vector3d> picked;
  for (double fraction = first_share; fraction > 0.4 && picked.size() < count; fraction *= 0.96) {
    for (std::size_t i = 0; i < order.size() && picked.size() < count; ++i) {
      const Sample& candidate = samples[order[i]];
      if (darts.is_free(candidate.x, fraction * spacing * candidate.factor)) {
        darts.accept(candidate.x);
        picked.push_back(candidate.x);
      }
    }
  }
  return as_points(picked);
}

/// One sweep: each node to the weighted mean of the samples nearest to it (not yet back on the surface).
Points means_of_nearest(const Points& nodes, const std::vector<Sample>& samples) {
  const PointTree tree(nodes);
  std::vector<Eigen::Index> nearest(samples.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < samples.size(); ++i) {
    nearest[i] = static_cast<Eigen::Index>(tree.nearest(samples[i].x.data()).first);
  }
  Points sum = Points::Zero(nodes.rows(), 3);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(nodes.rows());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // Samples have density factor⁻²; equal spread after the field needs factor⁻⁴ in two dimensions.
    const double w = 1 / (samples[i].factor * samples[i].factor);
    sum.row(nearest[i]) += w * samples[i].x.transpose();
    weight[nearest[i]] += w;
  }
  for (Eigen::Index node = 0; node < nodes.rows(); ++node) {
    if (weight[node] > 0) {
      sum.row(node) /= weight[node];
    } else {
      sum.row(node) = nodes.row(node);
    }
  }
  return sum;
}

/// Moves a place on the surface a hair inward: against the normal, or, on a sharp edge where that leads out through
/// the next triangle, any way that leads in.
bool move_inside(Eigen::Vector3d& x, const Eigen::Vector3d& normal, const Scanlines& body, double hair) {
  const Eigen::Vector3d straight = x - hair * normal;
  if (body.inside(straight)) {
    x = straight;
    return true;
  }
  for (int direction = 0; direction < 27; ++direction) {
    const Eigen::Vector3d way(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
    if (body.inside(x + hair * way)) {
      x += hair * way;
      return true;
    }
  }
  return false;
}

/// The places of the surface nearest to these, a hair inside; those that no way leads to are left out.
Points just_inside(const Points& places, const SurfaceTree& tree, const Scanlines& body, double hair) {
  Points inside(places.rows(), 3);
  Eigen::Index kept = 0;
  for (const auto& place : places.rowwise()) {
    SurfacePlace foot = tree.nearest(place.transpose());
    if (move_inside(foot.position, foot.normal, body, hair)) {
      inside.row(kept++) = foot.position;
    }
  }
  return inside.topRows(kept);
}

}  // namespace

double surface_demand(const Surface& surface, const SizingField& sizing) {
  const std::vector<double> demand = demands(surface, sizing);
  return std::accumulate(demand.begin(), demand.end(), 0.0);
}

Points spread_over_surface(const Surface& surface, const Scanlines& body, const SizingField& sizing, double spacing,
                           std::size_t count, const Points& rim, Random& random) {
  const std::vector<Sample> samples = sample(surface, sizing, samples_per_node * count, random);
  Points nodes = pick_apart(surface, samples, spacing, count, random);
  const SurfaceTree tree(surface);
  for (int sweep = 0; sweep < lloyd_sweeps; ++sweep) {
    nodes = means_of_nearest(nodes, samples);
    for (auto node : nodes.rowwise()) {
      node = tree.nearest(node.transpose()).position;
    }
  }
  nodes = just_inside(nodes, tree, body, inward * spacing);
  const Points places = just_inside(rim, tree, body, inward * spacing);
  move_onto_boundary(places, Points(0, 3), body, sizing, spacing, nodes);
  return nodes;
}

}  // namespace brainshift::discretise
