// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/body/mass_in_time.hpp"

#include <algorithm>
#include <cmath>

namespace brainshift::solve {
namespace {

double mass_of_point(const BodyParts& parts, std::size_t point) {
  return parts.materials.density[static_cast<std::size_t>(parts.materials.row_of_point[point])] *
         parts.points.volume[point];
}

/// Takes from its neighbours what each node was given, in proportion to their share of the points that both see; of
/// none more than half of its mass.
void take_from_neighbours(const BodyParts& parts, const std::vector<double>& given, std::vector<double>& mass) {
  std::vector<double> seen(mass.size(), 0.0), taken(mass.size(), 0.0);
  const auto visit = [&](const auto& of_pair) {
    for (std::size_t i = 0; i < parts.points.size(); ++i) {
      const ShapeRow row = parts.point_rows[i];
      for (std::size_t a = 0; a < row.size(); ++a) {
        const auto giver = static_cast<std::size_t>(row.node[a]);
        for (std::size_t b = 0; given[giver] > 0 && b < row.size(); ++b) {
          const auto neighbour = static_cast<std::size_t>(row.node[b]);
          if (given[neighbour] == 0) {
            of_pair(giver, neighbour, mass_of_point(parts, i) * std::abs(row.value[a] * row.value[b]));
          }
        }
      }
    }
  };
  visit([&](std::size_t giver, std::size_t, double share) { seen[giver] += share; });
  visit([&](std::size_t giver, std::size_t neighbour, double share) {
    taken[neighbour] += given[giver] * share / seen[giver];
  });
  for (std::size_t a = 0; a < mass.size(); ++a) {
    mass[a] -= std::min(taken[a], mass[a] / 2);
  }
}

}  // namespace

std::vector<double> mass_in_time(const BodyParts& parts) {
  constexpr double least = 0.1;
  std::vector<double> mass(parts.cloud.size(), 0.0), even(mass), given(mass);
  for (std::size_t i = 0; i < parts.points.size(); ++i) {
    const double of_point = mass_of_point(parts, i);
    const ShapeRow row = parts.point_rows[i];
    for (std::size_t b = 0; b < row.size(); ++b) {
      mass[static_cast<std::size_t>(row.node[b])] += of_point * row.value[b];
      even[static_cast<std::size_t>(row.node[b])] += of_point / static_cast<double>(row.size());
    }
  }
  for (std::size_t a = 0; a < mass.size(); ++a) {
    given[a] = std::max(0.0, least * even[a] - mass[a]);
    mass[a] += given[a];
  }
  take_from_neighbours(parts, given, mass);
  return mass;
}

}  // namespace brainshift::solve
