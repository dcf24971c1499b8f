// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/shape_functions.hpp"

#include <algorithm>
#include <atomic>
#include <sstream>
#include <stdexcept>

#include "discretise/plane.hpp"
#include "solve/shape/moving_least_squares.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

namespace {

constexpr double growth = 1.1;        // of a support that is not admissible, each try
constexpr double largest_growth = 8;  // beyond it the cloud is degenerate
constexpr double patience = 1.5;      // up to this growth MMLS looks for a support that needs no penalty
constexpr int opacity = 4;            // λ of the diffraction method
constexpr Eigen::Index batch = 256;   // points handled by one thread at a time

std::vector<double> support_radius(std::span<const double> spacing, double dilatation) {
  std::vector<double> radius(spacing.begin(), spacing.end());
  for (double& r : radius) {
    r *= dilatation;
  }
  return radius;
}

}  // namespace

double dilatation(const ShapeOptions& options) {
  if (options.dilatation > 0) {
    return options.dilatation;
  }
  if (options.planar) {
    return options.basis == Basis::linear ? 1.8 : 2.4;
  }
  return options.basis == Basis::linear ? 1.6 : 2.2;
}

struct ShapeFunctions::Impl {
  Points positions;
  ShapeOptions options;
  SupportSearch search;
  std::shared_ptr<const Visibility> visibility;

  Impl(const Points& p, std::span<const double> spacing, const ShapeOptions& o, std::shared_ptr<const Visibility> v)
      : positions(p),
        options(o),
        search(positions, support_radius(spacing, solve::dilatation(o))),
        visibility(std::move(v)) {}
};

namespace {

/// Evaluates the shape functions at one point after another; owned by one thread.
template <int dimensions, int order>
class Evaluator {
 public:
  explicit Evaluator(const ShapeFunctions::Impl& impl)
      : impl_(impl), penalty_(impl.options.basis == Basis::modified_quadratic ? impl.options.penalty : 0) {}

  /// Finds an admissible support of x, growing it where needed; false where there is none.
  bool move_to(const Eigen::Vector3d& x) {
    for (scale_ = 1; scale_ < largest_growth; scale_ *= growth) {
      impl_.search.find(x, scale_, support_);
      look_past_cut(x);
      const bool leave_to_penalty = penalty_ > 0 && scale_ > patience;
      if (mls_.build(x, support_, impl_.positions, impl_.search.radius(), scale_, penalty_, leave_to_penalty,
                     detour_)) {
        phi_.resize(support_.size());
        mls_.values(phi_);
        return true;
      }
    }
    return false;
  }

  bool grown() const { return scale_ > 1; }
  std::span<const Supporter> support() const { return support_; }
  std::span<const double> values() const { return phi_; }
  std::span<const double> gradients() {
    gradient_.resize(3 * support_.size());
    mls_.gradients(impl_.options.derivatives, gradient_);
    return gradient_;
  }

 private:
  /// Takes the nodes that the cut hides out of the support, and counts those behind its front as farther.
  void look_past_cut(const Eigen::Vector3d& x) {
    detour_.clear();
    const auto farther = [](const Supporter& a, const Supporter& b) { return a.distance < b.distance; };
    if (!impl_.visibility || support_.empty() ||
        !impl_.visibility->near(x, std::max_element(support_.begin(), support_.end(), farther)->distance)) {
      return;
    }
    std::size_t seen = 0;
    for (Supporter s : support_) {
      const Eigen::Vector3d node = impl_.positions.row(s.node), away = node - x;
      Eigen::Vector3d gradient = s.distance > 0 ? Eigen::Vector3d(-away / s.distance) : Eigen::Vector3d::Zero();
      const double radius = scale_ * impl_.search.radius()[static_cast<std::size_t>(s.node)];
      if (const std::optional<Detour> detour = impl_.visibility->detour(x, node)) {
        const double ratio = detour->length / s.distance;
        gradient = opacity * std::pow(ratio, opacity - 1) * detour->gradient -
                   (opacity - 1) * std::pow(ratio, opacity) * gradient;
        s.distance *= std::pow(ratio, opacity);
      }
      if (s.distance < radius) {
        support_[seen++] = s;
        detour_.push_back(gradient);
      }
    }
    support_.resize(seen);
  }

  const ShapeFunctions::Impl& impl_;
  double penalty_;
  double scale_ = 1;
  std::vector<Supporter> support_;
  std::vector<Eigen::Vector3d> detour_;  ///< ∂distance/∂x of each supporter where a cut is near, else empty
  std::vector<double> phi_, gradient_;
  MovingLeastSquares<dimensions, order> mls_;
};

/// The rows of a batch of points, before they are joined.
struct Batch {
  std::vector<std::int32_t> length, node;
  std::vector<double> value, derivative;
  std::size_t grown = 0;
};

constexpr Eigen::Index none = -1;

[[noreturn]] void throw_inadmissible(const Points& points, Eigen::Index i, bool planar, bool cut) {
  std::ostringstream text;
  text << "no admissible support at the point (" << points(i, 0) << ", " << points(i, 1) << ", " << points(i, 2)
       << ") mm: too few nodes near it, or all of them " << (planar ? "on one line" : "in one plane")
       << (cut ? "; a cut hides the others: move it, or give more nodes there" : "; add nodes or check their spacing");
  throw std::invalid_argument(text.str());
}

/// Calls use(evaluator, point) for every point; batches go to whichever thread is free.
template <int dimensions, int order, class Use>
void for_each_point(const ShapeFunctions::Impl& impl, const Points& points, const Use& use) {
  const Eigen::Index batches = (points.rows() + batch - 1) / batch;
  std::atomic<Eigen::Index> bad = none;
#pragma omp parallel
  {
    Evaluator<dimensions, order> evaluator(impl);
#pragma omp for schedule(dynamic)
    for (Eigen::Index b = 0; b < batches; ++b) {
      const Eigen::Index end = std::min((b + 1) * batch, points.rows());
      for (Eigen::Index i = b * batch; i < end && bad == none; ++i) {
        if (evaluator.move_to(points.row(i))) {
          use(evaluator, i);
        } else {
          bad = i;
        }
      }
    }
  }
  if (bad != none) {
    throw_inadmissible(points, bad, impl.options.planar, impl.visibility != nullptr);
  }
}

ShapeRows join(const std::vector<Batch>& batches, std::size_t points) {
  ShapeRows rows;
  rows.begin.reserve(points + 1);
  rows.begin.push_back(0);
  for (const Batch& b : batches) {
    for (const std::int32_t n : b.length) {
      rows.begin.push_back(rows.begin.back() + n);
    }
    rows.node.insert(rows.node.end(), b.node.begin(), b.node.end());
    rows.value.insert(rows.value.end(), b.value.begin(), b.value.end());
    rows.derivative.insert(rows.derivative.end(), b.derivative.begin(), b.derivative.end());
    rows.grown += b.grown;
  }
  return rows;
}

template <int dimensions, int order>
ShapeRows evaluate_rows(const ShapeFunctions::Impl& impl, const Points& points, bool with_derivatives) {
  std::vector<Batch> batches(static_cast<std::size_t>((points.rows() + batch - 1) / batch));
  for_each_point<dimensions, order>(impl, points, [&](Evaluator<dimensions, order>& at, Eigen::Index i) {
    Batch& b = batches[static_cast<std::size_t>(i / batch)];
    b.length.push_back(static_cast<std::int32_t>(at.support().size()));
    b.grown += at.grown() ? 1 : 0;
    for (const Supporter& s : at.support()) {
      b.node.push_back(s.node);
    }
    b.value.insert(b.value.end(), at.values().begin(), at.values().end());
    if (with_derivatives) {
      const auto gradients = at.gradients();
      b.derivative.insert(b.derivative.end(), gradients.begin(), gradients.end());
    }
  });
  return join(batches, static_cast<std::size_t>(points.rows()));
}

template <int dimensions, int order>
Points interpolate_at(const ShapeFunctions::Impl& impl, const Points& points, const Points& values) {
  Points result(points.rows(), 3);
  for_each_point<dimensions, order>(impl, points, [&](Evaluator<dimensions, order>& at, Eigen::Index i) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t a = 0; a < at.support().size(); ++a) {
      sum += at.values()[a] * values.row(at.support()[a].node);
    }
    result.row(i) = sum;
  });
  return result;
}

void check_plane(const Points& points, const ShapeOptions& options, const char* what) {
  if (!options.planar) {
    return;
  }
  if (const auto fault = off_plane(points, what)) {
    throw std::invalid_argument(*fault);
  }
}

/// Calls use<dimensions, order>() as the options say.
template <class Use>
auto with_basis(const ShapeOptions& options, const Use& use) {
  const bool linear = options.basis == Basis::linear;
  if (options.planar) {
    return linear ? use.template operator()<2, 1>() : use.template operator()<2, 2>();
  }
  return linear ? use.template operator()<3, 1>() : use.template operator()<3, 2>();
}

}  // namespace

ShapeFunctions::ShapeFunctions(const Points& positions, std::span<const double> spacing, const ShapeOptions& options,
                               std::shared_ptr<const Visibility> visibility) {
  const Eigen::Index least = monomial_count(options.planar ? 2 : 3, options.basis == Basis::quadratic ? 2 : 1);
  if (positions.rows() < least) {
    throw std::invalid_argument("the cloud has " + std::to_string(positions.rows()) + " nodes, but this basis needs " +
                                std::to_string(least) + " in a support; add nodes");
  }
  check_plane(positions, options, "node");
  impl_ = std::make_shared<const Impl>(positions, spacing, options, std::move(visibility));
}

std::size_t ShapeFunctions::nodes() const {
  return static_cast<std::size_t>(impl_->positions.rows());
}

ShapeRows ShapeFunctions::evaluate(const Points& points, bool with_derivatives) const {
  check_plane(points, impl_->options, "point");
  return with_basis(impl_->options, [&]<int dimensions, int order>() {
    return evaluate_rows<dimensions, order>(*impl_, points, with_derivatives);
  });
}

Points ShapeFunctions::interpolate(const Points& points, const Points& values) const {
  check_plane(points, impl_->options, "point");
  return with_basis(impl_->options, [&]<int dimensions, int order>() {
    return interpolate_at<dimensions, order>(*impl_, points, values);
  });
}

}  // namespace brainshift::solve
