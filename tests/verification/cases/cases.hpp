// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/verification/figures.hpp"

namespace brainshift::verification {

Outcome cylinder_compression(bool small);
Outcome cylinder_shear(bool small);
Outcome cylinder_nearly_incompressible(bool small);
Outcome locking(bool small);
Outcome there_and_back(bool small);
Outcome indentation(bool small);
Outcome extension(bool small);
Outcome brain(bool small);
Outcome adaptive_integration(bool small);
Outcome cut_path(bool small);
Outcome cut_block(bool small);
Outcome tear(bool small);
Outcome homogeneous(bool small);
Outcome cantilever(bool small);
Outcome pressurised_ball(bool small);
Outcome resection(bool small);
Outcome manufactured(bool small);
Outcome patch_test(bool small);
Outcome step_estimate(bool small);
Outcome singular_clouds(bool small);

}  // namespace brainshift::verification
