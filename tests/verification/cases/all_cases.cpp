// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/verification/cases/cases.hpp"

namespace brainshift::verification {

const std::vector<NamedCase>& all_cases() {
  static const std::vector<NamedCase> cases = {{"homogeneous", homogeneous},
                                               {"cantilever", cantilever},
                                               {"pressurised_ball", pressurised_ball},
                                               {"resection", resection},
                                               {"manufactured", manufactured},
                                               {"patch_test", patch_test},
                                               {"step_estimate", step_estimate},
                                               {"singular_clouds", singular_clouds},
                                               {"cylinder_compression", cylinder_compression},
                                               {"cylinder_shear", cylinder_shear},
                                               {"cylinder_nu0499", cylinder_nearly_incompressible},
                                               {"locking", locking},
                                               {"there_and_back", there_and_back},
                                               {"indentation", indentation},
                                               {"extension", extension},
                                               {"brain", brain},
                                               {"adaptive_integration", adaptive_integration},
                                               {"cut_path", cut_path},
                                               {"cut_block", cut_block},
                                               {"tear", tear}};
  return cases;
}

}  // namespace brainshift::verification
