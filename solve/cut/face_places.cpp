// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/face_places.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "segmentation/geometry/branching_edges.hpp"
#include "segmentation/geometry/nearest_on_segment.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/cut/quarters.hpp"

namespace brainshift::solve {

namespace {

// all in spacings
constexpr double split_within = 0.33;
constexpr double split_apart = 0.6;
constexpr double added_apart = 0.85;
constexpr double from_front = 0.5;
constexpr double from_rim = 0.25;  // of a septum
constexpr double sampling = 0.05;
constexpr double mouth_within = 0.5;  // so near to a mouth a node is moved there: two would be too near to each other
constexpr double mouth_apart = 0.6;
constexpr double at_once = 40;  // of a facet: farther than any that lies in a body of so many nodes

using Edge = std::array<std::int32_t, 2>;

class CutFaces {
 public:
  /// septum: whether nodes stand along the fronts.
  CutFaces(const CutFacets& cut, const InsideBody& inside, const NodeCloud& cloud, const std::vector<FacePair>& pairs,
           bool septum)
      : cut_(cut),
        inside_(inside),
        cloud_(cloud),
        tree_(cloud.positions),
        from_front_(septum ? 0.99 * from_rim : from_front),
        septum_(septum),
        kept_clear_(cut.front),
        is_face_(cloud.size(), 0) {
    if (septum) {
      const std::vector<Edge> branches = branching_edges(cut.facets);
      kept_clear_.insert(kept_clear_.end(), branches.begin(), branches.end());
    }
    for (const FacePair& p : pairs) {
      taken_.push_back(p.place);
      is_face_[static_cast<std::size_t>(p.above)] = is_face_[static_cast<std::size_t>(p.below)] = 1;
    }
  }

  std::vector<PairPlace> places() {
    if (cut_.planar) {
      add_mouths();
    }
    if (septum_) {
      add_rims();
    }
    split_nodes(true);
    split_nodes(false);
    for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
      add_pairs(f);
    }
    return std::move(places_);
  }

 private:
  Eigen::Vector3d corner(Eigen::Index facet, int i) const { return cut_.vertices.row(cut_.facets(facet, i)); }
  double spacing(std::int32_t node) const { return cloud_.spacing[static_cast<std::size_t>(node)]; }

  double distance(std::int32_t node, const Eigen::Vector3d& x) const {
    return (cloud_.positions.row(node).transpose() - x).norm();
  }

  Eigen::Vector3d normal(Eigen::Index f) const {
    const Eigen::Vector3d along = corner(f, 1) - corner(f, 0);
    return (cut_.planar ? Eigen::Vector3d(-along.y(), along.x(), 0)
                        : Eigen::Vector3d(along.cross(corner(f, 2) - corner(f, 0))))
        .normalized();
  }

  /// The foot of x on the facet; false where the perpendicular misses it.
  bool project(Eigen::Index f, const Eigen::Vector3d& x, Eigen::Vector3d& foot) const {
    const Eigen::Vector3d a = corner(f, 0), n = normal(f);
    foot = x - n * n.dot(x - a);
    constexpr double slack = 1e-6;
    const int corners = cut_.planar ? 2 : 3;
    for (int i = 0; i < corners; ++i) {
      const Eigen::Vector3d from = corner(f, i), along = corner(f, (i + 1) % corners) - from;
      const Eigen::Vector3d in = cut_.planar ? along : Eigen::Vector3d(n.cross(along));
      if ((foot - from).dot(in) < -slack * in.squaredNorm()) {
        return false;
      }
    }
    return true;
  }

  bool clear_of_front(const Eigen::Vector3d& x, double h) const {
    return std::all_of(kept_clear_.begin(), kept_clear_.end(), [&](const Edge& edge) {
      const Eigen::Vector3d nearest = nearest_on_segment(x, cut_.vertices.row(edge[0]), cut_.vertices.row(edge[1]));
      return (nearest - x).norm() > from_front_ * h;
    });
  }

  /// Where the line between two nodes on either side of the facet goes through it.
  std::optional<Eigen::Vector3d> crossing(Eigen::Index f, std::int32_t a, std::int32_t b) const {
    const Eigen::Vector3d from = cloud_.positions.row(a), to = cloud_.positions.row(b), n = normal(f);
    const double above = n.dot(from - corner(f, 0)), below = n.dot(to - corner(f, 0));
    Eigen::Vector3d foot;
    if (above * below >= 0 || !project(f, from + above / (above - below) * (to - from), foot)) {
      return {};
    }
    return foot;
  }

  void take(std::int32_t node, std::int32_t like, const Eigen::Vector3d& x, Eigen::Index facet, double apart) {
    const double h = spacing(like);
    const bool crowded = std::any_of(taken_.begin(), taken_.end(), [&](const Eigen::Vector3d& other) {
      return (other - x).squaredNorm() < apart * apart * h * h;
    });
    if (crowded) {
      return;
    }
    const bool clear = clear_of_front(x, h);
    if (clear || node != no_node) {
      taken_.push_back(x);  // a node too near to the front is split later, and the place kept for it
    }
    if (clear) {
      places_.push_back({.node = node, .like = like, .x = x, .normal = normal(facet)});
    }
    if (node != no_node) {
      is_face_[static_cast<std::size_t>(node)] = 1;
    }
  }

  void split_nodes(bool on_surface) {
    for (Eigen::Index a = 0; a < cloud_.positions.rows(); ++a) {
      const auto node = static_cast<std::int32_t>(a);
      const auto k = static_cast<std::size_t>(a);
      if ((cloud_.on_surface[k] != 0) != on_surface || is_face_[k] != 0) {
        continue;
      }
      Eigen::Index nearest = no_node;
      double distance = split_within * cloud_.spacing[k];
      Eigen::Vector3d place, foot;
      for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
        const Eigen::Vector3d x = cloud_.positions.row(a);
        if (project(f, x, foot) && (foot - x).norm() <= distance) {
          distance = (foot - x).norm();
          nearest = f;
          place = foot;
        }
      }
      if (nearest != no_node) {
        take(node, node, place, nearest, split_apart);
      }
    }
  }

  /// Where a path leaves the body between two nodes of its surface, nearest neighbours first: without nodes of its own
  /// the corner of a face there is badly held.
  void add_mouths() {
    struct Mouth {
      double length;
      Eigen::Index facet;
      std::int32_t nearest;
      Eigen::Vector3d x;
    };
    std::vector<Mouth> mouths;
    for (const auto& [a, b] : surface_neighbours()) {
      const double length = (cloud_.positions.row(a) - cloud_.positions.row(b)).norm();
      for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
        if (const auto x = crossing(f, a, b)) {
          const bool a_nearer = distance(a, *x) <= distance(b, *x);
          mouths.push_back({.length = length, .facet = f, .nearest = a_nearer ? a : b, .x = *x});
        }
      }
    }
    std::stable_sort(mouths.begin(), mouths.end(), [](const Mouth& a, const Mouth& b) { return a.length < b.length; });
    for (const Mouth& m : mouths) {
      const bool there = distance(m.nearest, m.x) <= mouth_within * spacing(m.nearest);
      if (!there || is_face_[static_cast<std::size_t>(m.nearest)] == 0) {
        take(there ? m.nearest : no_node, m.nearest, m.x, m.facet, mouth_apart);
      }
    }
  }

  /// Pairs of nodes of the body's surface, face nodes aside, that are near each other and the cut.
  std::vector<std::pair<std::int32_t, std::int32_t>> surface_neighbours() const {
    std::vector<std::int32_t> near;
    for (Eigen::Index a = 0; a < cloud_.positions.rows(); ++a) {
      const auto k = static_cast<std::size_t>(a);
      if (cloud_.on_surface[k] != 0 && is_face_[k] == 0 && near_cut(cloud_.positions.row(a), cloud_.spacing[k])) {
        near.push_back(static_cast<std::int32_t>(a));
      }
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (std::size_t j = i + 1; j < near.size(); ++j) {
        const double length = (cloud_.positions.row(near[i]) - cloud_.positions.row(near[j])).norm();
        if (length < next_on_surface * std::min(spacing(near[i]), spacing(near[j]))) {
          pairs.emplace_back(near[i], near[j]);
        }
      }
    }
    return pairs;
  }

  bool near_cut(const Eigen::Vector3d& x, double h) const {
    Eigen::Vector3d foot;
    for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
      if (project(f, x, foot) && (foot - x).norm() < next_on_surface * h) {
        return true;
      }
    }
    return false;
  }

  /// Tries places close together over the facet.
  void add_pairs(Eigen::Index f) { add_pairs(f, {corner(f, 0), corner(f, 1), corner(f, cut_.planar ? 0 : 2)}); }

  /// The same over part of it; of a large part where it comes near the body.
  void add_pairs(Eigen::Index f, const Triangle& part) {
    const Eigen::Vector3d a = part.a, first = part.b - a, second = part.c - a;
    const double h = spacing(nearest_node(a + first / 3 + second / 3)), longest = std::max(first.norm(), second.norm());
    if (!cut_.planar && longest > at_once * h) {
      for (const Triangle& quarter : quarters(part)) {
        if (inside_.is_within(quarter.centroid(), reach_of(quarter))) {
          add_pairs(f, quarter);
        }
      }
      return;
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(longest / (sampling * h))));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= (cut_.planar ? 0 : steps - i); ++j) {
        const Eigen::Vector3d x =
            a + first * (i / static_cast<double>(steps)) + second * (j / static_cast<double>(steps));
        if (inside_(x)) {
          take(no_node, nearest_node(x), x, f, added_apart);
        }
      }
    }
  }

  /// Beside each front, in the facet that ends there.
  void add_rims() {
    for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = cut_.facets(f, i), b = cut_.facets(f, (i + 1) % 3);
        const bool is_front = std::any_of(cut_.front.begin(), cut_.front.end(), [&](const auto& edge) {
          return edge[0] == std::min(a, b) && edge[1] == std::max(a, b);
        });
        if (is_front) {
          add_rim(f, corner(f, i), corner(f, (i + 1) % 3));
        }
      }
    }
  }

  void add_rim(Eigen::Index f, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d inward = normal(f).cross(to - from).normalized();
    const double h = spacing(nearest_node((from + to) / 2));
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / (sampling * h))));
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector3d rim = from + (to - from) * (i / static_cast<double>(steps));
      const std::int32_t like = nearest_node(rim);
      const Eigen::Vector3d x = rim + from_rim * spacing(like) * inward;
      if (inside_(x)) {
        take(no_node, like, x, f, added_apart);
      }
    }
  }

  std::int32_t nearest_node(const Eigen::Vector3d& x) const {
    return static_cast<std::int32_t>(tree_.nearest(x.data()).first);
  }

  const CutFacets& cut_;
  const InsideBody& inside_;
  const NodeCloud& cloud_;
  PointTree tree_;
  double from_front_;  ///< spacings
  bool septum_;
  std::vector<Edge> kept_clear_;  ///< fronts, and where a septum branches: there a face has no two sides
  std::vector<std::uint8_t> is_face_;
  std::vector<Eigen::Vector3d> taken_;
  std::vector<PairPlace> places_;
};

}  // namespace

std::vector<PairPlace> face_places(const CutFacets& cut, const InsideBody& inside, const NodeCloud& cloud,
                                   const std::vector<FacePair>& pairs) {
  return CutFaces(cut, inside, cloud, pairs, false).places();
}

std::vector<PairPlace> septum_places(const CutFacets& septum, const InsideBody& inside, const NodeCloud& cloud,
                                     const std::vector<FacePair>& pairs) {
  return CutFaces(septum, inside, cloud, pairs, true).places();
}

}  // namespace brainshift::solve
