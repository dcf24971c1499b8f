// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/rupture_text.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "segmentation/options/option.hpp"

namespace brainshift::pipelines {
namespace {

OptionTable<solve::Rupture> rupture_options() {
  using solve::Rupture;
  return {number_option<Rupture>("stretch", &Rupture::strength, {.low = 1, .low_allowed = false}, "", ""),
          number_option<Rupture>("stress", &Rupture::strength, above_zero, "Pa", ""),
          number_option<Rupture>("distance", &Rupture::distance, not_negative, "mm", ""),
          number_option<Rupture>("scatter", &Rupture::scatter, {.low = 0, .high = 1, .high_allowed = false}, "", ""),
          number_option<Rupture>("seed", &Rupture::seed, not_negative, "", "")};
}

}  // namespace

solve::Rupture rupture_from_text(const std::string& text) {
  const auto fail = [&](const std::string& what) { throw std::invalid_argument("--rupture '" + text + "' " + what); };
  const OptionTable<solve::Rupture> options = rupture_options();
  solve::Rupture rupture;
  std::set<std::string> given;
  for (const std::string& word : split_words(text)) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const Option<solve::Rupture>* option = find_option(options, name);
    if (option == nullptr || equals == std::string::npos) {
      fail("has no attribute '" + word + "'; allowed: NAME=NUMBER of " + option_names(options) +
           ", as stretch=1.4,distance=2 is");
    }
    const std::string value = word.substr(equals + 1);
    if (!set_option(*option, rupture, value)) {
      fail("is refused: " + refusal(*option, value));
    }
    if (!given.insert(name).second) {
      fail("names " + name + " twice");
    }
  }
  if (given.contains("stretch") == given.contains("stress")) {
    fail("must give the strength once: as a stretch (above 1) or as a stress (Pa)");
  }
  rupture.criterion =
      given.contains("stretch") ? solve::Rupture::Criterion::stretch : solve::Rupture::Criterion::stress;
  return rupture;
}

solve::WeakSpot weak_spot_from_text(const std::string& text) {
  constexpr Range share{.low = 0, .high = 1, .low_allowed = false, .high_allowed = false};
  const auto numbers = read_numbers<double>(text);
  const auto finite = [](double number) { return any_number.holds(number); };
  if (!numbers || numbers->size() != 4 || !std::all_of(numbers->begin(), numbers->end(), finite) ||
      !above_zero.holds((*numbers)[2]) || !share.holds((*numbers)[3])) {
    throw std::invalid_argument("--weak-spot is '" + text +
                                "', but must be x,y,radius,factor, as 30,20,5,0.5 is: mm, the radius above 0, the "
                                "factor of the strength between 0 and 1");
  }
  return {.place = {(*numbers)[0], (*numbers)[1]}, .radius = (*numbers)[2], .factor = (*numbers)[3]};
}

}  // namespace brainshift::pipelines
