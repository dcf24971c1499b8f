// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/shape/support_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nanoflann.hpp>

namespace brainshift::solve {

/// The nodes of one octave of radius, seen by nanoflann without copying their positions.
struct SupportSearch::Level {
  const Points& positions;
  std::vector<std::int32_t> nodes;
  double largest_radius = 0;

  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Level>, Level, 3, std::uint32_t>;
  std::unique_ptr<Tree> tree;

  std::size_t kdtree_get_point_count() const { return nodes.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return positions(nodes[i], static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

SupportSearch::SupportSearch(const Points& positions, std::vector<double> radius) : radius_(std::move(radius)) {
  std::map<int, std::unique_ptr<Level>> octaves;
  for (std::size_t a = 0; a < radius_.size(); ++a) {
    auto& level = octaves[std::ilogb(radius_[a])];
    if (!level) {
      level = std::make_unique<Level>(Level{positions, {}, 0, nullptr});
    }
    level->nodes.push_back(static_cast<std::int32_t>(a));
    level->largest_radius = std::max(level->largest_radius, radius_[a]);
  }
  for (auto& [octave, level] : octaves) {
    level->tree = std::make_unique<Level::Tree>(3, *level, nanoflann::KDTreeSingleIndexAdaptorParams(12));
    level->tree->buildIndex();
    levels_.push_back(std::move(level));
  }
}

SupportSearch::~SupportSearch() = default;
SupportSearch::SupportSearch(SupportSearch&&) noexcept = default;

namespace {

/// nanoflann's result set that keeps what lies inside its node's own radius.
struct SupportCollector {
  const std::vector<std::int32_t>& nodes;
  const std::vector<double>& radius;
  double scale;
  double extent;
  double squared_reach;
  std::vector<std::int32_t>& found;

  std::size_t size() const { return found.size(); }
  bool full() const { return true; }
  double worstDist() const { return squared_reach; }
  bool addPoint(double squared, std::uint32_t i) {
    const std::int32_t node = nodes[i];
    const double limit = scale * radius[static_cast<std::size_t>(node)] + extent;
    if (squared < limit * limit) {
      found.push_back(node);
    }
    return true;
  }
};

}  // namespace

void SupportSearch::find(const Eigen::Vector3d& x, double scale, std::vector<std::int32_t>& found,
                         double extent) const {
  found.clear();
  for (const auto& level : levels_) {
    const double reach = scale * level->largest_radius + extent;
    SupportCollector collector{level->nodes, radius_, scale, extent, reach * reach, found};
    level->tree->findNeighbors(collector, x.data(), nanoflann::SearchParams(32, 0, false));
  }
  std::sort(found.begin(), found.end());
}

}  // namespace brainshift::solve
