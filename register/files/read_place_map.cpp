// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/read_place_map.hpp"

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "register/field/field_sampler.hpp"
#include "register/files/itk_transform.hpp"
#include "register/files/transform_files.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/image/field_with_gaps.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

PlaceMap map_of_transform(const fs::path& file) {
  return [transform = read_itk_transform(file), file](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
    const auto to = transform({x[0], x[1], x[2]});
    if (!to) {
      return std::nullopt;
    }
    const Eigen::Vector3d place(to->data());
    if (!place.allFinite()) {
      refuse(file, "takes a place of the brain to one that is not finite; was it written whole?");
    }
    return place;
  };
}

PlaceMap map_of_image(const fs::path& file) {
  const auto field = std::make_shared<const VectorImage>(read_field_with_gaps(file));
  return [field, sampler = FieldSampler(*field)](const Eigen::Vector3d& x) -> std::optional<Eigen::Vector3d> {
    const Eigen::Vector3d index = sampler.to_index(x);
    if (!sampler.inside(index)) {
      return std::nullopt;
    }
    const Eigen::Vector3d to = x + sampler.value(index);
    return to.allFinite() ? std::optional(to) : std::nullopt;  // beside a voxel that is NaN
  };
}

/// The file's name without its endings.
std::string stem_of(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.substr(0, name.find('.'));
}

std::optional<Moves> direction_in_note(const fs::path& file) {
  std::ifstream in(file.parent_path() / (stem_of(file) + ".json"));
  const nlohmann::json note = nlohmann::json::parse(in, nullptr, false);
  const auto says = [&note](const char* key, const char* value) {
    return note.is_object() && note.contains(key) && note[key] == value;
  };
  if (!says("From", "preop") || !says("To", "intraop")) {
    return std::nullopt;
  }
  return says("Mode", "points")  ? std::optional(Moves::points)
         : says("Mode", "image") ? std::optional(Moves::image)
                                 : std::nullopt;
}

}  // namespace

std::optional<Moves> known_direction(const fs::path& file) {
  const std::string stem = stem_of(file);
  if (stem == point_transform || stem == "preop_to_intraop") {
    return Moves::points;
  }
  if (stem == image_transform || stem == "intraop_to_preop") {
    return Moves::image;
  }
  return direction_in_note(file);
}

PlaceMap read_place_map(const fs::path& file) {
  check_readable(file);
  return is_transform_file(file) ? map_of_transform(file) : map_of_image(file);
}

}  // namespace brainshift::registration
