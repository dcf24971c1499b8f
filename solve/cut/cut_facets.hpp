// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solve/cut/inside_body.hpp"
#include "solve/interface/cut.hpp"
#include "solve/shape/visibility.hpp"

namespace brainshift::solve {

/// The cuts as far as they have come at a time of the load's curve: a path up to where its tip is then, of a sheet the
/// triangles that it has passed in the mean; sheets hang together at corners that lie at the same place. spacing of the
/// nodes, mm, for the fronts (find_fronts()).
CutFacets facets_at(std::span<const Cut> cuts, double time, const InsideBody& inside, double spacing);

/// One set of facets and another.
CutFacets joined(const CutFacets& first, CutFacets second);

/// Before all that is cut.
inline constexpr double from_the_start = -1;

/// What of the cuts comes after one time and until another.
CutFacets facets_between(std::span<const Cut> cuts, double after, double until);

/// When the last part of the cuts is cut; 0 where all are there from the start.
double last_time(std::span<const Cut> cuts);

/// When to cut further, so that it is about a stride, mm, each time; ascending, the last is that of the last part. None
/// where all is cut from the start.
std::vector<double> times_of_advance(std::span<const Cut> cuts, double stride);

/// Length of a path's segments, mm, or area of a sheet's triangles, mm².
double extent(const CutFacets& facets);

}  // namespace brainshift::solve
