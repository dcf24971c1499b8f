// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/named_materials.hpp"

#include <gtest/gtest.h>

#include <string>

#include "solve/material/check_material.hpp"
#include "solve/material/material.hpp"

namespace brainshift::solve::named_materials_test {

TEST(NamedMaterials, AreAllValidAndThoseOfTheLiterature) {
  EXPECT_EQ(material_names(),
            (std::vector<std::string>{"brain", "brain_ogden", "brain_viscoelastic", "tumour", "ventricle"}));
  for (const std::string& name : material_names()) {
    EXPECT_NO_THROW(check_material(name, named_material(name).value()));
  }
  EXPECT_FALSE(named_material("liver"));
  EXPECT_EQ(named_material("brain")->youngs_modulus, 3000);
  EXPECT_EQ(named_material("tumour")->youngs_modulus, 9000);
  EXPECT_EQ(named_material("ventricle")->poisson_ratio, 0.1);
  EXPECT_EQ(shear_modulus(*named_material("brain_ogden")), 842);
  EXPECT_NEAR(shear_modulus(long_term(*named_material("brain_viscoelastic"))), 842 * 0.185, 1e-10);
}

}  // namespace brainshift::solve::named_materials_test
