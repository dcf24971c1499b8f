// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cut/sheet_topology.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace brainshift::solve {
namespace {

using VertexPair = std::pair<std::int32_t, std::int32_t>;  // the lower vertex first

/// The side of a triangle from that corner to the next.
struct Side {
  Eigen::Index triangle;
  int corner;
};

using Edges = std::map<VertexPair, std::vector<Side>>;

std::int32_t from(const Surface& sheet, const Side& side) {
  return sheet.triangles(side.triangle, side.corner);
}
std::int32_t to(const Surface& sheet, const Side& side) {
  return sheet.triangles(side.triangle, (side.corner + 1) % 3);
}

[[noreturn]] void refuse(const std::string& name, const std::string& what, const Eigen::RowVector3d& at,
                         const std::string& advice) {
  std::ostringstream text;
  text << name << ": " << what << " at (" << at[0] << ", " << at[1] << ", " << at[2] << ") mm; " << advice;
  throw std::invalid_argument(text.str());
}

Edges edges_of(const Surface& sheet) {
  Edges edges;
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const Side side{t, corner};
      edges[std::minmax({from(sheet, side), to(sheet, side)})].push_back(side);
    }
  }
  return edges;
}

void check_edges(const Surface& sheet, const Edges& edges, const std::string& name) {
  for (const auto& [edge, sides] : edges) {
    if (sides.size() > 2) {
      refuse(name, std::to_string(sides.size()) + " triangles share an edge",
             (sheet.vertices.row(edge.first) + sheet.vertices.row(edge.second)) / 2,
             "a cut does not branch: make each branch a cut of its own");
    }
  }
}

/// Turns triangles to agree with the first, from neighbour to neighbour.
void orient(Surface& sheet, const Edges& edges, const std::string& name) {
  const auto side_of = [&](const Side& side) -> const std::vector<Side>& {
    return edges.at(std::minmax({from(sheet, side), to(sheet, side)}));
  };
  const auto agree = [&](const std::vector<Side>& sides) { return from(sheet, sides[0]) != from(sheet, sides[1]); };
  Eigen::ArrayX<bool> reached = Eigen::ArrayX<bool>::Constant(sheet.triangles.rows(), false);
  Eigen::ArrayX<bool> turned = reached;
  std::vector<Eigen::Index> order = {0};
  reached[0] = true;
  for (std::size_t next = 0; next < order.size(); ++next) {
    const Eigen::Index t = order[next];
    for (int corner = 0; corner < 3; ++corner) {
      const std::vector<Side>& sides = side_of({t, corner});
      if (sides.size() < 2) {
        continue;
      }
      const Eigen::Index other = sides[sides[0].triangle == t ? 1 : 0].triangle;
      const bool turn = turned[t] == agree(sides);
      if (reached[other] && turned[other] != turn) {
        refuse(name, "the sheet has one side only, like a Moebius strip: no two sides are told apart",
               sheet.vertices.row(from(sheet, sides[0])), "open it there, or make it two cuts");
      }
      if (!reached[other]) {
        reached[other] = true;
        turned[other] = turn;
        order.push_back(other);
      }
    }
  }
  for (Eigen::Index t = 0; t < turned.size(); ++t) {
    if (!reached[t]) {
      refuse(name, "the sheet is in pieces that share no edge, one of them", sheet.vertices.row(sheet.triangles(t, 0)),
             "give each piece its own file, or merge points that are there twice");
    }
    if (turned[t]) {
      std::swap(sheet.triangles(t, 1), sheet.triangles(t, 2));
    }
  }
}

/// The triangles at a vertex must hang together by edges at it.
void check_vertices(const Surface& sheet, const Edges& edges, const std::string& name) {
  const Eigen::Index corners = sheet.triangles.size();
  // Of each corner, another that hangs together with it, or itself.
  Eigen::VectorX<Eigen::Index> fan = Eigen::VectorX<Eigen::Index>::LinSpaced(corners, 0, corners - 1);
  const auto root = [&](Eigen::Index corner) {
    while (fan[corner] != corner) {
      corner = fan[corner] = fan[fan[corner]];
    }
    return corner;
  };
  const auto corner_at = [&](const Side& side, std::int32_t vertex) {
    return 3 * side.triangle + (from(sheet, side) == vertex ? side.corner : (side.corner + 1) % 3);
  };
  for (const auto& [edge, sides] : edges) {
    for (const std::int32_t vertex : {edge.first, edge.second}) {
      if (sides.size() == 2) {
        fan[root(corner_at(sides[0], vertex))] = root(corner_at(sides[1], vertex));
      }
    }
  }
  Eigen::VectorX<Eigen::Index> known = Eigen::VectorX<Eigen::Index>::Constant(sheet.vertices.rows(), -1);
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    const std::int32_t vertex = sheet.triangles(corner / 3, corner % 3);
    if (known[vertex] >= 0 && known[vertex] != root(corner)) {
      refuse(name, "parts of the sheet hang together by one vertex only", sheet.vertices.row(vertex),
             "join them by an edge, or make them cuts of their own");
    }
    known[vertex] = root(corner);
  }
}

struct Rim {
  double length = 0;  ///< mm
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
};

/// The closed lines of edges with one triangle, the longest first.
std::vector<Rim> rims_of(const Surface& sheet, const Edges& edges) {
  std::map<std::int32_t, std::int32_t> next;
  for (const auto& [edge, sides] : edges) {
    if (sides.size() == 1) {
      next[from(sheet, sides[0])] = to(sheet, sides[0]);
    }
  }
  std::vector<Rim> rims;
  while (!next.empty()) {
    Rim rim;
    int vertices = 0;
    for (auto at = next.begin(); at != next.end(); ++vertices) {
      const Eigen::RowVector3d begin = sheet.vertices.row(at->first), end = sheet.vertices.row(at->second);
      rim.length += (end - begin).norm();
      rim.centre += begin;
      const std::int32_t follows = at->second;
      next.erase(at);
      at = next.find(follows);
    }
    rim.centre /= vertices;
    rims.push_back(rim);
  }
  std::sort(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) { return a.length > b.length; });
  return rims;
}

void check_rims(const Surface& sheet, const Edges& edges, const std::string& name) {
  const std::vector<Rim> rims = rims_of(sheet, edges);
  if (rims.empty()) {
    throw std::invalid_argument(name +
                                ": the sheet is closed and cuts out a part that nothing holds; open it, or take the "
                                "part out by a resection");
  }
  if (rims.size() > 1) {
    std::ostringstream text;
    text << "the sheet has a hole, its rim " << rims[1].length << " mm long, around its centre";
    refuse(name, text.str(), rims[1].centre, "close it, or leave it out by making the sheet two cuts");
  }
}

}  // namespace

void check_triangles(const Surface& sheet, const std::string& name) {
  constexpr double least_height = 1e-6;  // of the longest side
  for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t) {
    const Eigen::Vector3d a = sheet.vertices.row(sheet.triangles(t, 0));
    const Eigen::Vector3d b = sheet.vertices.row(sheet.triangles(t, 1));
    const Eigen::Vector3d c = sheet.vertices.row(sheet.triangles(t, 2));
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if (!((b - a).cross(c - a).norm() > least_height * longest)) {
      refuse(name, "triangle " + std::to_string(t + 1) + " has no area", (a + b + c).transpose() / 3, "remove it");
    }
  }
}

Surface oriented_sheet(Surface sheet, const std::string& name) {
  check_triangles(sheet, name);
  const Edges edges = edges_of(sheet);
  check_edges(sheet, edges, name);
  orient(sheet, edges, name);
  const Edges oriented = edges_of(sheet);
  check_vertices(sheet, oriented, name);
  check_rims(sheet, oriented, name);
  return sheet;
}

}  // namespace brainshift::solve
