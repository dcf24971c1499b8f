// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/cloud/surface_nodes.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "discretise/cloud/dart_grid.hpp"
#include "discretise/neighbours/point_tree.hpp"

namespace brainshift::discretise {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr int samples_per_node = 30;
constexpr int lloyd_sweeps = 8;
/// Random places at this fraction of the spacing nearly fill a surface at the density that is wanted.
constexpr double first_distance = 0.8;
/// How far inside the surface its nodes lie, in spacings.
constexpr double inward = 1e-6;

/// A place on the surface; `factor` is the sizing field there.
struct Sample {
  Eigen::Vector3d x;
  double factor;
};

Eigen::Vector3d corner(const Surface& surface, Eigen::Index triangle, int k) {
  return surface.vertices.row(surface.triangles(triangle, k));
}

Eigen::Vector3d area_vector(const Surface& surface, Eigen::Index t) {
  const Eigen::Vector3d a = corner(surface, t, 0);
  return 0.5 * (corner(surface, t, 1) - a).cross(corner(surface, t, 2) - a);
}

/// Nodes that each triangle takes, up to a constant: area / factor².
std::vector<double> demands(const Surface& surface, const SizingField& sizing) {
  std::vector<double> demand(static_cast<std::size_t>(surface.triangles.rows()));
  for (std::size_t t = 0; t < demand.size(); ++t) {
    const auto row = static_cast<Eigen::Index>(t);
    const Eigen::Vector3d middle = (corner(surface, row, 0) + corner(surface, row, 1) + corner(surface, row, 2)) / 3.0;
    double mean = 1 / std::pow(sizing.factor(middle), 2);
    for (int k = 0; k < 3; ++k) {
      mean += 1 / std::pow(sizing.factor(0.5 * (corner(surface, row, k) + middle)), 2);
    }
    demand[t] = area_vector(surface, row).norm() * mean / 4;
  }
  return demand;
}

/// Random places, stratified: triangle after triangle in proportion to their demand.
std::vector<Sample> sample(const Surface& surface, const SizingField& sizing, std::size_t count, Random& random) {
  const std::vector<double> demand = demands(surface, sizing);
  const double total = std::accumulate(demand.begin(), demand.end(), 0.0);
  std::vector<Sample> samples;
  samples.reserve(count);
  std::size_t triangle = 0;
  double passed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * total;
    while (triangle + 1 < demand.size() && passed + demand[triangle] < target) {
      passed += demand[triangle++];
    }
    const double root = std::sqrt(random.uniform());
    const double along = random.uniform();
    const auto t = static_cast<Eigen::Index>(triangle);
    const Eigen::Vector3d x = (1 - root) * corner(surface, t, 0) + root * (1 - along) * corner(surface, t, 1) +
                              root * along * corner(surface, t, 2);
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
  DartGrid darts(surface.vertices.colwise().minCoeff(), surface.vertices.colwise().maxCoeff(),
                 first_distance * spacing);
  std::vector<Eigen::Vector3d> picked;
  for (double fraction = first_distance; fraction > 0.4 && picked.size() < count; fraction *= 0.96) {
    for (std::size_t i = 0; i < order.size() && picked.size() < count; ++i) {
      const Sample& candidate = samples[order[i]];
      if (darts.is_free(candidate.x, fraction * spacing * candidate.factor)) {
        darts.accept(candidate.x);
        picked.push_back(candidate.x);
      }
    }
  }
  Points nodes(static_cast<Eigen::Index>(picked.size()), 3);
  for (std::size_t i = 0; i < picked.size(); ++i) {
    nodes.row(static_cast<Eigen::Index>(i)) = picked[i];
  }
  return nodes;
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

/// The closest places of the surface.
class Projection {
 public:
  explicit Projection(const Surface& surface) {
    const auto point = [&](Eigen::Index t, int k) {
      const Eigen::Vector3d p = corner(surface, t, k);
      return Kernel::Point_3(p.x(), p.y(), p.z());
    };
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
      if (area_vector(surface, t).norm() > 0) {
        triangles_.emplace_back(point(t, 0), point(t, 1), point(t, 2));
      }
    }
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
    tree_.accelerate_distance_queries();
  }

  struct Foot {
    Eigen::Vector3d x;
    Eigen::Vector3d normal;
  };

  Foot operator()(const Eigen::Vector3d& x) const {
    const auto [foot, primitive] = tree_.closest_point_and_primitive(Kernel::Point_3(x.x(), x.y(), x.z()));
    const Kernel::Vector_3 n = CGAL::normal((*primitive)[0], (*primitive)[1], (*primitive)[2]);
    return {{foot.x(), foot.y(), foot.z()}, Eigen::Vector3d(n.x(), n.y(), n.z()).normalized()};
  }

 private:
  std::vector<Triangle> triangles_;
  Tree tree_;
};

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

}  // namespace

double surface_demand(const Surface& surface, const SizingField& sizing) {
  const std::vector<double> demand = demands(surface, sizing);
  return std::accumulate(demand.begin(), demand.end(), 0.0);
}

Points spread_over_surface(const Surface& surface, const Scanlines& body, const SizingField& sizing, double spacing,
                           std::size_t count, Random& random) {
  const std::vector<Sample> samples = sample(surface, sizing, samples_per_node * count, random);
  Points nodes = pick_apart(surface, samples, spacing, count, random);
  const Projection project(surface);
  for (int sweep = 0; sweep < lloyd_sweeps; ++sweep) {
    nodes = means_of_nearest(nodes, samples);
    for (auto node : nodes.rowwise()) {
      node = project(node.transpose()).x;
    }
  }
  Eigen::Index kept = 0;
  for (Eigen::Index node = 0; node < nodes.rows(); ++node) {
    Projection::Foot foot = project(nodes.row(node).transpose());
    if (move_inside(foot.x, foot.normal, body, inward * spacing)) {
      nodes.row(kept++) = foot.x;
    }
  }
  nodes.conservativeResize(kept, 3);
  return nodes;
}

}  // namespace brainshift::discretise
