// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/measure_warnings.hpp"

#include <cmath>

namespace brainshift::pipelines {

namespace {

/// Measured on a cube between frictionless plates under MMLS: 1.25 points a node are exact down to 0.8 of its height
/// and wholly wrong at 0.7, although the steps end; 1.9 are exact at 0.6. Pressed by a tenth its force is wrong by 4 %
/// with 0.7, and right with one. On cubes of nodes closer in the middle, all of whose surface is moved affinely by a
/// tenth and more: with 0.43 points a node there they are wrong by a tenth of that (an ellipsoid with 0.54 by two
/// fifths), with 0.55 and more exact.
Warnings warnings_of_points(const solve::SolveMeasures& measures) {
  constexpr double enough = 1.6, little_compression = 0.8, enough_at_rest = 1, enough_everywhere = 0.6;
  Warnings warnings;
  if (measures.fewest_points < enough_everywhere) {
    warnings.push_back(
        "about some nodes there are only " + with_digits(measures.fewest_points) +
        " integration points a node: nodes may have moved against each other there as no point sees, by tenths of "
        "what is imposed; take smaller cells there or more points a cell");
  }
  const std::size_t nodes = measures.region_nodes > 0 ? measures.region_nodes : measures.nodes;
  const double points_per_node = static_cast<double>(measures.integration_points) / static_cast<double>(nodes);
  if (points_per_node < enough && measures.smallest_jacobian < little_compression) {
    warnings.push_back("only " + with_digits(points_per_node) +
                       " integration points a node where the body is pressed to " +
                       with_digits(measures.smallest_jacobian) +
                       " of its volume: motions that no point sees may have grown; take smaller cells or more points a "
                       "cell, two points a node");
  } else if (points_per_node < enough_at_rest) {
    warnings.push_back("only " + std::to_string(measures.integration_points) + " integration points for " +
                       std::to_string(nodes) +
                       " nodes: motions between them cost too little, so that forces may be several per cent too "
                       "small; take smaller cells or more points a cell, two points a node");
  }
  return warnings;
}

/// Of heads at hand there are 1 % at most, of phantoms 5 %.
Warnings warnings_of_labels(const solve::SolveMeasures& measures) {
  constexpr double much = 0.1;
  const double share = static_cast<double>(measures.outside_label) / static_cast<double>(measures.integration_points);
  if (!(share > much)) {
    return {};
  }
  return {
      std::to_string(std::lround(100 * share)) +
      " % of the integration points lie where the label map names no tissue with a material, and took the label of "
      "their cell; give each label of the map a material, or, where the map should show tissue there, cells and map "
      "are not in one frame: mm, LPS"};
}

Warnings warnings_of_pressure(const solve::SolveMeasures& measures) {
  if (measures.pressed_share < solve::much_pressed) {
    return {};
  }
  return {with_digits(100 * measures.pressed_share) + " % of a tissue's volume are under a pressure of more than " +
          with_digits(solve::most_pressure) +
          " shear moduli, which the answer does not withstand: it may be all wrong; is a change of volume prescribed "
          "that the tissue does not allow? Take a smaller load, a smaller Poisson ratio, or more nodes"};
}

Warnings warnings_of_compression(const solve::SolveMeasures& measures) {
  if (measures.compressed_share < solve::much_compressed) {
    return {};
  }
  return {
      with_digits(100 * measures.compressed_share) +
      " % of the volume are pressed to about half of a length and less, where tissue creases and folds: the answer "
      "may be all wrong; has all of the body, with what swells, room where it is? Take a smaller load or more nodes"};
}

/// Of a ball's cavity in soft tissue 8 % of the volume leave a smooth wall and 5 % creases; at 3 % a seventh of the
/// wall has passed through the rest, by a fifth of a spacing, on clouds of 1,500 to 6,000 nodes.
Warnings warnings_of_cavity(const solve::SolveMeasures& measures) {
  constexpr double smooth = 0.06;
  if (!measures.resection || !measures.resection->volume ||
      *measures.resection->volume >= smooth * measures.resection->removed_volume) {
    return {};
  }
  return {"of the cavity's volume " +
          with_digits(100 * *measures.resection->volume / measures.resection->removed_volume) +
          " % are left: its wall is creased more finely than the nodes can follow, and creases may pass through each "
          "other; expect no accuracy there better than two spacings"};
}

Warnings warnings_of_noise(const solve::SolveMeasures& measures) {
  constexpr double far_less = 0.4;  // what was given counts as one point, so that few points do not come so low
  if (!measures.measured) {
    return {};
  }
  if (measures.measured->rough) {
    return {"the measured points move alike over " + with_digits(measures.measured->smooth.length) +
            " mm only, far more than the noise that is given: no cortex does, so the noise is likely larger, or some "
            "points are wrong; give the noise of one component in mm, as a standard deviation"};
  }
  const solve::SmoothMotion& refused = measures.measured->refused;
  if (const double size = std::hypot(refused.along, refused.across); size > measures.largest_displacement) {
    return {"the measured points do not tell the opening's motion from their noise: it may be about " +
            with_digits(size) + " mm, and the answer, at most " + with_digits(measures.largest_displacement) +
            " mm, leaves it out; measure more points or more exactly, and give the noise of one component in mm, as a "
            "standard deviation, no larger than it is"};
  }
  const bool weight_is_given = measures.measured->weights.empty();  // then it is that, not the noise, that decides
  if (weight_is_given || measures.measured->noise_factor >= far_less) {
    return {};
  }
  return {
      "the measured points agree at least " + with_digits(1 / measures.measured->noise_factor) +
      " times better with each other than the noise that is given lets expect: the load may be followed too little; "
      "give the noise of one component in mm, as a standard deviation"};
}

constexpr std::size_t few_nodes = 500;

/// Of many nodes a tissue that they hardly resolve, as a ventricle, does little to the rest.
bool does_little(const solve::ThinPart& part, const solve::SolveMeasures& measures) {
  return part.is_tissue && measures.estimated_error_95 && measures.nodes >= few_nodes;
}

/// The parts that do little, or the others: "tissue 2 (2.7), ...".
std::string thin_parts(const solve::SolveMeasures& measures, bool doing_little) {
  std::string parts;
  for (const solve::ThinPart& part : measures.thin) {
    if (does_little(part, measures) == doing_little) {
      parts += (parts.empty() ? "" : ", ") + part.what + " (" + with_digits(part.spacings) + ")";
    }
  }
  return parts;
}

Warnings warnings_of_few_nodes(const solve::SolveMeasures& measures) {
  const std::string parts = thin_parts(measures, false);
  if (parts.empty()) {
    return {};
  }
  return {(measures.estimated_error_95
               ? "for want of nodes the answer may be farther off than is estimated"
               : "nothing says how far off the answer is for want of nodes, and it may be far off") +
          (": fewer than four node spacings thick are " + parts) + "; take more nodes"};
}

}  // namespace

Warnings warnings_of(const solve::SolveMeasures& measures) {
  Warnings warnings = warnings_of_points(measures);
  for (const Warnings& more :
       {warnings_of_labels(measures), warnings_of_pressure(measures), warnings_of_compression(measures),
        warnings_of_cavity(measures), warnings_of_noise(measures), warnings_of_few_nodes(measures)}) {
    append(more, warnings);
  }
  return warnings;
}

std::vector<std::string> notes_of(const solve::SolveMeasures& measures) {
  std::vector<std::string> notes;
  if (const std::string parts = thin_parts(measures, true); !parts.empty()) {
    notes.push_back("fewer than four node spacings thick, so that motion within is not resolved: " + parts);
  }
  if (measures.converged && !measures.estimated_error_95 && thin_parts(measures, false).empty()) {
    notes.emplace_back("nothing estimates how far off this answer is for want of nodes: hold it against one on more");
  }
  return notes;
}

}  // namespace brainshift::pipelines
