// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/material/check_material.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "solve/material/material_options.hpp"
#include "solve/material/ogden.hpp"
#include "solve/material/own_elasticity.hpp"

namespace brainshift::solve {

namespace {

template <class... Parts>
void require(bool holds, const Parts&... parts) {
  if (!holds) {
    std::ostringstream sentence;
    (sentence << ... << parts);
    throw std::invalid_argument(sentence.str());
  }
}

bool is_positive(double value) {
  return value > 0 && std::isfinite(value);
}

std::string written(const Material& material, const char* constant) {
  return find_option(material_options(), constant)->get(material);
}

void check_constant(const std::string& name, const Material& material, const char* constant) {
  const Option<Material>& option = *find_option(material_options(), constant);
  require(option.holds(material), name, ": ", refusal(option, option.get(material)));
}

void check_ogden(const std::string& name, const Material& material) {
  require(!material.ogden.empty(), name,
          " follows Ogden's law but has no terms; give at least one pair of mu and alpha");
  require(material.ogden.size() <= Ogden::capacity, name, " has ", material.ogden.size(), " Ogden terms; at most ",
          Ogden::capacity, " are supported");
  for (const OgdenTerm& term : material.ogden) {
    require(std::isfinite(term.shear_modulus), name, " has an Ogden term with mu = ", term.shear_modulus,
            " Pa; it must be finite");
    require(term.exponent != 0 && std::isfinite(term.exponent), name, " has an Ogden term with alpha = ", term.exponent,
            "; it must be finite and not 0");
  }
  require(is_positive(shear_modulus(material)), name, " is unstable at rest: the mu of its Ogden terms add up to ",
          shear_modulus(material), " Pa; the sum must be positive");
}

void check_prony(const std::string& name, const Material& material) {
  double relaxing = 0;
  for (const PronyTerm& term : material.prony) {
    require(term.share >= 0, name, " has a Prony term with the share ", term.share, "; it must not be negative");
    require(is_positive(term.time), name, " has a Prony term with the time ", term.time, " s; it must be positive");
    relaxing += term.share;
  }
  require(relaxing < 1, name, " has Prony shares that add up to ", relaxing,
          "; the sum must be below 1, or nothing would hold the tissue in the end");
}

void check_own(const std::string& name, const Material& material) {
  require(material.own && material.own->energy && material.own->stress, name,
          " follows a law of its own but does not bring its energy and stress");
  require(is_positive(material.own->shear_modulus), name,
          " has a law of its own with mu = ", material.own->shear_modulus, " Pa; it must be positive");
}

}  // namespace

void check_material(const std::string& name, const Material& material) {
  require(material.law == Law::ogden || material.ogden.empty(), name, " has the Ogden terms ",
          written(material, "ogden"), " but follows the law ", written(material, "law"),
          "; set the law to ogden, or ogden to nothing");
  if (material.law == Law::own) {
    check_own(name, material);
  } else if (material.law == Law::ogden) {
    check_ogden(name, material);
  } else {
    check_constant(name, material, "law");
    check_constant(name, material, "youngs_modulus");
  }
  check_constant(name, material, "poisson_ratio");
  check_constant(name, material, "density");
  check_constant(name, material, "swelling");
  check_prony(name, material);
}

}  // namespace brainshift::solve
