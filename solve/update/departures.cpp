// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/update/departures.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve {

namespace {

constexpr std::size_t most_lessons = 64;
constexpr double of_square = 0.2;      // mm: of the departure under a change of 1 mm
constexpr double of_bound = 0.2;       // over an answer's bound of the error: its error
constexpr double farthest_change = 2;  // over the largest so far: of farther ones a small one says too much
constexpr double same_change = 0.005;  // mm, root mean square

}  // namespace

Departures::Lesson Departures::lesson_of(const Responses& responses, const Points& change) {
  const auto nodes = static_cast<Eigen::Index>(responses.nodes.size());
  const Eigen::Map<const Eigen::MatrixXd> waves(responses.waves.data(), nodes,
                                                static_cast<Eigen::Index>(responses.count()));
  const Eigen::MatrixXd all = change(responses.nodes, Eigen::all) / std::sqrt(static_cast<double>(nodes));
  const Eigen::MatrixXd left = all - waves * (waves.transpose() * all);
  return {.change = all.reshaped(), .short_waves = left.reshaped(), .departure = {}, .left_open = 0};
}

double Departures::covariance(const Lesson& a, const Lesson& b) {
  const double square = of_square * a.change.dot(b.change);
  return square * square + a.short_waves.dot(b.short_waves);
}

void Departures::learn(const Responses& responses, const Points& change, const NodalVectors& first_order,
                       const NodalVectors& answer, double error_bound) {
  Lesson lesson = lesson_of(responses, change);
  if (lesson.change.norm() <= same_change) {
    return;
  }
  const auto nodes = static_cast<Eigen::Index>(answer.size() / 4);
  const Eigen::Map<const Eigen::Matrix4Xd> now(answer.data(), 4, nodes), said(first_order.data(), 4, nodes);
  lesson.departure = (now - said).topRows<3>().cast<float>();
  lesson.left_open = of_bound * error_bound;
  std::erase_if(lessons_, [&](const Lesson& other) { return (other.change - lesson.change).norm() <= same_change; });
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
  shorten(asked.change, &Lesson::change);
  shorten(asked.short_waves, &Lesson::short_waves);
  const auto count = static_cast<Eigen::Index>(lessons_.size());
  Eigen::MatrixXd known(count, count);
  Eigen::VectorXd with_asked(count);
  share_work(count, 1, [&](Eigen::Index i) {
    const Lesson& lesson = lessons_[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j <= i; ++j) {
      known(i, j) = covariance(lesson, lessons_[static_cast<std::size_t>(j)]);
    }
    known(i, i) += lesson.left_open * lesson.left_open;
    with_asked[i] = covariance(lesson, asked);
  });
  const Eigen::LLT<Eigen::MatrixXd> factor(known);
  if (factor.info() != Eigen::Success) {
    return;  // lessons that tell the same
  }
  const Eigen::VectorXf shares = factor.solve(with_asked).cast<float>();
  const auto nodes = static_cast<Eigen::Index>(first_order.size() / 4);
  Eigen::Map<Eigen::Matrix4Xd> start(first_order.data(), 4, nodes);
  share_work((nodes + nodes_a_part - 1) / nodes_a_part, 1, [&](std::int64_t part) {
    const Eigen::Index first = part * nodes_a_part, size = std::min(nodes_a_part, nodes - first);
    for (Eigen::Index i = 0; i < count; ++i) {
      start.middleCols(first, size).topRows<3>() +=
          (shares[i] * lessons_[static_cast<std::size_t>(i)].departure.middleCols(first, size)).cast<double>();
    }
  });
}

void Departures::shorten(Eigen::VectorXd& asked, Eigen::VectorXd Lesson::*part) const {
  double largest = 0;
  for (const Lesson& lesson : lessons_) {
    largest = std::max(largest, (lesson.*part).norm());
  }
  if (asked.norm() > farthest_change * largest) {
    asked *= farthest_change * largest / asked.norm();
  }
}

}  // namespace brainshift::solve
