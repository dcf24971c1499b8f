// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/load_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "pipelines/runner/answer_warnings.hpp"
#include "segmentation/geometry/collinear.hpp"
#include "segmentation/geometry/distinct_points.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/geometry/quantile.hpp"
#include "segmentation/options/values.hpp"
#include "solve/load/near_surface.hpp"

namespace brainshift::pipelines {

namespace {

constexpr Eigen::Index few_places = 3;  // that a load is measured at

Points surface_of(const NodeCloud& cloud) {
  return cloud.positions(surface_nodes(cloud), Eigen::all);
}

double median_distance(const Points& points, const Points& surface) {
  const PointTree tree(surface);
  std::vector<double> distances;
  for (const auto& point : points.rowwise()) {
    distances.push_back(std::sqrt(tree.nearest(Eigen::RowVector3d(point).data()).second));
  }
  return median(std::move(distances));
}

/// The first row of each place.
std::vector<Eigen::Index> row_of_each_place(const Points& positions) {
  std::set<std::array<double, 3>> places;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index p = 0; p < positions.rows(); ++p) {
    if (places.insert({positions(p, 0), positions(p, 1), positions(p, 2)}).second) {
      rows.push_back(p);
    }
  }
  return rows;
}

/// Two displacements in one place, of which the mean counts.
Warnings warnings_of_repeated(const solve::CraniotomyLoad& load) {
  constexpr double alike = 1;  // mm
  std::map<std::array<double, 3>, Eigen::Index> first;
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::RowVector3d x = load.positions.row(p), u = load.displacement.row(p);
    const Eigen::RowVector3d before = load.displacement.row(first.try_emplace({x[0], x[1], x[2]}, p).first->second);
    const double apart = (u - before).norm();
    if (apart > alike && 2 * apart > std::max(u.norm(), before.norm())) {
      return {"at (" + write_numbers(x.array().round().matrix()) +
              ") mm two displacements are measured that differ by " + with_digits(apart) +
              " mm; their mean counts; take the wrong one out"};
    }
  }
  return {};
}

/// How far the measured points that move most, at least half as far as the farthest, move away from the middle of the
/// surface in the mean, mm, where that is most of how they move and enough to be seen; else 0. Of a load all over the
/// brain few move.
double moved_out(const solve::CraniotomyLoad& load, const Points& surface) {
  constexpr double seen = 1, most = 0.7, much = 0.5;
  constexpr int enough = 3;  // fewer may be outliers
  const Eigen::RowVector3d middle = surface.colwise().mean();
  const double farthest = load.displacement.rowwise().norm().maxCoeff();
  double out = 0, moved = 0;
  int count = 0;
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::RowVector3d u = load.displacement.row(p);
    if (u.norm() >= much * farthest) {
      out += u.dot((load.positions.row(p) - middle).normalized());
      moved += u.norm();
      ++count;
    }
  }
  return count >= enough && out > std::max(seen * count, most * moved) ? out / count : 0;
}

/// "(1 2 3), (4 5 6)", whole mm.
std::string listed(const Points& places) {
  std::string text;
  for (const auto& x : places.rowwise()) {
    text += (text.empty() ? "(" : ", (") + write_numbers(Eigen::RowVector3d(x.array().round())) + ")";
  }
  return text;
}

/// Neighbours that would tear the brain between them, as where two points were taken for each other. Noise does not
/// part them so far: what parts them is much more than what parts most.
Warnings warnings_of_neighbours(const solve::CraniotomyLoad& load) {
  constexpr double much = 3, most_strain = 1, of_most = 4;  // mm; 1; 1
  const std::vector<Eigen::Index> rows = row_of_each_place(load.positions);
  if (rows.size() < 3) {
    return {};
  }
  const Points places = load.positions(rows, Eigen::all), moved = load.displacement(rows, Eigen::all);
  const PointTree tree(places);
  std::vector<Eigen::Index> nearest(rows.size());
  std::vector<double> torn(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    std::array<std::size_t, 2> near{};  // the place itself is one
    std::array<double, 2> squared{};
    const auto row = static_cast<Eigen::Index>(p);
    const Eigen::RowVector3d place = places.row(row);
    tree.nearest(place.data(), near.size(), near.data(), squared.data());
    nearest[p] = static_cast<Eigen::Index>(near[1]);
    torn[p] = (moved.row(row) - moved.row(nearest[p])).norm();
  }
  const auto farthest = std::ranges::max_element(torn) - torn.begin();
  const Points both = places({farthest, nearest[static_cast<std::size_t>(farthest)]}, Eigen::all);
  const double apart = (both.row(0) - both.row(1)).norm(), most = torn[static_cast<std::size_t>(farthest)];
  if (most <= std::max({much, most_strain * apart, of_most * median(torn)})) {
    return {};
  }
  return {"the measured points at " + listed(both) + " mm, " + with_digits(apart) +
          " mm apart, move by vectors that differ by " + with_digits(most) +
          " mm; were points before and after paired as they belong?"};
}

}  // namespace

Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const Points& prescribed) {
  constexpr double usual_distance = 5.0;  // mm, of points on a cortex from the nodes of its surface
  Warnings warnings;
  const Points places = distinct_points(load.positions), surface = surface_of(cloud);
  const double distance = median_distance(places, surface);
  if (distance > std::max(usual_distance, median(cloud.spacing))) {
    warnings.push_back("the measured points lie " + with_digits(distance) +
                       " mm off the brain's surface (median); are load and image in the same frame, and were the "
                       "points taken on the cortex?");
  }
  if (load.sigma.rows() == 0) {  // else the noise says who is wrong: outliers()
    const Warnings repeated = warnings_of_repeated(load);
    append(repeated.empty() ? warnings_of_neighbours(load) : repeated, warnings);
  }
  constexpr double hardly = 0.05;  // mm
  if (load.displacement.isZero(0)) {
    warnings.emplace_back("all measured displacements are 0");
  } else if (const double most = load.displacement.rowwise().norm().maxCoeff(); most < hardly) {
    warnings.push_back("no measured point moves by more than " + with_digits(most) +
                       " mm, which nobody can measure; displacements in mm are expected");
  }
  if (const double out = moved_out(load, surface); out > 0) {
    warnings.push_back(
        "the measured points move out of the head, by " + with_digits(out) +
        " mm where they move most, as those of a brain that swells; if it sank, turn the signs: a displacement "
        "is where a point came to less where it was");
  }
  constexpr double hardly_any = 0.1;
  if (const double share = solve::share_not_taken(load.positions, cloud, prescribed); share > hardly_any) {
    warnings.push_back(with_digits(100 * share) +
                       " % of the measured points lie over no node that is loaded, and are lost; do they lie about one "
                       "opening, and is it flat enough?");
  }
  const bool few = places.rows() <= few_places;
  if (few || are_in_line(places)) {
    const auto loaded = std::ranges::count_if(prescribed.col(0), [](double u) { return std::isfinite(u); });
    warnings.push_back("the load is measured at " + std::to_string(places.rows()) + " places" +
                       (few ? "" : " on one line") + " and moves " + std::to_string(loaded) +
                       " nodes of the surface; measure more of the exposed cortex");
  }
  return warnings;
}

Warnings warnings_of(const solve::CraniotomyLoad& load, const NodeCloud& cloud, const solve::Conditions& conditions) {
  if (!conditions.measured || conditions.measured->inner.rows() == 0) {
    return warnings_of(load, cloud, conditions.displacement);
  }
  const solve::Measurement& measured = *conditions.measured;
  const Eigen::Index inner = measured.inner.rows(), all = inner + measured.cortex.rows();
  Warnings warnings;
  if (const Eigen::Index places = distinct_points(load.positions).rows(); places <= few_places) {
    warnings.push_back("the load is measured at " + std::to_string(places) +
                       " places; how the brain moves elsewhere, and how far off the answer is there, so few cannot "
                       "tell; measure more of them");
  }
  if (2 * inner > all) {
    warnings.push_back(std::to_string(inner) + " of " + std::to_string(all) +
                       " measured places lie more than 5 mm below the brain's surface and count as places inside it; "
                       "were they measured there, and are load and image in the same frame?");
  }
  if (measured.cortex.rows() > 0) {
    append(warnings_of({measured.cortex, measured.cortex_displacement, measured.sigma}, cloud, conditions.displacement),
           warnings);
  } else {
    append(warnings_of_neighbours(load), warnings);  // of these alone outliers() names none
  }
  return warnings;
}

Warnings warnings_of_held(const std::filesystem::path& file, const Points& displacement) {
  constexpr double many = 0.2;
  Eigen::Index loaded = 0, held = 0;
  for (const auto& u : displacement.rowwise()) {
    loaded += u.allFinite() ? 1 : 0;
    held += u.isZero(0) ? 1 : 0;
  }
  if (held == loaded || static_cast<double>(held) <= many * static_cast<double>(loaded)) {
    return {};
  }
  return {
      file.string() + " is exactly 0 at " + std::to_string(held) + " of " + std::to_string(loaded) +
      " nodes that it loads: they are held where they are; where a mask made it 0, make it NaN, or crop it, so that "
      "the brain is free there"};
}

Warnings warnings_of_sigma(const Points& sigma) {
  constexpr double nobody = 0.01;  // mm: measures as well as that
  const auto small = (sigma.array() < nobody).rowwise().any().count();
  if (small == 0) {
    return {};
  }
  return {"of " + std::to_string(sigma.rows()) + " measured points " + std::to_string(small) +
          " have a standard deviation below 0.01 mm, which nobody measures to; standard deviations in mm are expected"};
}

Warnings warnings_of(const solve::CraniotomyLoad& load, const solve::Model& model, const Points& displacement) {
  Warnings warnings = warnings_of_sigma(load.sigma);
  append(warnings_of(load, model.cloud, model.conditions), warnings);
  append(warnings_of(model, displacement), warnings);
  return warnings;
}

Warnings warnings_of(std::span<const solve::Outlier> outliers, bool may_be_robust) {
  if (outliers.empty()) {
    return {};
  }
  Points places(std::ssize(outliers), 3);
  for (std::size_t i = 0; i < outliers.size(); ++i) {
    places.row(static_cast<Eigen::Index>(i)) = outliers[i].position;
  }
  return {"what was measured near " + listed(places) + " mm is " + (outliers.size() > 1 ? "up to " : "") +
          with_digits(outliers.front().deviations) +
          " standard deviations from what the other points say; look at the points there, and give a wrong one a "
          "larger sigma or take it out" +
          (may_be_robust ? ", or let such points count for less with robust=\"yes\"" : "")};
}

Warnings warnings_of(const std::optional<solve::Outlier>& outlier, bool may_be_robust) {
  return outlier ? warnings_of(std::span(&*outlier, 1), may_be_robust) : Warnings();
}

Warnings warnings_of(const solve::LessenedPoints& lessened) {
  if (lessened.positions.rows() == 0) {
    return {};
  }
  return {"of " + std::to_string(lessened.all) + " measured points " + std::to_string(lessened.positions.rows()) +
          " contradict the others and count for less than half: at " + listed(lessened.positions) +
          " mm; look at what was measured there"};
}

}  // namespace brainshift::pipelines
