// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/verification/figures.hpp"

namespace brainshift::verification {

// A namespace a file.
namespace adaptive_cases {
Outcome adaptive_integration(bool small);
}  // namespace adaptive_cases

namespace analytic_cases {
Outcome homogeneous(bool small);
Outcome cantilever(bool small);
Outcome pressurised_ball(bool small);
}  // namespace analytic_cases

namespace brain_cases {
Outcome brain(bool small);
}  // namespace brain_cases

namespace convergence_cases {
Outcome manufactured(bool small);
Outcome patch_test(bool small);
Outcome step_estimate(bool small);
}  // namespace convergence_cases

namespace cuts_cases {
Outcome cut_path(bool small);
Outcome cut_block(bool small);
}  // namespace cuts_cases

namespace cylinder_cases {
Outcome cylinder_compression(bool small);
Outcome cylinder_shear(bool small);
Outcome cylinder_nearly_incompressible(bool small);
Outcome locking(bool small);
}  // namespace cylinder_cases

namespace disc_cases {
Outcome disc_cylinder(bool small);
Outcome disc_slab(bool small);
}  // namespace disc_cases

namespace extension_cases {
Outcome extension(bool small);
}  // namespace extension_cases

namespace fluid_cases {
Outcome wet_block(bool small);
Outcome wet_ball(bool small);
}  // namespace fluid_cases

namespace large_strain_cases {
Outcome there_and_back(bool small);
Outcome indentation(bool small);
}  // namespace large_strain_cases

namespace resection_cases {
Outcome resection(bool small);
}  // namespace resection_cases

namespace septum_cases {
Outcome septum(bool small);
}  // namespace septum_cases

namespace singular_clouds_cases {
Outcome singular_clouds(bool small);
}  // namespace singular_clouds_cases

namespace swelling_cases {
Outcome bilayer(bool small);
}  // namespace swelling_cases

namespace tear_cases {
Outcome tear(bool small);
}  // namespace tear_cases

}  // namespace brainshift::verification
