// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/consistent_derivatives.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "solve/shape/shape_matrix.hpp"

namespace brainshift::solve {

namespace {

constexpr int most_iterations = 2000;
constexpr int most_iterations_of_part = 50;
constexpr double hopeless = 100;  // times the least residual so far

using Coefficients = Eigen::Matrix<double, 4, 3, Eigen::RowMajor>;

/// The inverse, or the pseudo-inverse where the nodes lie in a plane or nearly so. nodes: how many.
Eigen::Matrix3d inverse_moments(const Eigen::Matrix3d& moments, double nodes) {
  const double mean = moments.trace() / 3;
  if (moments.determinant() > 1e-3 * mean * mean * mean) {
    return moments.inverse();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments);
  const double least = 1e-12 * std::max(eigen.eigenvalues()[2], nodes);
  const Eigen::Vector3d inverse = eigen.eigenvalues().unaryExpr([&](double v) { return v > least ? 1 / v : 0.0; });
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

/// λ_a minus, at each point, its best linear fit over the support; weighted and summed over the points. Symmetric and
/// positive semi-definite: S of the header's system. Linear functions and first moments are about one origin for all
/// points, so that a pair takes no more than a sum of twelve numbers.
class FitResidual {
 public:
  /// points: those whose derivatives may be corrected.
  FitResidual(const Points& positions, std::span<const double> volume, const ShapeRows& rows,
              std::span<const std::int32_t> points)
      : away_(positions.rowwise() - positions.colwise().mean()),
        volume_(volume),
        rows_(rows),
        points_(points),
        centre_(rows.size()),
        inverse_(rows.size()),
        fitted_(rows.size()),
        moment_(static_cast<std::size_t>(positions.rows())),
        weight_(static_cast<std::size_t>(positions.rows()), 0.0) {
    const auto count = static_cast<std::int64_t>(points_.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < count; ++i) {
      prepare(static_cast<std::size_t>(points_[static_cast<std::size_t>(i)]));
    }
    list_points_of_nodes();
  }

  /// Whether a derivative of the node may be corrected.
  bool reaches(std::size_t node) const {
    return node_begin_[node] < node_begin_[node + 1];
  }

  /// The volume that sees each node: about S. Where no point sees a node, the mean.
  Eigen::VectorXd seeing_volume() const {
    Eigen::VectorXd weight =
        Eigen::Map<const Eigen::VectorXd>(weight_.data(), static_cast<Eigen::Index>(weight_.size()));
    const double mean = weight.mean();
    return weight.unaryExpr([mean](double w) { return w > 0 ? w : mean; });
  }

  /// S λ; afterwards the fits of λ are those that correction() takes.
  void apply(const Points& lambda, Points& result) {
    const auto count = static_cast<std::int64_t>(points_.size());
    const auto nodes = static_cast<std::int64_t>(lambda.rows());
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (std::int64_t a = 0; a < nodes; ++a) {
        moment_[static_cast<std::size_t>(a)] << lambda.row(a), away_.row(a).transpose() * lambda.row(a);
      }
#pragma omp for schedule(static)
      for (std::int64_t i = 0; i < count; ++i) {
        fit(static_cast<std::size_t>(points_[static_cast<std::size_t>(i)]));
      }
#pragma omp for schedule(static)
      for (std::int64_t a = 0; a < nodes; ++a) {
        const auto node = static_cast<std::size_t>(a);
        result.row(a) = weight_[node] * lambda.row(a) - at_node(a, sum_of_fits(node));
      }
    }
  }

  /// δB of a pair.
  Eigen::RowVector3d correction(std::size_t point, std::int32_t node, const Points& lambda) const {
    return lambda.row(node) - at_node(node, fitted_[point]);
  }

 private:
  Eigen::RowVector3d at_node(Eigen::Index node, const Coefficients& c) const {
    return c.row(0) + away_.row(node) * c.bottomRows<3>();
  }

  std::span<const std::int32_t> support(std::size_t point) const {
    return rows_[point].node;
  }

  /// Centre of the support and the inverse of its second moments: in the plane the z terms drop out.
  void prepare(std::size_t point) {
    const auto nodes = static_cast<double>(support(point).size());
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    for (const std::int32_t a : support(point)) {
      centre += away_.row(a) / nodes;
    }
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const std::int32_t a : support(point)) {
      const Eigen::RowVector3d x = away_.row(a) - centre;
      moments += x.transpose() * x;
    }
    centre_[point] = centre;
    inverse_[point] = inverse_moments(moments, nodes);
  }

  void fit(std::size_t point) {
    Coefficients sum = Coefficients::Zero();
    for (const std::int32_t a : support(point)) {
      sum += moment_[static_cast<std::size_t>(a)];
    }
    const Eigen::RowVector3d mean = sum.row(0) / static_cast<double>(support(point).size());
    const Eigen::Matrix3d slope = inverse_[point] * (sum.bottomRows<3>() - centre_[point].transpose() * sum.row(0));
    fitted_[point] << mean - centre_[point] * slope, slope;
  }

  /// Of the points that see the node, by volume.
  Coefficients sum_of_fits(std::size_t node) const {
    Coefficients sum = Coefficients::Zero();
    for (auto k = node_begin_[node]; k < node_begin_[node + 1]; ++k) {
      const auto point = static_cast<std::size_t>(node_point_[static_cast<std::size_t>(k)]);
      sum += volume_[point] * fitted_[point];
    }
    return sum;
  }

  void list_points_of_nodes() {
    node_begin_.assign(static_cast<std::size_t>(away_.rows()) + 1, 0);
    for (const std::int32_t point : points_) {
      for (const std::int32_t a : support(static_cast<std::size_t>(point))) {
        ++node_begin_[static_cast<std::size_t>(a) + 1];
      }
    }
    std::partial_sum(node_begin_.begin(), node_begin_.end(), node_begin_.begin());
    std::vector<std::int64_t> next(node_begin_.begin(), node_begin_.end() - 1);
    node_point_.resize(static_cast<std::size_t>(node_begin_.back()));
    for (const std::int32_t point : points_) {
      for (const std::int32_t a : support(static_cast<std::size_t>(point))) {
        node_point_[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = point;
        weight_[static_cast<std::size_t>(a)] += volume_[static_cast<std::size_t>(point)];
      }
    }
  }

  const Points away_;  ///< of the nodes from their mean
  std::span<const double> volume_;
  const ShapeRows& rows_;
  std::span<const std::int32_t> points_;
  std::vector<Eigen::RowVector3d> centre_;  ///< of each point's support, from the same mean
  std::vector<Eigen::Matrix3d> inverse_;
  std::vector<Coefficients> fitted_;  ///< at each point: value at the mean, and gradients
  std::vector<Coefficients> moment_;  ///< of each node: λ and X ⊗ λ
  std::vector<double> weight_;        ///< of each node: the volume that sees it
  std::vector<std::int64_t> node_begin_;
  std::vector<std::int32_t> node_point_;
};

/// Takes out of nodal vectors what forces at the surface nodes can balance: the part in the range of Q = Vᵀ, or of
/// Vᵀ N where the forces have the directions N alone. What is left is the least in Σ_a |r_a|² / D_a, D the volume that
/// sees the node, so that Qᵀ D⁻¹ r = 0: it is at once the preconditioner's projection.
class Unbalanced {
 public:
  Unbalanced(std::span<const std::int32_t> surface, const ShapeRows& nodal_rows, const Eigen::VectorXd& seeing_volume,
             const SurfaceNormals* normals = nullptr)
      : inverse_(seeing_volume.cwiseInverse()), shape_(shape_matrix(nodal_rows, surface, seeing_volume.size())) {
    const Eigen::SparseMatrix<double> products = shape_ * inverse_.asDiagonal() * shape_.transpose();
    if (normals == nullptr) {
      factor_.compute(products);
      return;
    }
    for (std::size_t node = 0; node < surface.size(); ++node) {
      first_.push_back(static_cast<int>(direction_.size()));
      for (int k = 0; k < normals->rank[node]; ++k) {
        direction_.push_back(normals->direction[node].col(k));
      }
    }
    first_.push_back(static_cast<int>(direction_.size()));
    factor_.compute(between_directions(products));
  }

  /// r, and D⁻¹ r.
  void apply(Points& vectors, Points& scaled) const {
    scaled = inverse_.asDiagonal() * vectors;
    const Points at_surface = shape_ * scaled;
    vectors -= shape_.transpose() * balancing(at_surface);
    scaled = inverse_.asDiagonal() * vectors;
  }

 private:
  /// The forces at the surface nodes.
  Points balancing(const Points& at_surface) const {
    if (direction_.empty()) {
      return factor_.solve(Eigen::MatrixXd(at_surface));
    }
    Eigen::VectorXd along(static_cast<Eigen::Index>(direction_.size()));
    for_each_direction(at_surface.rows(), [&](Eigen::Index node, std::size_t d) {
      along[static_cast<Eigen::Index>(d)] = at_surface.row(node).dot(direction_[d]);
    });
    const Eigen::VectorXd multiplier = factor_.solve(along);
    Points force = Points::Zero(at_surface.rows(), 3);
    for_each_direction(force.rows(), [&](Eigen::Index node, std::size_t d) {
      force.row(node) += multiplier[static_cast<Eigen::Index>(d)] * direction_[d].transpose();
    });
    return force;
  }

  template <class Do>
  void for_each_direction(Eigen::Index nodes, const Do& each) const {
    for (Eigen::Index node = 0; node < nodes; ++node) {
      const auto begin = static_cast<std::size_t>(first_[static_cast<std::size_t>(node)]);
      const auto end = static_cast<std::size_t>(first_[static_cast<std::size_t>(node) + 1]);
      for (std::size_t d = begin; d < end; ++d) {
        each(node, d);
      }
    }
  }

  /// Nᵀ (V D⁻¹ Vᵀ) N, one row a direction.
  Eigen::SparseMatrix<double> between_directions(const Eigen::SparseMatrix<double>& products) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < products.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(products, column); it; ++it) {
        const auto row = static_cast<std::size_t>(it.row()), other = static_cast<std::size_t>(column);
        for (int i = first_[row]; i < first_[row + 1]; ++i) {
          for (int j = first_[other]; j < first_[other + 1]; ++j) {
            const double cosine = direction_[static_cast<std::size_t>(i)].dot(direction_[static_cast<std::size_t>(j)]);
            entries.emplace_back(i, j, it.value() * cosine);
          }
        }
      }
    }
    const auto size = static_cast<Eigen::Index>(direction_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  Eigen::VectorXd inverse_;  ///< D⁻¹
  Eigen::SparseMatrix<double, Eigen::RowMajor> shape_;
  std::vector<Eigen::Vector3d> direction_;  ///< N; empty: all
  std::vector<int> first_;                  ///< of each node, and the end
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

Points integrated_derivatives(std::span<const double> volume, const ShapeRows& rows, Eigen::Index nodes) {
  Points sum = Points::Zero(nodes, 3);
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const ShapeRow row = rows[point];
    for (std::size_t k = 0; k < row.size(); ++k) {
      sum.row(row.node[k]) += volume[point] * row.gradient(k).transpose();
    }
  }
  return sum;
}

/// Mean over the nodes of Σ_I w |B_a|: what the defect is measured by.
double mean_magnitude(std::span<const double> volume, const ShapeRows& rows, Eigen::Index nodes) {
  std::vector<double> sum(rows.size(), 0.0);  // of each point, so that threads change nothing
#pragma omp parallel for schedule(static)
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const ShapeRow row = rows[point];
    for (std::size_t k = 0; k < row.size(); ++k) {
      sum[point] += volume[point] * row.gradient(k).norm();
    }
  }
  return std::accumulate(sum.begin(), sum.end(), 0.0) / static_cast<double>(nodes);
}

/// Conjugate gradients within the unbalanced vectors, preconditioned by the volumes that see the nodes (Gould, Hribar &
/// Nocedal 2001). Leaves the λ of the least residual: of a part of the points the system may have no solution.
int conjugate_gradients(FitResidual& system, const Unbalanced& unbalanced, Points residual, double goal, int most,
                        Points& best) {
  Points lambda = Points::Zero(residual.rows(), 3);
  Points scaled(residual.rows(), 3), image(residual.rows(), 3);
  unbalanced.apply(residual, scaled);
  Points direction = scaled;
  double squared = residual.cwiseProduct(scaled).sum();
  double least = residual.cwiseAbs().maxCoeff(), left = least;
  int iteration = 0;
  while (iteration < most && left > goal && left < hopeless * least) {
    system.apply(direction, image);
    const double curvature = direction.cwiseProduct(image).sum();
    if (curvature <= 0) {
      break;
    }
    const double step = squared / curvature;
    lambda += step * direction;
    residual -= step * image;
    unbalanced.apply(residual, scaled);
    const double next = residual.cwiseProduct(scaled).sum();
    direction = scaled + next / squared * direction;
    squared = next;
    left = residual.cwiseAbs().maxCoeff();
    if (left < least) {
      least = left;
      best = lambda;
    }
    ++iteration;
  }
  return iteration;
}

/// What surface forces do not balance of the integrated derivatives, at the nodes that a correction reaches.
Points unbalanced_defect(const FitResidual& system, const Unbalanced& unbalanced, std::span<const double> volume,
                         const ShapeRows& rows, Eigen::Index nodes) {
  Points defect = integrated_derivatives(volume, rows, nodes), scaled(nodes, 3);
  unbalanced.apply(defect, scaled);
  for (Eigen::Index a = 0; a < nodes; ++a) {
    if (!system.reaches(static_cast<std::size_t>(a))) {
      defect.row(a).setZero();
    }
  }
  return defect;
}

/// Surface nodes whose forces act on nodes that the correction reaches alone.
struct ReachedSurface {
  std::vector<std::int32_t> nodes;
  SurfaceNormals normals;  ///< of them, where those of the surface are known

  ReachedSurface(const FitResidual& system, std::span<const std::int32_t> surface, const ShapeRows& nodal_rows,
                 const SurfaceNormals* all) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const std::span<const std::int32_t> support = nodal_rows[static_cast<std::size_t>(surface[i])].node;
      if (std::all_of(support.begin(), support.end(),
                      [&](std::int32_t node) { return system.reaches(static_cast<std::size_t>(node)); })) {
        nodes.push_back(surface[i]);
        if (all != nullptr) {
          normals.rank.push_back(all->rank[i]);
          normals.direction.push_back(all->direction[i]);
        }
      }
    }
  }
};

}  // namespace

ConsistencyMeasures make_derivatives_consistent(const Points& positions, std::span<const std::int32_t> surface,
                                                const ShapeRows& nodal_rows, std::span<const double> volume,
                                                double tolerance, ShapeRows& rows, std::span<const std::int32_t> part,
                                                const SurfaceNormals* normals) {
  if (surface.empty()) {
    throw std::invalid_argument(
        "no node is on the surface: consistent derivatives need to know where forces may act; give the nodes the "
        "array on_surface");
  }
  std::vector<std::int32_t> points(part.begin(), part.end());
  if (part.empty()) {
    points.resize(rows.size());
    std::iota(points.begin(), points.end(), 0);
  }
  FitResidual system(positions, volume, rows, points);
  const Eigen::VectorXd seeing_volume = system.seeing_volume();
  const Unbalanced unbalanced(surface, nodal_rows, seeing_volume, normals);
  const double unit = mean_magnitude(volume, rows, positions.rows());
  const Points defect = unbalanced_defect(system, unbalanced, volume, rows, positions.rows());
  ConsistencyMeasures measures;
  measures.defect_before = defect.cwiseAbs().maxCoeff() / unit;

  Points lambda = Points::Zero(positions.rows(), 3);
  const ReachedSurface reached(system, surface, nodal_rows, normals);
  std::optional<Unbalanced> within;
  if (reached.nodes.size() < surface.size()) {
    within.emplace(reached.nodes, nodal_rows, seeing_volume, normals == nullptr ? nullptr : &reached.normals);
  }
  measures.iterations = conjugate_gradients(system, within ? *within : unbalanced, -defect, tolerance * unit,
                                            part.empty() ? most_iterations : most_iterations_of_part, lambda);
  Points image(positions.rows(), 3);
  system.apply(lambda, image);
  const auto count = static_cast<std::int64_t>(points.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto point = static_cast<std::size_t>(points[static_cast<std::size_t>(i)]);
    for (auto k = static_cast<std::size_t>(rows.begin[point]); k < static_cast<std::size_t>(rows.begin[point + 1]);
         ++k) {
      Eigen::Map<Eigen::RowVector3d>(&rows.derivative[3 * k]) += system.correction(point, rows.node[k], lambda);
    }
  }
  const Points after = unbalanced_defect(system, unbalanced, volume, rows, positions.rows());
  measures.defect_after = after.cwiseAbs().maxCoeff() / unit;
  return measures;
}

}  // namespace brainshift::solve
