// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/slices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "solve/arrays/shared_work.hpp"

namespace brainshift::solve::device {

namespace {

template <class Scalar>
class SliceMaker {
 public:
  SliceMaker(const Clusters<Scalar>& from, const Cluster& cluster, Slices<Scalar>& to)
      : from_(from), cluster_(cluster), to_(to) {
    to_.cluster_begin.clear();
    std::vector<std::int32_t> longest_first(static_cast<std::size_t>(cluster.points));
    std::iota(longest_first.begin(), longest_first.end(), 0);
    std::stable_sort(longest_first.begin(), longest_first.end(),
                     [&](std::int32_t p, std::int32_t q) { return support(p) > support(q); });
    for (std::size_t first = 0; first < longest_first.size(); first += slice_points) {
      const std::size_t last = std::min(first + slice_points, longest_first.size());
      add_slice({longest_first.data() + first, last - first});
    }
    to_.reach = {largest_reach()};
  }

 private:
  std::size_t begin(std::int32_t p) const {
    return static_cast<std::size_t>(from_.pair_begin[static_cast<std::size_t>(cluster_.first_point + p)]);
  }
  std::size_t support(std::int32_t p) const { return begin(p + 1) - begin(p); }

  void add_slice(std::span<const std::int32_t> points) {
    const std::size_t turns = (support(points.front()) + slice_lanes - 1) / slice_lanes, before = to_.pairs.size();
    to_.pairs.resize(before + turns * slice_points * slice_lanes, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < support(points[i]); ++k) {
        const std::size_t place = (k / slice_lanes * slice_points + i) * slice_lanes + k % slice_lanes;
        to_.pairs[before + place] = from_.pairs[begin(points[i]) + k];
      }
    }
    to_.point.insert(to_.point.end(), points.begin(), points.end());
    to_.point.resize((to_.point.size() + slice_points - 1) / slice_points * slice_points, -1);
    to_.turn_begin.push_back(to_.turn_begin.back() + static_cast<std::int64_t>(turns));
  }

  double largest_reach() const {
    std::vector<double> reach(static_cast<std::size_t>(cluster_.slots), 0.0);
    for (const Pair<Scalar>& pair : to_.pairs) {
      for (const Scalar derivative : pair.derivative) {
        reach[static_cast<std::size_t>(pair.other)] += std::abs(static_cast<double>(derivative));
      }
    }
    return *std::max_element(reach.begin(), reach.end());
  }

  const Clusters<Scalar>& from_;
  const Cluster& cluster_;
  Slices<Scalar>& to_;
};

}  // namespace

template <class Scalar>
Slices<Scalar> make_slices(const Clusters<Scalar>& clusters) {
  std::vector<Slices<Scalar>> parts(clusters.clusters.size());
  share_work(std::ssize(parts), 1, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    SliceMaker<Scalar>(clusters, clusters.clusters[at], parts[at]);
  });
  Slices<Scalar> all;
  const auto append = [](const auto& more, auto& to) { to.insert(to.end(), more.begin(), more.end()); };
  for (Slices<Scalar>& part : parts) {
    const std::int64_t turns = all.turn_begin.back();
    for (std::size_t s = 1; s < part.turn_begin.size(); ++s) {
      all.turn_begin.push_back(turns + part.turn_begin[s]);
    }
    append(part.point, all.point);
    append(part.pairs, all.pairs);
    append(part.reach, all.reach);
    all.cluster_begin.push_back(static_cast<std::int32_t>(all.turn_begin.size() - 1));
    part = {};
  }
  return all;
}
template Slices<float> make_slices(const Clusters<float>&);
template Slices<double> make_slices(const Clusters<double>&);

}  // namespace brainshift::solve::device
