// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene.hpp"

#include <algorithm>

#include <stdexcept>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/options/values.hpp"
#include "solve/cut/read_cut.hpp"

namespace brainshift::pipelines {

std::string_view stage_name(StageId stage) {
  constexpr std::array<std::string_view, all_stages.size()> names = {"segment", "discretise", "solve", "register",
                                                                     "report"};
  return names[index_of(stage)];
}

bool is_stage(std::string_view name) {
  return std::any_of(all_stages.begin(), all_stages.end(), [&](StageId id) { return stage_name(id) == name; });
}

StageId stage_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const StageId stage : all_stages) {
    if (stage_name(stage) == name) {
      return stage;
    }
    names.emplace_back(stage_name(stage));
  }
  throw std::invalid_argument("there is no stage '" + std::string(name) + "'; the stages are " + with_commas(names));
}

solve::LoadCurve load_curve(const Loading& loading) {
  if (!loading.curve.empty()) {
    return solve::read_load_curve(loading.curve, loading.curve_join);
  }
  return {{0, loading.duration.value_or(1)}, {0, 1}, solve::LoadCurve::Join::smooth};
}

solve::Cut read_cut(const CutFile& cut, solve::Plane plane) {
  solve::Cut read = solve::read_cut(cut.file, cut.timing);
  const bool planar = plane != solve::Plane::none;
  if (read.is_path() != planar) {
    throw std::invalid_argument(
        read.name +
        (planar ? ": this is a sheet, but a plane problem is cut along paths (.csv, x,y)"
                : ": this is a path, which cuts a plane problem ('brainshift solve --plane'); a body in space is cut "
                  "along sheets (" +
                      std::string(listed_surface_endings) + ")"));
  }
  return read;
}

std::string place(const SceneSource& source, const std::string& path) {
  const auto found = source.lines.find(path);
  if (found == source.lines.end()) {
    return source.file.string();
  }
  return found->second == 0 ? "--set" : source.file.string() + ":" + std::to_string(found->second);
}

bool is_ours(const Scene& scene, StageId stage) {
  return scene.commands[index_of(stage)].empty();
}

bool is_active(StageId stage, const Scene& scene) {
  const bool needs_image = stage == StageId::registration || stage == StageId::report;
  const bool labels = !scene.image.labels.empty() && is_ours(scene, StageId::segment);
  return !needs_image || !scene.image.t1.empty() || labels || !is_ours(scene, stage);
}

}  // namespace brainshift::pipelines
