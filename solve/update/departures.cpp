// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/departures.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace brainshift::solve {

namespace {

constexpr std::size_t most_lessons = 64;  // six ways to change a load have 21 squares
constexpr double of_square = 0.2;         // mm: of the departure under a change of 1 mm
constexpr double left_open = 0.002;       // mm: by relaxation
constexpr double farthest_change = 2;     // over the largest change so far: beyond it squares say too much

}  // namespace

Departures::Lesson Departures::lesson_of(const Responses& responses, const Points& change) {
  const auto nodes = static_cast<Eigen::Index>(responses.nodes.size());
  const Eigen::Map<const Eigen::MatrixXd> waves(responses.waves.data(), nodes,
                                                static_cast<Eigen::Index>(responses.count()));
  const Eigen::MatrixXd all = change(responses.nodes, Eigen::all) / std::sqrt(static_cast<double>(nodes));
  const Eigen::MatrixXd left = all - waves * (waves.transpose() * all);
  return {.change = all.reshaped(), .short_waves = left.reshaped(), .departure = {}};
}

double Departures::covariance(const Lesson& a, const Lesson& b) {
  const double square = of_square * a.change.dot(b.change);
  return square * square + a.short_waves.dot(b.short_waves);
}

void Departures::learn(const Responses& responses, const Points& change, const NodalVectors& first_order,
                       const NodalVectors& answer) {
  if (responses.count() == 0) {
    return;
  }
  Lesson lesson = lesson_of(responses, change);
  const auto size = static_cast<Eigen::Index>(answer.size());
  lesson.departure = (Eigen::Map<const Eigen::VectorXd>(answer.data(), size) -
                      Eigen::Map<const Eigen::VectorXd>(first_order.data(), size))
                         .cast<float>();
  lessons_.push_back(std::move(lesson));
  if (lessons_.size() > most_lessons) {
    lessons_.pop_front();
  }
}

void Departures::add_expected(const Responses& responses, const Points& change, NodalVectors& first_order) const {
  if (lessons_.empty()) {
    return;
  }
  Lesson asked = lesson_of(responses, change);
  double largest = 0;
  for (const Lesson& lesson : lessons_) {
    largest = std::max(largest, lesson.change.norm());
  }
  if (asked.change.norm() > farthest_change * largest) {
    asked.change *= farthest_change * largest / asked.change.norm();
  }
  const auto count = static_cast<Eigen::Index>(lessons_.size());
  Eigen::MatrixXd known(count, count);
  Eigen::VectorXd with_asked(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Lesson& lesson = lessons_[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j <= i; ++j) {
      known(i, j) = covariance(lesson, lessons_[static_cast<std::size_t>(j)]);
    }
    known(i, i) += left_open * left_open;
    with_asked[i] = covariance(lesson, asked);
  }
  const Eigen::VectorXf shares = known.llt().solve(with_asked).cast<float>();
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(first_order.size()));
  for (Eigen::Index i = 0; i < count; ++i) {
    sum += shares[i] * lessons_[static_cast<std::size_t>(i)].departure;
  }
  Eigen::Map<Eigen::VectorXd>(first_order.data(), sum.size()) += sum.cast<double>();
}

}  // namespace brainshift::solve
