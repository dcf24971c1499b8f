// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/tradeoff/front.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace brainshift::pipelines {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(points[a].seconds, points[a].error) < std::tie(points[b].seconds, points[b].error);
  });
  double least = std::numeric_limits<double>::infinity();
  std::erase_if(order, [&](std::size_t i) {
    const bool nearer = points[i].error < 0.99 * least;
    least = nearer ? points[i].error : least;
    return !nearer;
  });
  return order;
}

}  // namespace brainshift::pipelines
