// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::solve {
namespace {

/// Where each label that is not empty stands, and whether one is used twice.
struct Labels {
  std::map<std::string, Eigen::Index> place;
  bool repeated = false;
};

Labels places_of(const std::vector<std::string>& names) {
  Labels labels;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (!names[n].empty() && !labels.place.emplace(names[n], static_cast<Eigen::Index>(n)).second) {
      labels.repeated = true;
    }
  }
  return labels;
}

struct NamedPoints {
  std::filesystem::path path;
  Points positions;
  std::vector<std::string> labels;
};

/// One list of points, all of them placed.
NamedPoints read_list(const std::filesystem::path& path) {
  const PointsFile points(path);
  if (points.lists() != 1) {
    refuse(path, "one markup list is expected, found " + std::to_string(points.lists()));
  }
  if (!points.not_placed().empty()) {
    refuse(path, points.not_placed().front() + " has not been placed; place or delete it");
  }
  return {path, points.positions(), points.labels()};
}

/// The row of `after` of the same label, for each row of `before`.
std::vector<Eigen::Index> partners_by_label(const NamedPoints& before, const NamedPoints& after, const Labels& there) {
  std::vector<Eigen::Index> partner;
  for (const std::string& label : before.labels) {
    const auto found = there.place.find(label);
    if (found == there.place.end()) {
      throw std::invalid_argument(after.path.string() + ": point \"" + label + "\" of " + before.path.string() +
                                  " has no partner of that label here; name the same points in both");
    }
    partner.push_back(found->second);
  }
  return partner;
}

std::vector<Eigen::Index> partners(const NamedPoints& before, const NamedPoints& after) {
  const Labels here = places_of(before.labels), there = places_of(after.labels);
  const bool shared = std::any_of(here.place.begin(), here.place.end(),
                                  [&](const auto& label) { return there.place.contains(label.first); });
  if (shared && before.labels != after.labels) {
    if (here.repeated || there.repeated) {
      throw std::invalid_argument((here.repeated ? before : after).path.string() +
                                  ": two points have the same label, so that the points cannot be matched");
    }
    partners_by_label(after, before, here);
    return partners_by_label(before, after, there);
  }
  if (before.labels.size() != after.labels.size()) {
    throw std::invalid_argument(after.path.string() + ": holds " + std::to_string(after.labels.size()) +
                                " points, but " + before.path.string() + " holds " +
                                std::to_string(before.labels.size()) +
                                ", and no label is in both; give the same points in both");
  }
  std::vector<Eigen::Index> in_order(before.labels.size());
  std::iota(in_order.begin(), in_order.end(), 0);
  return in_order;
}

}  // namespace

CraniotomyLoad read_markups(const std::filesystem::path& before, const std::filesystem::path& after) {
  const NamedPoints first = read_list(before), second = read_list(after);
  CraniotomyLoad load;
  load.positions = first.positions;
  load.displacement = second.positions(partners(first, second), Eigen::all) - load.positions;
  return load;
}

Points read_markup_positions(const std::filesystem::path& file) {
  return read_list(file).positions;
}

}  // namespace brainshift::solve
