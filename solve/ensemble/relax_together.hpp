// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "segmentation/progress/progress.hpp"
#include "solve/body/body.hpp"
#include "solve/dynamics/stepping.hpp"
#include "solve/ensemble/member.hpp"
#include "solve/interface/load_curve.hpp"
#include "solve/interface/options.hpp"

namespace brainshift::solve {

/// Whether these loads of a body can be stepped as an ensemble: at rest it may hold prescribed displacements, exact or
/// with noise, touch a skull and have forces; it may not be cut, parted, in plane stress or held by the simplified
/// imposition or have stiff parts, and no member may swell or relax in time.
bool may_go_together(const Body& body, std::span<const Member> loads, const SolveOptions& options);

/// relax() of up to `members` loads of one body at once. What a step reads of the body is read once for all of them.
/// Each has masses, damping, error bound and end of its own, so that each ends, to rounding, where and when relax()
/// would have ended it alone; a member that has ended is kept as it was. One that proves unstable, or is so slow that
/// relax() would quicken it, leaves. All members start from rest, or all from their start. The result does not depend
/// on the number of threads, nor a member's on the others. patient: a slow one stays, be
/// it rounded. Throws as EssentialConditions::factorise() does.
std::vector<MemberResult> relax_together(const Body& body, std::span<const Member> loads, const LoadCurve& curve,
                                         const SolveOptions& options, const Progress& progress, bool patient = false,
                                         BoundOf bound = BoundOf::displacement);

}  // namespace brainshift::solve
