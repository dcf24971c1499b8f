// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/cases/cases.hpp"

namespace brainshift::verification {

const std::vector<NamedCase>& all_cases() {
  static const std::vector<NamedCase> cases = {{"homogeneous", analytic_cases::homogeneous},
                                               {"cantilever", analytic_cases::cantilever},
                                               {"pressurised_ball", analytic_cases::pressurised_ball},
                                               {"resection", resection_cases::resection},
                                               {"manufactured", convergence_cases::manufactured},
                                               {"patch_test", convergence_cases::patch_test},
                                               {"step_estimate", convergence_cases::step_estimate},
                                               {"singular_clouds", singular_clouds_cases::singular_clouds},
                                               {"cylinder_compression", cylinder_cases::cylinder_compression},
                                               {"cylinder_shear", cylinder_cases::cylinder_shear},
                                               {"cylinder_nu0499", cylinder_cases::cylinder_nearly_incompressible},
                                               {"locking", cylinder_cases::locking},
                                               {"there_and_back", large_strain_cases::there_and_back},
                                               {"indentation", large_strain_cases::indentation},
                                               {"disc_cylinder", disc_cases::disc_cylinder},
                                               {"disc_slab", disc_cases::disc_slab},
                                               {"extension", extension_cases::extension},
                                               {"brain", brain_cases::brain},
                                               {"adaptive_integration", adaptive_cases::adaptive_integration},
                                               {"cut_path", cuts_cases::cut_path},
                                               {"cut_block", cuts_cases::cut_block},
                                               {"wet_block", fluid_cases::wet_block},
                                               {"wet_ball", fluid_cases::wet_ball},
                                               {"septum", septum_cases::septum},
                                               {"bilayer", swelling_cases::bilayer},
                                               {"tear", tear_cases::tear}};
  return cases;
}

}  // namespace brainshift::verification
