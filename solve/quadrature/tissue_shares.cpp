// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/quadrature/tissue_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "solve/quadrature/gauss_points.hpp"
#include "solve/quadrature/place_points.hpp"

namespace brainshift::solve {

namespace {

// Samples along a cell. They are even in number: none then lies midway between two points of a hexahedron.
constexpr int fewest_samples = 4, most_samples = 8;
constexpr double least_part = 0.1;  // of a point

/// Where samples lie: a row a sample, with the share of each of the cell's corners in it.
using SampleWeights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The middles of equal parts of a hexahedron or quadrilateral, `along` of them along each edge.
SampleWeights samples_of_box(int dimensions, int along) {
  const int layers = dimensions == 3 ? along : 1;
  SampleWeights weights(along * along * layers, 1 << dimensions);
  Eigen::Index row = 0;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < along; ++i, ++row) {
        const double s = (i + 0.5) / along, t = (j + 0.5) / along, u = dimensions == 3 ? (k + 0.5) / along : 0;
        const double level[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
        for (Eigen::Index c = 0; c < weights.cols(); ++c) {
          weights(row, c) = level[c % 4] * (c < 4 ? 1 - u : u);
        }
      }
    }
  }
  return weights;
}

/// The centroids of the equal simplices that Kuhn's triangulation of a grid has within 1 > x > y (> z) > 0, which is
/// taken onto the cell: along³ tetrahedra or along² triangles.
SampleWeights samples_of_simplex(int dimensions, int along) {
  SampleWeights weights(dimensions == 3 ? along * along * along : along * along, dimensions + 1);
  Eigen::Index row = 0;
  for (int k = 0; k < (dimensions == 3 ? along : 1); ++k) {
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < along; ++i) {
        std::array<int, 3> order = {1, 2, 3};  // of the simplices of a box: which axis its path takes first
        do {
          const double parts = dimensions + 1;
          const double x = (i + order[0] / parts) / along, y = (j + order[1] / parts) / along;
          const double z = dimensions == 3 ? (k + order[2] / parts) / along : 0;
          if (x > y && y > z) {
            const std::array<double, 4> shares = {1 - x, x - y, y - z, z};
            weights.row(row++) = Eigen::Map<const Eigen::RowVectorXd>(shares.data(), weights.cols());
          }
        } while (std::next_permutation(order.begin(), order.begin() + dimensions));
      }
    }
  }
  return weights;
}

SampleWeights sample_weights(CellKind kind, int along) {
  const int dimensions = is_planar(kind) ? 2 : 3;
  const bool box = kind == CellKind::hexahedron || kind == CellKind::quadrilateral;
  return box ? samples_of_box(dimensions, along) : samples_of_simplex(dimensions, along);
}

/// What the samples of one tissue say.
struct Samples {
  int count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of their places

  Eigen::Vector3d middle() const { return sum / count; }
};

using SamplesByTissue = std::map<std::int32_t, Samples>;

/// Of points that are equally near the first, or rounding would choose.
std::size_t nearest_of(const Points& places, std::size_t first, std::size_t count, const Eigen::RowVector3d& place) {
  constexpr double nearer = 1 - 1e-9;
  std::size_t nearest = 0;
  double least = (places.row(static_cast<Eigen::Index>(first)) - place).squaredNorm();
  for (std::size_t i = 1; i < count; ++i) {
    const double squared = (places.row(static_cast<Eigen::Index>(first + i)) - place).squaredNorm();
    if (squared < nearer * least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

class CellSampler {
 public:
  CellSampler(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues)
      : cells_(cells), labels_(labels), tissues_(tissues) {
    for (int along = fewest_samples; along <= most_samples; along += 2) {
      weights_.push_back(sample_weights(cells.kind, along));
    }
  }

  /// What lies about each of the cell's points, which are `count` from `first` on; empty where the cell has one tissue.
  std::vector<SamplesByTissue> sample(std::size_t cell, const Points& places, std::size_t first,
                                      std::size_t count) const {
    const Corners corners = corners_of(cells_, cell);
    const SampleWeights& weights = weights_for(corners);
    const std::vector<std::int32_t> tissue = tissues_at(corners, weights);
    const auto known = std::ranges::find_if(tissue, [](std::int32_t t) { return t != 0; });
    if (std::ranges::all_of(tissue, [&](std::int32_t t) { return t == 0 || t == *known; })) {
      return {};
    }
    std::vector<SamplesByTissue> about(count);
    for (std::size_t i = 0; i < tissue.size(); ++i) {
      if (tissue[i] != 0) {
        const Eigen::RowVector3d place = weights.row(static_cast<Eigen::Index>(i)) * corners;
        Samples& samples = about[nearest_of(places, first, count, place)][tissue[i]];
        ++samples.count;
        samples.sum += place;
      }
    }
    return about;
  }

 private:
  const SampleWeights& weights_for(const Corners& corners) const {
    const double edge = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).maxCoeff();
    const double half = std::ceil(edge / (2 * labels_.geometry.spacing.minCoeff()));
    return weights_[static_cast<std::size_t>(std::clamp(half, fewest_samples / 2.0, most_samples / 2.0)) -
                    fewest_samples / 2];
  }

  /// The tissue of each sample; 0 where none is known.
  std::vector<std::int32_t> tissues_at(Corners corners, const SampleWeights& weights) const {
    for (auto corner : corners.rowwise()) {
      corner = labels_.geometry.to_index(corner.transpose()).transpose();
    }
    std::vector<std::int32_t> tissue(static_cast<std::size_t>(weights.rows()));
    for (std::size_t i = 0; i < tissue.size(); ++i) {
      const Eigen::RowVector3d index = weights.row(static_cast<Eigen::Index>(i)) * corners;
      const std::int32_t label = label_at_index(labels_, index.transpose());
      tissue[i] = std::ranges::find(tissues_, label) != tissues_.end() ? label : 0;
    }
    return tissue;
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

/// Takes out what is too little for a part. Returns all that is left together.
Samples drop_little(SamplesByTissue& about) {
  int before = 0;
  for (const auto& [tissue, samples] : about) {
    before += samples.count;
  }
  std::erase_if(about, [&](const auto& of_tissue) { return of_tissue.second.count < least_part * before; });
  Samples all;
  for (const auto& [tissue, samples] : about) {
    all.count += samples.count;
    all.sum += samples.sum;
  }
  return all;
}

}  // namespace

void part_by_tissue(const BackgroundCells& cells, const LabelMap& labels, const std::vector<std::int32_t>& tissues,
                    IntegrationPoints& points, std::vector<double>& full) {
  const CellSampler sampler(cells, labels, tissues);
  const std::vector<std::size_t> first = firsts_of_cells(points);
  const std::size_t count = first.size() - 1;
  std::vector<std::vector<SamplesByTissue>> about(count);  // a list a cell
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t c = 0; c < count; ++c) {
    const auto cell = static_cast<std::size_t>(points.cell[first[c]]);
    about[c] = sampler.sample(cell, points.positions, first[c], first[c + 1] - first[c]);
  }

  IntegrationPoints parted{
      .positions = {}, .volume = {}, .cell = {}, .label = {}, .labelled_by_cell = points.labelled_by_cell};
  std::vector<WeightedPoint> weighted;
  std::vector<double> parted_full;
  const auto add = [&](std::size_t i, double share, const Eigen::Vector3d& place, std::int32_t label) {
    weighted.push_back({place, share * points.volume[i]});
    parted.cell.push_back(points.cell[i]);
    parted.label.push_back(label);
    parted_full.push_back(share * full[i]);
  };
  for (std::size_t c = 0; c < count; ++c) {
    const auto cell = static_cast<std::size_t>(points.cell[first[c]]);
    const bool cut = !cells.cut_index.empty() && cells.cut_index[cell] >= 0;
    for (std::size_t i = first[c]; i < first[c + 1]; ++i) {
      const Eigen::Vector3d place = points.positions.row(static_cast<Eigen::Index>(i));
      if (about[c].empty() || about[c][i - first[c]].empty()) {
        add(i, 1, place, points.label[i]);
        continue;
      }
      SamplesByTissue& parts = about[c][i - first[c]];
      const Samples all = drop_little(parts);
      for (const auto& [tissue, samples] : parts) {
        const Eigen::Vector3d away = samples.middle() - all.middle();
        add(i, static_cast<double>(samples.count) / all.count, cut ? place : Eigen::Vector3d(place + away), tissue);
      }
    }
  }
  place_points(weighted, parted);
  points = std::move(parted);
  full = std::move(parted_full);
}

}  // namespace brainshift::solve
