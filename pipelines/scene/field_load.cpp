// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/field_load.hpp"

#include <limits>
#include <stdexcept>

#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "solve/load/near_surface.hpp"

namespace brainshift::pipelines {
namespace {

using registration::Moves;

Points read_opening(const std::filesystem::path& file) {
  Points places = is_points_file(file) ? solve::read_markup_positions(file) : read_surface(file).vertices;
  if (places.rows() < 3) {
    refuse(file, "an opening needs three points or more, this has " + std::to_string(places.rows()));
  }
  return places;
}

/// The surface nodes under the opening, those on which measured points there would act; all where none is named.
std::vector<Eigen::Index> nodes_under(const std::filesystem::path& where, const solve::OpeningOptions& opening,
                                      const NodeCloud& cloud) {
  if (where.empty()) {
    const std::vector<std::int32_t> all = surface_nodes(cloud);
    return {all.begin(), all.end()};
  }
  const Points rim = read_opening(where);
  Points reached;
  try {
    reached = solve::prescribed_on_surface_nodes(cloud, {rim, Points::Zero(rim.rows(), 3)}, opening);
  } catch (const std::invalid_argument& fault) {
    refuse(where, fault.what());
  }
  std::vector<Eigen::Index> nodes;
  for (Eigen::Index a = 0; a < reached.rows(); ++a) {
    if (reached.row(a).allFinite()) {
      nodes.push_back(a);
    }
  }
  return nodes;
}

}  // namespace

Moves direction_of(const FieldLoad& field) {
  const std::optional<Moves> known = registration::known_direction(field.file);
  if (field.moves == FieldLoad::Moves::by_name) {
    if (!known) {
      refuse(field.file,
             "nothing says which way it goes; give the <field> moves=\"image\" where it resamples the preop image onto "
             "the intraop one (ANTs and elastix with the intraop image as the fixed one), or moves=\"points\" where it "
             "takes preop places to intraop ones (with the preop image as the fixed one)");
    }
    return *known;
  }
  const Moves said = field.moves == FieldLoad::Moves::points ? Moves::points : Moves::image;
  if (known && *known != said) {
    const bool points = *known == Moves::points;
    refuse(field.file, std::string("by its name or the .json beside it, it moves ") + (points ? "points" : "images") +
                           ", and the <field> says moves=\"" + (points ? "image" : "points") +
                           "\"; leave moves out, or rename the file");
  }
  return said;
}

void check_field_load(const FieldLoad& field) {
  direction_of(field);
  registration::read_place_map(field.file);
  if (!field.where.empty()) {
    read_opening(field.where);
  }
}

FieldOnSurface field_on_surface_nodes(const FieldLoad& field, const solve::OpeningOptions& opening,
                                      const NodeCloud& cloud) {
  const Moves moves = direction_of(field);
  const registration::PlaceMap map = registration::read_place_map(field.file);
  const std::vector<Eigen::Index> nodes = nodes_under(field.where, opening, cloud);
  FieldOnSurface result{Points::Constant(cloud.positions.rows(), 3, std::numeric_limits<double>::quiet_NaN())};
  std::vector<Eigen::Index> known;
  for (const Eigen::Index node : nodes) {
    const Eigen::Vector3d x = cloud.positions.row(node);
    const auto there = moves == Moves::points ? map(x) : registration::inverse_at(map, x);
    if (there) {
      result.displacement.row(node) = (*there - x).transpose();
      known.push_back(node);
    } else if (moves == Moves::image && map(x)) {
      ++result.not_found;
    }
  }
  result.asked = nodes.size();
  result.known = known.size();
  if (known.empty()) {
    refuse(field.file, "it says nothing of the " + std::to_string(nodes.size()) + " places of the brain's surface" +
                           (field.where.empty() ? "" : " under " + field.where.string()) +
                           ": they lie outside its grid or where it is NaN, or it takes no place to them; is it of "
                           "this patient, and in the image's frame?");
  }
  try {
    solve::check_moved(result.displacement(known, Eigen::all), cloud.positions);
  } catch (const std::invalid_argument& fault) {
    refuse(field.file, fault.what());
  }
  return result;
}

}  // namespace brainshift::pipelines
