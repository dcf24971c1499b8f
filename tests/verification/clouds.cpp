// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "segmentation/geometry/neighbour_distance.hpp"

namespace brainshift::verification {

namespace {

using std::numbers::pi;

Eigen::Vector3d on_circle(double radius, double turns, double z) {
  return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), z};
}

/// Inner nodes keep off the boundary, or its nodes' supports would be crowded.
constexpr double from_boundary = 0.35;

}  // namespace

std::int64_t Darts::key(int i, int j, int k) const {
  constexpr std::int64_t offset = 1 << 20;
  return ((i + offset) << 42) + ((j + offset) << 21) + (k + offset);
}

bool Darts::put(const Eigen::Vector3d& position, bool on_surface) {
  const double least = fineness_ ? least_ * fineness_(position) : least_;
  const Eigen::Vector3i bucket = (position / least_).array().floor().cast<int>();
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const auto found = buckets_.find(key(bucket[0] + i, bucket[1] + j, bucket[2] + k));
        if (found != buckets_.end() && std::any_of(found->second.begin(), found->second.end(), [&](std::size_t a) {
              return (nodes_[a] - position).norm() < least;
            })) {
          return false;
        }
      }
    }
  }
  buckets_[key(bucket[0], bucket[1], bucket[2])].push_back(nodes_.size());
  nodes_.push_back(position);
  on_surface_.push_back(on_surface ? 1 : 0);
  return true;
}

void Darts::fill(const std::function<Eigen::Vector3d()>& place, bool on_surface) {
  for (int in_vain = 0; in_vain < 3000;) {
    in_vain = put(place(), on_surface) ? 0 : in_vain + 1;
  }
}

void Darts::along(double length, bool closed, const std::function<Eigen::Vector3d(double)>& place) {
  const double fineness = fineness_ ? fineness_(place(0)) : 1;
  const int parts = static_cast<int>(std::max(1.0, std::floor(length / (1.12 * fineness * least_))));
  for (int i = closed ? 0 : 1; i < parts; ++i) {
    put(place((i + 0.1 * (uniform() - 0.5)) / parts), true);
  }
}

NodeCloud Darts::cloud(bool planar) const {
  NodeCloud cloud;
  cloud.positions.resize(static_cast<Eigen::Index>(nodes_.size()), 3);
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    cloud.positions.row(static_cast<Eigen::Index>(a)) = nodes_[a];
  }
  cloud.on_surface = on_surface_;
  const int nearest = planar ? 4 : 6;
  cloud.spacing = mean_neighbour_distance(nearest_neighbours(cloud.positions, nearest), nearest);
  return cloud;
}

NodeCloud cylinder_cloud(double radius, double height, double least_distance, unsigned seed, const Grading& grading) {
  const auto fineness = [&](const Eigen::Vector3d& x) {
    double finest = 1;
    for (const Ring& ring : grading.rings) {
      const double away = std::hypot(ring.radius - x.head<2>().norm(), ring.z - x[2]) / grading.reach;
      finest = std::min(finest, grading.fineness + (1 - grading.fineness) * away);
    }
    return finest;
  };
  Darts darts(least_distance, seed, grading.rings.empty() ? std::function<double(const Eigen::Vector3d&)>() : fineness);
  std::vector<Ring> rings = grading.rings;
  rings.insert(rings.end(), {{radius, 0.0}, {radius, height}});
  for (const Ring& ring : rings) {
    darts.along(2 * pi * ring.radius, true, [&](double turns) { return on_circle(ring.radius, turns, ring.z); });
  }
  for (const double z : {0.0, height}) {
    darts.fill([&] { return on_circle(radius * std::sqrt(darts.uniform()), darts.uniform(), z); }, true);
  }
  darts.fill([&] { return on_circle(radius, darts.uniform(), height * darts.uniform()); }, true);
  const double off = from_boundary * darts.least_distance();
  darts.fill(
      [&] {
        return on_circle((radius - off) * std::sqrt(darts.uniform()), darts.uniform(),
                         off + (height - 2 * off) * darts.uniform());
      },
      false);
  return darts.cloud();
}

discretise::Refinement refinement_about(const Grading& grading, double radius) {
  constexpr int places = 60;  // a ring
  discretise::Refinement refinement{Points(static_cast<Eigen::Index>(grading.rings.size()) * places, 3), radius,
                                    grading.fineness};
  Eigen::Index row = 0;
  for (const Ring& ring : grading.rings) {
    for (int i = 0; i < places; ++i) {
      refinement.centres.row(row++) = on_circle(ring.radius, static_cast<double>(i) / places, ring.z);
    }
  }
  return refinement;
}

NodeCloud box_cloud(const Eigen::Vector3d& size, double least_distance, unsigned seed,
                    std::function<double(const Eigen::Vector3d&)> fineness) {
  Darts darts(least_distance, seed, std::move(fineness));
  for (int corner = 0; corner < 8; ++corner) {
    darts.put({(corner & 1) ? size[0] : 0, (corner & 2) ? size[1] : 0, (corner & 4) ? size[2] : 0}, true);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int edge = 0; edge < 4; ++edge) {
      darts.along(size[axis], false, [&](double share) {
        Eigen::Vector3d x;
        x[axis] = share * size[axis];
        x[(axis + 1) % 3] = (edge & 1) ? size[(axis + 1) % 3] : 0;
        x[(axis + 2) % 3] = (edge & 2) ? size[(axis + 2) % 3] : 0;
        return x;
      });
    }
  }
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    darts.fill(
        [&] {
          Eigen::Vector3d x(darts.uniform() * size[0], darts.uniform() * size[1], darts.uniform() * size[2]);
          x[axis] = face % 2 ? size[axis] : 0;
          return x;
        },
        true);
  }
  const double off = from_boundary * least_distance;
  darts.fill(
      [&] {
        const Eigen::Vector3d share(darts.uniform(), darts.uniform(), darts.uniform());
        return Eigen::Vector3d(off + share.array() * (size.array() - 2 * off));
      },
      false);
  return darts.cloud();
}

NodeCloud rectangle_cloud(double width, double height, double least_distance, unsigned seed,
                          std::function<double(const Eigen::Vector3d&)> fineness) {
  Darts darts(least_distance, seed, std::move(fineness));
  for (int corner = 0; corner < 4; ++corner) {
    darts.put({(corner & 1) ? width : 0, (corner & 2) ? height : 0, 0}, true);
  }
  for (const double y : {0.0, height}) {
    darts.along(width, false, [&](double share) { return Eigen::Vector3d(share * width, y, 0); });
  }
  for (const double x : {0.0, width}) {
    darts.along(height, false, [&](double share) { return Eigen::Vector3d(x, share * height, 0); });
  }
  const double off = from_boundary * least_distance;
  darts.fill(
      [&] {
        return Eigen::Vector3d(off + darts.uniform() * (width - 2 * off), off + darts.uniform() * (height - 2 * off),
                               0);
      },
      false);
  return darts.cloud(true);
}

NodeCloud half_ball_cloud(double radius, double least_distance, unsigned seed) {
  Darts darts(least_distance, seed);
  const auto on_ball = [&](double r) {
    const double up = darts.uniform();
    return on_circle(r * std::sqrt(1 - up * up), darts.uniform(), r * up);
  };
  darts.along(2 * pi * radius, true, [&](double turns) { return on_circle(radius, turns, 0); });
  darts.fill([&] { return on_circle(radius * std::sqrt(darts.uniform()), darts.uniform(), 0); }, true);
  darts.fill([&] { return on_ball(radius); }, true);
  const double off = from_boundary * least_distance;
  for (int in_vain = 0; in_vain < 3000;) {
    const Eigen::Vector3d x = on_ball((radius - off) * std::cbrt(darts.uniform()));
    in_vain = x.z() > off && darts.put(x, false) ? 0 : in_vain + 1;
  }
  return darts.cloud();
}

NodeCloud hollow_ball_cloud(double inner, double outer, double least_distance, unsigned seed) {
  Darts darts(least_distance, seed);
  const auto direction = [&] {
    const double z = darts.uniform(), angle = pi / 2 * darts.uniform(), flat = std::sqrt(1 - z * z);
    return Eigen::Vector3d(flat * std::cos(angle), flat * std::sin(angle), z);
  };
  const auto radius = [&] {
    return std::cbrt(std::pow(inner, 3) + darts.uniform() * (std::pow(outer, 3) - std::pow(inner, 3)));
  };
  const auto in_plane = [&](int axis) {
    Eigen::Vector3d x = direction();
    x[axis] = 0;
    return Eigen::Vector3d(x.normalized());
  };
  for (const double r : {inner, outer}) {
    for (int axis = 0; axis < 3; ++axis) {
      darts.put(r * Eigen::Vector3d::Unit(axis), true);
    }
    for (int axis = 0; axis < 3; ++axis) {
      darts.fill([&] { return Eigen::Vector3d(r * in_plane(axis)); }, true);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    darts.fill(
        [&] { return Eigen::Vector3d((inner + darts.uniform() * (outer - inner)) * Eigen::Vector3d::Unit(axis)); },
        true);
  }
  for (int axis = 0; axis < 3; ++axis) {
    darts.fill([&] { return Eigen::Vector3d(radius() * in_plane(axis)); }, true);
  }
  for (const double r : {inner, outer}) {
    darts.fill([&] { return Eigen::Vector3d(r * direction()); }, true);
  }
  const double off = from_boundary * least_distance;
  for (int in_vain = 0; in_vain < 3000;) {
    const Eigen::Vector3d x = radius() * direction();
    const double r = x.norm();
    const bool deep = x.minCoeff() > off && r > inner + off && r < outer - off;
    in_vain = deep && darts.put(x, false) ? 0 : in_vain + 1;
  }
  return darts.cloud();
}

Surface cylinder_surface(double radius, double height) {
  constexpr int sides = 240;
  Surface surface;
  surface.vertices.resize(2 * sides + 2, 3);
  surface.triangles.resize(4 * sides, 3);
  surface.vertices.row(2 * sides) << 0, 0, 0;
  surface.vertices.row(2 * sides + 1) << 0, 0, height;
  const double same_area = radius * std::sqrt(2 * pi / (sides * std::sin(2 * pi / sides)));
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    surface.vertices.row(i) = on_circle(same_area, static_cast<double>(i) / sides, 0);
    surface.vertices.row(sides + i) = on_circle(same_area, static_cast<double>(i) / sides, height);
    surface.triangles.row(4 * i) << i, next, sides + next;
    surface.triangles.row(4 * i + 1) << i, sides + next, sides + i;
    surface.triangles.row(4 * i + 2) << next, i, 2 * sides;
    surface.triangles.row(4 * i + 3) << sides + i, sides + next, 2 * sides + 1;
  }
  return surface;
}

Surface half_ball_surface(double radius) {
  constexpr int sides = 160, rings = 40;  // from the rim to the pole
  Surface surface;
  surface.vertices.resize(sides * rings + 2, 3);
  surface.triangles.resize(2 * sides * rings, 3);
  const int pole = sides * rings, middle = pole + 1;
  surface.vertices.row(pole) << 0, 0, radius;
  surface.vertices.row(middle) << 0, 0, 0;
  int triangle = 0;
  for (int k = 0; k < rings; ++k) {
    const double angle = pi / 2 * k / rings;
    for (int i = 0; i < sides; ++i) {
      const int a = k * sides + i, b = k * sides + (i + 1) % sides;
      surface.vertices.row(a) =
          on_circle(radius * std::cos(angle), static_cast<double>(i) / sides, radius * std::sin(angle));
      if (k == 0) {
        surface.triangles.row(triangle++) << middle, b, a;
      }
      if (k + 1 == rings) {
        surface.triangles.row(triangle++) << a, b, pole;
      } else {
        surface.triangles.row(triangle++) << a, b, b + sides;
        surface.triangles.row(triangle++) << a, b + sides, a + sides;
      }
    }
  }
  return surface;
}

BackgroundCells cells_over(const Surface& surface, std::size_t nodes, double cells_per_node,
                           const std::optional<discretise::Refinement>& refinement) {
  discretise::DiscretiseOptions options;
  options.nodes = nodes;
  options.cells_per_node = cells_per_node;
  options.craniotomy = refinement;
  return discretise::discretise(surface, nullptr, options).cells;
}

}  // namespace brainshift::verification
