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
#include "solve/output/field_difference.hpp"

namespace brainshift::solve {

namespace {

// both in spacings
constexpr double fineness = 0.5;
constexpr double off_face = 1e-3;

using Triple = std::array<std::int32_t, 3>;

/// Parts of a cut's facets inside the body, each vertex with the way from the cut to its face above.
class Sampling {
 public:
  Sampling(const Solution& solution, const InsideBody& inside)
      : cut_(solution.cut), spacing_(solution.spacing), inside_(inside), tree_(solution.positions) {
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
    corner_ = cut_.vertices.row(cut_.facets(facet, 0));
    first_ = Eigen::Vector3d(cut_.vertices.row(cut_.facets(facet, 1))) - corner_;
    second_.setZero();
    if (!cut_.planar) {
      second_ = Eigen::Vector3d(cut_.vertices.row(cut_.facets(facet, 2))) - corner_;
    }
    normal_ = (cut_.planar ? Eigen::Vector3d(-first_.y(), first_.x(), 0) : Eigen::Vector3d(first_.cross(second_)))
                  .normalized();
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
    const int corners = cut_.planar ? 2 : 3;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int i = 0; i < corners; ++i) {
      middle += place(part[static_cast<std::size_t>(i)]) / corners;
    }
    if (inside_(middle)) {
      parts_.push_back({vertex(part[0]), vertex(part[1]), cut_.planar ? -1 : vertex(part[2])});
    }
  }

  std::int32_t vertex(const Step& s) {
    const auto [known, is_new] = known_.try_emplace(s, static_cast<std::int32_t>(place_.size()));
    if (is_new) {
      place_.push_back(place(s));
      above_.push_back(off_face * spacing_at(place_.back()) * normal_);
    }
    return known->second;
  }

  const CutFacets& cut_;
  const std::vector<double>& spacing_;
  const InsideBody& inside_;
  PointTree tree_;

  // of the facet that is divided
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
