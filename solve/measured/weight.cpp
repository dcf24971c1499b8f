// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/measured/weight.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/geometry/quantile.hpp"
#include "solve/measured/gaussian.hpp"

namespace brainshift::solve {

namespace {

constexpr Eigen::Index points_that_choose = 60;
constexpr int candidates = 41;                             // of the weight
constexpr int amplitudes = 16;                             // of a smooth motion
constexpr std::array lengths = {0.3, 0.45, 0.7, 1., 1.5};  // of it, over the points' distance from their middle
constexpr double least_gain = 3;                           // in the likelihood, of its three numbers
constexpr double far_larger = 5;    // than what was given: noise that looks like motion over a short length
constexpr double unseen_shift = 5;  // mm, an axis: of an opened cortex, before anything is measured

/// low … high, geometric.
std::vector<double> steps_between(double low, double high, int count) {
  std::vector<double> steps;
  for (int i = 0; i < count; ++i) {
    steps.push_back(low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  }
  return steps;
}

/// Root mean square of the distance from their middle.
double extent_of(const Points& sites) {
  const Points away = sites.rowwise() - sites.colwise().mean();
  return std::sqrt(away.squaredNorm() / static_cast<double>(away.rows()));
}

/// The lower quartile: neither those that are large and tell nothing, as of components that nobody measured, nor a few
/// that are small may speak for the others.
double usual_sigma(const Points& sigma) {
  return quantile(std::vector(sigma.data(), sigma.data() + sigma.size()), 0.25);
}

/// Whether a motion of the opening cannot be told from the patient's registration, which is found beside it.
bool hides_motion(const Response& response) {
  return response.rigid.cols() > 0 && !response.free && response.sites.rows() > 0;
}

/// What the first of the measured points say of the prior.
class Likelihood {
 public:
  Likelihood(const Response& response, const Points& displacement, const Points& sigma)
      : response_(response),
        size_(3 * std::min(displacement.rows(), points_that_choose)),
        displacement_(displacement.topRows(size_ / 3)),
        d_(stacked_rows(displacement_)),
        variance_(stacked_rows(sigma.topRows(size_ / 3)).cwiseAbs2()),
        rigid_(response.rigid.topRows(size_)),
        noise_(usual_sigma(sigma)) {
    const double answer = answers().diagonal().mean();
    const double least = 0.1 * noise_, most = std::max(10 * displacement.cwiseAbs().maxCoeff(), 2 * least);
    weights_ = steps_between(least * least / answer / millijoule, most * most / answer / millijoule, candidates);
    amplitudes_ = steps_between(least, most, amplitudes);
    amplitudes_.insert(amplitudes_.begin(), 0);
  }

  /// The likeliest prior of a weight and, where there are sites, a smooth motion. `rough`: over so short a length, and
  /// so large, that it may be noise.
  MeasuredFit best() const {
    MeasuredFit plain;
    double likeliest = -std::numeric_limits<double>::infinity();
    int chosen = 0;
    for (int i = 0; i < candidates; ++i) {
      const double likely = gaussian({weights_[static_cast<std::size_t>(i)], 0, 0}, {}).log_likelihood;
      chosen = likely > likeliest ? i : chosen;
      likeliest = std::max(likeliest, likely);
    }
    plain.weight = weights_[static_cast<std::size_t>(chosen)];
    return response_.sites.rows() > 0 && !hides_motion(response_) ? with_motion(plain, likeliest, chosen) : plain;
  }

  /// log likelihood of a fit's prior.
  double of(const MeasuredFit& fit) const {
    return gaussian({fit.weight, fit.smooth.along, fit.smooth.across}, shapes_of(fit.smooth)).log_likelihood;
  }

  /// Each weight, that of the fit among them, beside its smooth motion.
  std::vector<WeightRow> rows(const MeasuredFit& fit) const {
    const SmoothMotion& smooth = fit.smooth;
    std::vector<double> weights = weights_;
    weights.push_back(fit.weight);
    std::sort(weights.begin(), weights.end());
    weights.erase(std::unique(weights.begin(), weights.end()), weights.end());
    std::vector<WeightRow> rows;
    const Shapes shapes = shapes_of(smooth);
    for (const double weight : weights) {
      const MeasuredGaussian g = gaussian({weight, smooth.along, smooth.across}, shapes);
      const double s = millijoule * weight;
      rows.push_back({.weight = weight,
                      .misfit = g.push.cwiseAbs2().dot(variance_),
                      .energy = s * s * g.push.dot(answers() * g.push) / 2 / millijoule,
                      .log_likelihood = g.log_likelihood});
    }
    return rows;
  }

 private:
  /// Of a smooth motion of 1 mm along its direction and across: covariances at the points.
  struct Shapes {
    Eigen::MatrixXd along, across;
  };
  struct Sizes {
    double weight, along, across;
  };
  using Place = std::array<int, 3>;  // among weights_, amplitudes_, amplitudes_

  Eigen::Block<const Eigen::MatrixXd> answers() const { return response_.compliance.topLeftCorner(size_, size_); }

  Shapes shapes_of(const SmoothMotion& smooth) const {
    if (smooth.length == 0) {
      return {};
    }
    const Eigen::Matrix3d along = smooth.direction * smooth.direction.transpose();
    const auto carry = response_.carry.topRows(size_);
    const auto carried = [&](const Eigen::Matrix3d& sizes) -> Eigen::MatrixXd {
      return carry * smooth_covariance(response_, smooth, sizes) * carry.transpose();
    };
    return {carried(along), carried(Eigen::Matrix3d::Identity() - along)};
  }

  MeasuredGaussian gaussian(const Sizes& sizes, const Shapes& shapes) const {
    Eigen::MatrixXd prior = millijoule * sizes.weight * answers();
    if (shapes.along.size() > 0) {
      prior += sizes.along * sizes.along * shapes.along + sizes.across * sizes.across * shapes.across;
    }
    return {std::move(prior), rigid_, d_, variance_};
  }

  Sizes at(const Place& place) const {
    return {weights_[static_cast<std::size_t>(place[0])], amplitudes_[static_cast<std::size_t>(place[1])],
            amplitudes_[static_cast<std::size_t>(place[2])]};
  }

  /// A smooth motion, its sizes and the weight beside it, and how likely these are.
  struct Moved {
    SmoothMotion smooth;
    Place place{};
    double likely = -std::numeric_limits<double>::infinity();
  };

  /// plain: without a motion, `chosen` its weight.
  MeasuredFit with_motion(MeasuredFit fit, double plain, int chosen) const {
    const Eigen::JacobiSVD<Eigen::MatrixXd> main(displacement_, Eigen::ComputeFullV);
    SmoothMotion smooth{.direction = main.matrixV().col(0)};
    const double extent = extent_of(response_.sites);
    double first = 0;  // length that is tried
    Moved moved;
    for (const double share : lengths) {
      smooth.length = share * extent;
      if (smooth.length > 0 && smooth.length >= response_.shortest) {
        first = first > 0 ? first : smooth.length;
        smooth.fades = false;
        take_if_likelier(smooth, chosen, moved);
        smooth.fades = true;
        take_if_likelier(smooth, chosen, moved);
      }
    }
    if (!std::isfinite(moved.likely)) {  // none could be tried
      return fit;
    }
    const Sizes sizes = mean_sizes(shapes_of(moved.smooth), moved.place);
    moved.smooth.along = sizes.along;
    moved.smooth.across = sizes.across;
    if (moved.likely <= plain + least_gain) {
      fit.refused = moved.smooth;
      return fit;
    }
    fit.weight = sizes.weight;
    fit.smooth = moved.smooth;
    fit.rough = fit.smooth.length == first && std::max(sizes.along, sizes.across) > far_larger * noise_;
    return fit;
  }

  /// Of its sizes, and of the weight, whatever is likeliest. chosen: the weight without it.
  void take_if_likelier(const SmoothMotion& smooth, int chosen, Moved& likeliest) const {
    if (smooth.fades && response_.fading.size() == 0) {
      return;
    }
    const Shapes shapes = shapes_of(smooth);
    for (Place place : {Place{chosen, 1, 0}, Place{0, 2 * amplitudes / 3, 0}}) {
      if (const double likely = climb(shapes, place); likely > likeliest.likely) {
        likeliest = {smooth, place, likely};
      }
    }
  }

  /// The means of the variances, each over its values beside the likeliest of the others: the likeliest of a small one
  /// is 0, which would say that it is known.
  Sizes mean_sizes(const Shapes& shapes, const Place& likeliest) const {
    const auto mean = [&](std::size_t axis, auto&& variance) {
      double most = -std::numeric_limits<double>::infinity(), sum = 0, total = 0;
      std::vector<std::pair<double, double>> found;
      for (Place place = likeliest; is_inside(place[axis] = static_cast<int>(found.size()), axis);) {
        const Sizes sizes = at(place);
        found.emplace_back(variance(sizes), gaussian(sizes, shapes).log_likelihood);
        most = std::max(most, found.back().second);
      }
      for (const auto& [value, likely] : found) {
        sum += value * std::exp(likely - most);
        total += std::exp(likely - most);
      }
      return sum / total;
    };
    return {mean(0, [](const Sizes& s) { return s.weight; }),
            std::sqrt(mean(1, [](const Sizes& s) { return s.along * s.along; })),
            std::sqrt(mean(2, [](const Sizes& s) { return s.across * s.across; }))};
  }

  /// Goes to where no neighbour along an axis is likelier.
  double climb(const Shapes& shapes, Place& place) const {
    double likeliest = gaussian(at(place), shapes).log_likelihood;
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          for (;;) {
            Place next = place;
            next[axis] += step;
            if (!is_inside(next[axis], axis)) {
              break;
            }
            const double likely = gaussian(at(next), shapes).log_likelihood;
            if (!(likely > likeliest)) {
              break;
            }
            place = next;
            likeliest = likely;
            moved = true;
          }
        }
      }
    }
    return likeliest;
  }

  bool is_inside(int index, std::size_t axis) const {
    return index >= 0 && index < static_cast<int>(axis == 0 ? weights_.size() : amplitudes_.size());
  }

  const Response& response_;
  Eigen::Index size_;  // components of the points that choose
  Points displacement_;
  Eigen::VectorXd d_, variance_;
  Eigen::MatrixXd rigid_;
  double noise_;                              // mm
  std::vector<double> weights_, amplitudes_;  // mJ, mm
};

/// By how much what was measured departs from prior and noise. Of components whose σ is far from the usual one nothing
/// is said: they agree with whatever there is.
double noise_factor(const Eigen::MatrixXd& prior, const Eigen::MatrixXd& rigid, const Eigen::VectorXd& d,
                    const Eigen::VectorXd& variance, double usual) {
  constexpr double far_off = 3;
  std::vector<Eigen::Index> telling;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    if (variance[i] <= far_off * far_off * usual * usual) {
      telling.push_back(i);
    }
  }
  const Eigen::MatrixXd told = independent(rigid(telling, Eigen::all));  // heights alone tell no motion sideways
  const MeasuredGaussian of_these(prior(telling, telling), told, d(telling), variance(telling));
  const double freedom = static_cast<double>(telling.size()) - static_cast<double>(told.cols());
  constexpr double given = 3;  // what was given of the noise counts as much as one measured point
  return freedom > 0 ? std::sqrt((given + of_these.squares) / (given + freedom)) : 1;
}

}  // namespace

MeasuredFit choose_weight(const Response& response, const Points& displacement, const Points& sigma, double weight) {
  const Eigen::VectorXd d = stacked_rows(displacement), variance = stacked_rows(sigma).cwiseAbs2();
  const Eigen::Index m = d.size();
  const double freedom = static_cast<double>(m - response.rigid.cols());
  if (freedom <= 0) {
    throw std::invalid_argument("load: " + std::to_string(displacement.rows()) +
                                " measured points do not tell a motion of the whole from noise; measure three or more");
  }
  if (independent(response.rigid.topRows(m)).cols() < response.rigid.cols()) {
    throw std::invalid_argument(
        "load: the measured points lie on one line, about which they do not tell how all turns; measure points beside "
        "it");
  }
  MeasuredFit fit;
  fit.weight = weight;
  if (weight == 0) {
    const Likelihood likelihood(response, displacement, sigma);
    fit = likelihood.best();
    if (fit.rough) {
      const Likelihood larger(response, displacement, far_larger * sigma);
      fit.rough = larger.of(larger.best()) > likelihood.of(fit);
    }
    fit.weights = likelihood.rows(fit);
  }
  const Eigen::MatrixXd prior = Prior(response, fit.weight, fit.smooth).between(0, m, 0, m);
  const MeasuredGaussian chosen(prior, response.rigid.topRows(m), d, variance);
  fit.noise_factor = noise_factor(prior, response.rigid.topRows(m), d, variance, usual_sigma(sigma));
  fit.motion = chosen.motion;
  fit.motion_deviation = fit.noise_factor * chosen.motion_deviation();
  if (hides_motion(response)) {
    fit.hidden = {lengths.back() * extent_of(response.sites), unseen_shift, unseen_shift, Eigen::Vector3d::UnitX()};
    const double larger = fit.noise_factor * fit.noise_factor;  // but for the hidden motion, which is not measured
    const Prior doubt(response, larger * fit.weight, fit.hidden);
    // Without it the rigid motion would take what the brain itself moves alike.
    const MeasuredGaussian beside(doubt.between(0, m, 0, m), response.rigid.topRows(m), d, larger * variance);
    fit.motion = beside.motion;
    fit.motion_deviation = beside.motion_deviation();
  }
  if (fit.smooth.length > 0) {
    const Eigen::VectorXd smoothed = d - variance.cwiseProduct(chosen.push);
    fit.smoothed = Eigen::Map<const Points>(smoothed.data(), displacement.rows(), 3);
  }
  return fit;
}

namespace {

/// What of the opening's motion is believed where errors are told.
const SmoothMotion& doubted(const Response& response, const MeasuredFit& fit) {
  if (hides_motion(response)) {
    return fit.hidden;
  }
  return fit.smooth.length > 0 ? fit.smooth : fit.refused;
}

}  // namespace

Posterior::Posterior(const Response& response, const Points& displacement, const Points& sigma, const MeasuredFit& fit)
    : Posterior(response, stacked_rows(displacement), stacked_rows(sigma).cwiseAbs2(), fit,
                fit.noise_factor * fit.noise_factor) {}

// What is hidden was not measured, so that it does not grow with the noise as all other variances do.
Posterior::Posterior(const Response& response, const Eigen::VectorXd& d, const Eigen::VectorXd& variance,
                     const MeasuredFit& fit, double larger)
    : response_(response),
      measured_(d.size()),
      factor_(hides_motion(response) ? 1 : larger),
      likely_(response, fit.weight, fit.smooth),
      careful_(response, larger / factor_ * fit.weight, doubted(response, fit), Alike::matern),
      answer_(likely_.between(0, measured_, 0, measured_),
              response.rigid.topRows(measured_).leftCols(hides_motion(response) ? 0 : response.rigid.cols()), d,
              variance),
      doubt_(careful_.between(0, measured_, 0, measured_), response.rigid.topRows(measured_), d,
             larger / factor_ * variance) {}

Eigen::MatrixXd Posterior::rigid_of(Eigen::Index first, Eigen::Index places) const {
  Eigen::MatrixXd rigid = response_.rigid.middleRows(measured_ + 3 * first, 3 * places);
  if (!response_.free) {
    rigid.setZero();
  }
  return rigid;
}

Points Posterior::mean() const {
  const Eigen::Index rest = response_.compliance.rows() - measured_;
  Eigen::VectorXd mean = likely_.between(measured_, rest, 0, measured_) * answer_.push;
  if (answer_.motion.size() > 0) {
    mean += rigid_of(0, rest / 3) * answer_.motion;
  }
  return Eigen::Map<const Points>(mean.data(), rest / 3, 3);
}

Eigen::MatrixXd Posterior::covariance(Eigen::Index first, Eigen::Index places) const {
  const Eigen::Index from = measured_ + 3 * first, size = 3 * places;
  return factor_ * doubt_.covariance(careful_.between(from, size, from, size),
                                     careful_.between(from, size, 0, measured_), rigid_of(first, places));
}

SixEntries six_entries(const Eigen::Matrix3d& c) {
  return {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(2, 0)};
}

SixEntries as_said(const SixEntries& c, const Eigen::RowVector3d& linear, const Eigen::RowVector3d& answered) {
  const double doubt = std::sqrt(c.head<3>().sum());
  const double times = doubt > 0 ? std::min(1.0, (answered.norm() + doubt) / (linear.norm() + doubt)) : 1;
  const Eigen::Matrix3d matrix{{c[0], c[3], c[5]}, {c[3], c[1], c[4]}, {c[5], c[4], c[2]}};
  const double longest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[2];
  SixEntries said = c / 2;
  said.head<3>().array() += longest / 2;
  return times * times * said;
}

}  // namespace brainshift::solve
