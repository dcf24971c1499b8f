// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/point_table.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/text_lines.hpp"
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
  std::vector<std::string> labels, keys;  ///< as the file has them; as they are compared
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
  return {path, points.positions(), points.labels(), points.labels()};
}

/// A table of displacements is a load by itself: of a pair of them only the places would count.
void refuse_displacements(const std::filesystem::path& file) {
  if (ending_of(file) == ".csv" && read_point_table(file).find_column("ux")) {
    refuse(file, "holds displacements (a column ux), not points before or after; give it alone, as the craniotomy");
  }
}

/// Where the two do not name the same points letter for letter, "Vein " names what "vein" does.
void compare_by_letters_alone(NamedPoints& before, NamedPoints& after) {
  const auto sorted = [](std::vector<std::string> names) {
    std::ranges::sort(names);
    return names;
  };
  if (sorted(before.keys) != sorted(after.keys)) {
    for (NamedPoints* points : {&before, &after}) {
      for (std::string& key : points->keys) {
        key = in_lower_case(std::string(trimmed(key)));
      }
    }
  }
}

/// The row of `after` of the same label, for each row of `before`.
std::vector<Eigen::Index> partners_by_label(const NamedPoints& before, const NamedPoints& after, const Labels& there) {
  std::vector<Eigen::Index> partner;
  for (std::size_t n = 0; n < before.keys.size(); ++n) {
    const auto found = there.place.find(before.keys[n]);
    if (found == there.place.end()) {
      throw std::invalid_argument(after.path.string() + ": point \"" + before.labels[n] + "\" of " +
                                  before.path.string() +
                                  " has no partner of that label here; name the same points in both");
    }
    partner.push_back(found->second);
  }
  return partner;
}

/// The row of `after` for each row of `before`, and whether their order alone tells it.
struct Partners {
  std::vector<Eigen::Index> rows;
  bool by_order;
};

Partners partners(const NamedPoints& before, const NamedPoints& after) {
  const Labels here = places_of(before.keys), there = places_of(after.keys);
  const bool shared = std::any_of(here.place.begin(), here.place.end(),
                                  [&](const auto& label) { return there.place.contains(label.first); });
  if (shared && before.keys != after.keys) {
    if (here.repeated || there.repeated) {
      throw std::invalid_argument((here.repeated ? before : after).path.string() +
                                  ": two points have the same label, so that the points cannot be matched");
    }
    partners_by_label(after, before, here);
    return {partners_by_label(before, after, there), false};
  }
  if (before.labels.size() != after.labels.size()) {
    throw std::invalid_argument(after.path.string() + ": holds " + std::to_string(after.labels.size()) +
                                " points, but " + before.path.string() + " holds " +
                                std::to_string(before.labels.size()) +
                                ", and no label is in both; give the same points in both");
  }
  std::vector<Eigen::Index> in_order(before.labels.size());
  std::iota(in_order.begin(), in_order.end(), 0);
  return {std::move(in_order), !shared};
}

}  // namespace

CraniotomyLoad read_markups(const std::filesystem::path& before, const std::filesystem::path& after) {
  refuse_displacements(before);
  refuse_displacements(after);
  NamedPoints first = read_list(before), second = read_list(after);
  compare_by_letters_alone(first, second);
  const Partners paired = partners(first, second);
  CraniotomyLoad load;
  load.positions = first.positions;
  load.displacement = second.positions(paired.rows, Eigen::all) - load.positions;
  load.paired_by_order = paired.by_order;
  return load;
}

Points read_markup_positions(const std::filesystem::path& file) {
  return read_list(file).positions;
}

}  // namespace brainshift::solve
