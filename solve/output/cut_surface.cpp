// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/cut_surface.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "segmentation/files/vtu_file.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "solve/cut/face_nodes.hpp"
#include "solve/output/field_difference.hpp"

namespace brainshift::solve {

namespace {

constexpr double fineness = 0.5;  // spacings

using Triple = std::array<std::int32_t, 3>;

constexpr std::int32_t no_vertex = -1;

int vertices_a_facet(const CutFacets& cut) {
  return cut.planar ? 2 : 3;
}

Eigen::Vector3d normal_of(const CutFacets& cut, Eigen::Index facet) {
  const Eigen::Vector3d corner = cut.vertices.row(cut.facets(facet, 0));
  const Eigen::Vector3d along = cut.vertices.row(cut.facets(facet, 1)).transpose() - corner;
  if (cut.planar) {
    return Eigen::Vector3d(-along.y(), along.x(), 0).normalized();
  }
  return along.cross(cut.vertices.row(cut.facets(facet, 2)).transpose() - corner).normalized();
}

/// At the vertices of a cut; zero where its facets bend sharply or more than two sides meet, so that no direction leads
/// off all of them.
Points normals_where_smooth(const CutFacets& cut) {
  constexpr double alike = 0.5;  // cosine
  Points sum = Points::Zero(cut.vertices.rows(), 3);
  for (Eigen::Index f = 0; f < cut.facets.rows(); ++f) {
    const Eigen::RowVector3d normal = normal_of(cut, f);
    for (int i = 0; i < vertices_a_facet(cut); ++i) {
      sum.row(cut.facets(f, i)) += normal;
    }
  }
  sum.rowwise().normalize();
  Points smooth = sum;
  for (Eigen::Index f = 0; f < cut.facets.rows(); ++f) {
    const Eigen::RowVector3d normal = normal_of(cut, f);
    for (int i = 0; i < vertices_a_facet(cut); ++i) {
      const std::int32_t v = cut.facets(f, i);
      if (!(sum.row(v).dot(normal) > alike)) {
        smooth.row(v).setZero();
      }
    }
  }
  return smooth;
}

/// Parts of a cut's facets inside the body, each vertex with the way from the cut to its face above.
class Sampling {
 public:
  Sampling(const Solution& solution, const InsideBody& inside)
      : cut_(solution.cut),
        spacing_(solution.spacing),
        inside_(inside),
        tree_(solution.positions),
        smooth_(normals_where_smooth(cut_)),
        shared_(static_cast<std::size_t>(cut_.vertices.rows()), no_vertex) {
    for (Eigen::Index f = 0; f < cut_.facets.rows(); ++f) {
      divide(f);
    }
  }

  Points places() const { return as_points(place_); }
  Points ways_above() const { return as_points(above_); }
  const std::vector<Triple>& parts() const { return parts_; }

 private:
  using Step = std::array<int, 2>;  ///< along a facet's first and second edge

  double spacing_at(const Eigen::Vector3d& x) const { return spacing_[tree_.nearest(x.data()).first]; }

  void divide(Eigen::Index facet) {
    facet_ = facet;
    corner_ = cut_.vertices.row(cut_.facets(facet, 0));
    first_ = Eigen::Vector3d(cut_.vertices.row(cut_.facets(facet, 1))) - corner_;
    second_.setZero();
    if (!cut_.planar) {
      second_ = Eigen::Vector3d(cut_.vertices.row(cut_.facets(facet, 2))) - corner_;
    }
    normal_ = normal_of(cut_, facet);
    const double longest = std::max({first_.norm(), second_.norm(), (second_ - first_).norm()});
    steps_ =
        std::max(1, static_cast<int>(std::ceil(longest / (fineness * spacing_at(corner_ + first_ / 3 + second_ / 3)))));
    known_.clear();
    for (int i = 0; i < steps_; ++i) {
      for (int j = 0; j < (cut_.planar ? 1 : steps_ - i); ++j) {
        add({Step{i, j}, Step{i + 1, j}, Step{i, j + 1}});
        if (!cut_.planar && i + j + 1 < steps_) {
          add({Step{i + 1, j}, Step{i + 1, j + 1}, Step{i, j + 1}});
        }
      }
    }
  }

  Eigen::Vector3d place(const Step& s) const { return corner_ + (first_ * s[0] + second_ * s[1]) / steps_; }

  void add(const std::array<Step, 3>& part) {
    const int corners = vertices_a_facet(cut_);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int i = 0; i < corners; ++i) {
      middle += place(part[static_cast<std::size_t>(i)]) / corners;
    }
    if (inside_(middle)) {
      parts_.push_back({vertex(part[0]), vertex(part[1]), cut_.planar ? no_vertex : vertex(part[2])});
    }
  }

  std::int32_t vertex(const Step& s) {
    const bool corner = (s[0] == 0 || s[0] == steps_) && (s[1] == 0 || s[1] == steps_);
    if (corner) {
      const std::int32_t v = cut_.facets(facet_, s[0] > 0 ? 1 : s[1] > 0 ? 2 : 0);
      if (!smooth_.row(v).isZero(0)) {
        std::int32_t& shared = shared_[static_cast<std::size_t>(v)];
        shared = shared == no_vertex ? add_vertex(place(s), smooth_.row(v)) : shared;
        return shared;
      }
    }
    std::int32_t& known = known_.try_emplace(s, no_vertex).first->second;
    known = known == no_vertex ? add_vertex(place(s), normal_) : known;
    return known;
  }

  std::int32_t add_vertex(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
    place_.push_back(place);
    above_.push_back(off_face * spacing_at(place) * normal);
    return static_cast<std::int32_t>(place_.size() - 1);
  }

  const CutFacets& cut_;
  const std::vector<double>& spacing_;
  const InsideBody& inside_;
  PointTree tree_;
  Points smooth_;                     ///< normals
  std::vector<std::int32_t> shared_;  ///< by all facets about a vertex of the cut: its number here

  // of the facet that is divided
  Eigen::Index facet_ = 0;
  Eigen::Vector3d corner_, first_, second_, normal_;
  int steps_ = 1;
  std::map<Step, std::int32_t> known_;

  std::vector<Eigen::Vector3d> place_, above_;
  std::vector<Triple> parts_;
};

}  // namespace

CutSurface cut_surface(const Solution& solution, const InsideBody& inside) {
  const Sampling sampling(solution, inside);
  const Points places = sampling.places(), above = sampling.ways_above();
  const Eigen::Index vertices = places.rows();
  const auto parts = static_cast<Eigen::Index>(sampling.parts().size());
  CutSurface surface;
  surface.vertices.resize(2 * vertices, 3);
  surface.vertices << places, places;
  Points sides = surface.vertices;
  sides.topRows(vertices) += above;
  sides.bottomRows(vertices) -= above;
  surface.displacement = displacement_at(solution, sides);
  surface.side.assign(static_cast<std::size_t>(vertices), 1);
  surface.side.resize(static_cast<std::size_t>(2 * vertices), -1);
  surface.facets.resize(2 * parts, 3);
  for (Eigen::Index p = 0; p < parts; ++p) {
    const Triple& part = sampling.parts()[static_cast<std::size_t>(p)];
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = part[static_cast<std::size_t>(i)];
      surface.facets(p, i) = v;
      surface.facets(parts + p, i) = v < 0 ? v : v + static_cast<std::int32_t>(vertices);
    }
  }
  return surface;
}

void write_cut_surface(const std::filesystem::path& file, const CutSurface& surface) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtu::to_vtk(surface.vertices));
  vtkNew<vtkCellArray> cells;
  bool lines = false;
  for (const auto& facet : surface.facets.rowwise()) {
    lines = facet[2] < 0;
    const std::array<vtkIdType, 3> corners{facet[0], facet[1], facet[2]};
    cells->InsertNextCell(lines ? 2 : 3, corners.data());
  }
  lines ? data->SetLines(cells) : data->SetPolys(cells);
  const Points& u = surface.displacement;
  vtu::add_array(*data->GetPointData(), "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
  vtu::add_array(*data->GetPointData(), "side", surface.side);
  vtu::write(file, *data);
}

}  // namespace brainshift::solve
