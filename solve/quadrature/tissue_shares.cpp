// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/tissue_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>

#include "solve/quadrature/gauss_points.hpp"

namespace brainshift::solve {

namespace {

constexpr int fewest_samples = 4, most_samples = 8;  // along a cell

/// Where samples lie: a row a sample, with the share of each of the cell's corners in it.
using SampleWeights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Takes the unit square onto the triangle of its first corner, the unit cube onto such a tetrahedron, evenly (Rocchini
/// & Cignoni 2000, Journal of Graphics Tools 5:4).
void fold(bool solid, double& s, double& t, double& u) {
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  if (!solid) {
    return;
  }
  const double was = u;
  if (t + u > 1) {
    u = 1 - s - t;
    t = 1 - was;
  } else if (s + t + u > 1) {
    u = s + t + u - 1;
    s = 1 - t - was;
  }
}

SampleWeights sample_weights(CellKind kind, int along) {
  const bool solid = !is_planar(kind);
  const bool folds = kind == CellKind::tetrahedron || kind == CellKind::triangle;
  const int layers = solid ? along : 1;
  SampleWeights weights(along * along * layers, corner_count(kind));
  Eigen::Index row = 0;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < along; ++i, ++row) {
        double s = (i + 0.5) / along, t = (j + 0.5) / along, u = solid ? (k + 0.5) / along : 0;
        if (folds) {
          fold(solid, s, t, u);
          const std::array<double, 4> shares = {1 - s - t - u, s, t, u};
          weights.row(row) = Eigen::Map<const Eigen::RowVectorXd>(shares.data(), weights.cols());
          continue;
        }
        const double level[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
        for (Eigen::Index c = 0; c < weights.cols(); ++c) {
          weights(row, c) = level[c % 4] * (c < 4 ? 1 - u : u);
        }
      }
    }
  }
  return weights;
}

/// What the samples of one tissue say.
struct Samples {
  int count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of their places

  void add(const Eigen::Vector3d& place) {
    ++count;
    sum += place;
  }
  Eigen::Vector3d middle() const { return sum / count; }
};

using SamplesByTissue = std::map<std::int32_t, Samples>;

/// The points of one cell, and how it is sampled.
class CellSampler {
 public:
  CellSampler(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues)
      : cells_(cells), labels_(labels), tissues_(tissues) {
    for (int along = fewest_samples; along <= most_samples; ++along) {
      weights_.push_back(sample_weights(cells.kind, along));
    }
  }

  /// Of each of the cell's points, which lie in these rows of `places`; nothing where the cell has one tissue.
  void sample(std::size_t cell, const Points& places, Eigen::Index first, std::span<SamplesByTissue> of_points) const {
    const Corners corners = corners_of(cells_, cell);
    const Points at = weights_for(corners) * corners;
    std::vector<std::int32_t> tissue(static_cast<std::size_t>(at.rows()));
    std::int32_t one = 0;
    bool several = false;
    for (std::size_t i = 0; i < tissue.size(); ++i) {
      tissue[i] = tissue_at(at.row(static_cast<Eigen::Index>(i)));
      several |= one != 0 && tissue[i] != 0 && tissue[i] != one;
      one = tissue[i] != 0 ? tissue[i] : one;
    }
    for (std::size_t i = 0; several && i < tissue.size(); ++i) {
      if (tissue[i] != 0) {
        const Eigen::Vector3d place = at.row(static_cast<Eigen::Index>(i));
        Eigen::Index nearest = 0;
        (places.middleRows(first, std::ssize(of_points)).rowwise() - place.transpose())
            .rowwise()
            .squaredNorm()
            .minCoeff(&nearest);
        of_points[static_cast<std::size_t>(nearest)][tissue[i]].add(place);
      }
    }
  }

 private:
  const SampleWeights& weights_for(const Corners& corners) const {
    const double edge = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).maxCoeff();
    const double along = std::ceil(edge / labels_.geometry.spacing.minCoeff());
    const double taken = std::clamp<double>(along, fewest_samples, most_samples);
    return weights_[static_cast<std::size_t>(taken) - fewest_samples];
  }

  /// 0 where none is known.
  std::int32_t tissue_at(const Eigen::Vector3d& place) const {
    const std::int32_t label = label_at(labels_, place);
    return std::ranges::find(tissues_, label) != tissues_.end() ? label : 0;
  }

  const BackgroundCells& cells_;
  const LabelMap& labels_;
  const std::vector<std::int32_t>& tissues_;
  std::vector<SampleWeights> weights_;
};

/// The first point of each cell that has any, and the end.
std::vector<std::size_t> firsts_of_cells(const IntegrationPoints& points) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points.cell[i] != points.cell[i - 1]) {
      first.push_back(i);
    }
  }
  first.push_back(points.size());
  return first;
}

/// Of each point what lies about it; nothing where its cell has one tissue.
std::vector<SamplesByTissue> samples_about(const IntegrationPoints& points, const CellSampler& sampler) {
  const std::vector<std::size_t> first = firsts_of_cells(points);
  const std::size_t cells = first.size() - 1;
  std::vector<SamplesByTissue> about(points.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t c = 0; c < cells; ++c) {
    sampler.sample(static_cast<std::size_t>(points.cell[first[c]]), points.positions,
                   static_cast<Eigen::Index>(first[c]), std::span(about).subspan(first[c], first[c + 1] - first[c]));
  }
  return about;
}

/// Points one after the other.
class PointList {
 public:
  void add(const Eigen::Vector3d& place, double volume, std::int32_t cell, std::int32_t label) {
    places_.push_back(place);
    points_.volume.push_back(volume);
    points_.cell.push_back(cell);
    points_.label.push_back(label);
  }

  IntegrationPoints take() {
    points_.positions.resize(std::ssize(places_), 3);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      points_.positions.row(static_cast<Eigen::Index>(i)) = places_[i];
    }
    return std::move(points_);
  }

 private:
  std::vector<Eigen::Vector3d> places_;
  IntegrationPoints points_;
};

}  // namespace

void part_by_tissue(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues,
                    IntegrationPoints& points, std::vector<double>& full) {
  const std::vector<SamplesByTissue> about = samples_about(points, CellSampler(cells, labels, tissues));
  PointList parted;
  std::vector<double> parted_full;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d place = points.positions.row(static_cast<Eigen::Index>(i));
    parted_full.resize(parted_full.size() + std::max<std::size_t>(1, about[i].size()), full[i]);
    if (about[i].size() < 2) {
      parted.add(place, points.volume[i], points.cell[i], points.label[i]);
      continue;
    }
    Samples all;
    for (const auto& [tissue, samples] : about[i]) {
      all.count += samples.count;
      all.sum += samples.sum;
    }
    for (const auto& [tissue, samples] : about[i]) {
      parted.add(place + samples.middle() - all.middle(), points.volume[i] * samples.count / all.count, points.cell[i],
                 tissue);
    }
  }
  const std::size_t labelled_by_cell = points.labelled_by_cell;
  points = parted.take();
  points.labelled_by_cell = labelled_by_cell;
  full = std::move(parted_full);
}

}  // namespace brainshift::solve
