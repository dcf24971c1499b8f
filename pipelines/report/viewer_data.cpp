// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/viewer_data.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <numeric>
#include <span>
#include <utility>

#include "pipelines/report/canvas.hpp"
#include "register/field/nodal_values.hpp"
#include "segmentation/geometry/grid_cell.hpp"
#include "segmentation/image/voxels.hpp"

namespace brainshift::pipelines {

namespace {

using nlohmann::json;

constexpr double image_margin = 10;  // mm, shown around the brain
constexpr double field_voxel = 2;    // mm, at least: fields are smooth
constexpr double most_voxels = 6e6;  // of an image
constexpr std::size_t least_voxels = 100'000;

// The part of a grid around the brain, with voxels so many times as long.
ImageGeometry part_around(const Surface& brain, const ImageGeometry& grid, const Eigen::Array3d& longer) {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& vertex : brain.vertices.rowwise()) {
    const Eigen::Array3d index = grid.to_index(vertex.transpose());
    low = low.min(index - image_margin / grid.spacing.array());
    high = high.max(index + image_margin / grid.spacing.array());
  }
  const Eigen::Array3d last = grid.size.cast<double>() - 1;
  low = low.floor().max(0).min(last);
  high = high.ceil().min(last).max(low);
  ImageGeometry part = grid;
  part.origin = grid.to_world(low);
  part.spacing = grid.spacing.array() * longer;
  part.size = ((high - low) / longer).floor().cast<int>() + 1;
  return part;
}

// One value a voxel: of its centre's place.
template <class T, class Value>
std::vector<T> on_voxels(const ImageGeometry& grid, const Value& value) {
  std::vector<T> values(grid.voxel_count());
  for_each_voxel_in_parallel(grid.size, [&](int i, int j, int k) {
    values[grid.offset(i, j, k)] = static_cast<T>(value(grid.to_world({i * 1.0, j * 1.0, k * 1.0})));
  });
  return values;
}

double value_at(const ScalarImage& image, const Eigen::Vector3d& place) {
  const GridCell cell(image.geometry.size, image.geometry.to_index(place));
  return cell.interpolate([&image](std::size_t voxel) { return image.voxels[voxel]; });
}

template <class T>
std::string packed_numbers(const T& values) {
  return packed({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(*values.data())});
}

// In steps of 4: the other two bits are noise, which does not compress.
std::vector<std::uint8_t> greys(const ScalarImage& image, const View& view, const ImageGeometry& grid) {
  return on_voxels<std::uint8_t>(grid, [&](const Eigen::Vector3d& place) {
    const double share = (value_at(image, place) - view.darkest) / (view.brightest - view.darkest);
    return 4 * std::lround(63 * std::clamp(share, 0.0, 1.0));
  });
}

// Both images, and the label maps where there are both.
std::vector<PackedBytes> images_on(const ImageGeometry& grid, const RunData& run, const View& view) {
  const auto before = greys(*run.t1, view, grid);
  auto change = greys(*run.warped, view, grid);
  std::ranges::transform(change, before, change.begin(), [](int to, int from) {
    return static_cast<std::uint8_t>(to - from);  // modulo 256, as the page adds it
  });
  std::vector<PackedBytes> arrays = {{"image", packed_numbers(before)}, {"image_change", packed_numbers(change)}};
  if (run.labels && run.warped_labels) {
    for (const auto& [name, map] : {std::pair("labels", &*run.labels), {"labels_after", &*run.warped_labels}}) {
      const auto label = [map = map](const Eigen::Vector3d& place) { return label_at(*map, place); };
      arrays.push_back({name, packed_numbers(on_voxels<std::uint16_t>(grid, label))});
    }
  }
  return arrays;
}

// Adds a field on a grid, one component after the other, in whole steps; value: of a place and a component.
template <class Value>
void add_field(ViewerData& data, const std::string& name, double step, int components, const ImageGeometry& grid,
               const Value& value) {
  std::vector<std::int16_t> all;
  for (int component = 0; component < components; ++component) {
    std::ranges::copy(
        on_voxels<std::int16_t>(grid,
                                [&](const Eigen::Vector3d& place) {
                                  constexpr double most = std::numeric_limits<std::int16_t>::max();
                                  return std::lround(std::clamp(value(place, component) / step, -most, most));
                                }),
        std::back_inserter(all));
  }
  data.facts["steps"][name] = step;
  data.arrays.push_back({name, packed_numbers(all)});
}

// Values of the solution's nodes, mm, where there are any.
void add_nodal(ViewerData& data, const std::string& name, const std::vector<double>& values, const RunData& run,
               const ImageGeometry& grid) {
  if (!values.empty()) {
    const ScalarImage image = registration::nodal_values_on(*run.solution, values, false, grid);
    add_field(data, name, 0.005, 1, grid, [&](auto& place, int) { return value_at(image, place); });
  }
}

void add_fields(ViewerData& data, const RunData& run, const ImageGeometry& grid) {
  const VectorImage& forward = *run.forward;
  add_field(data, "displacement", 0.02, 3, grid, [&](const Eigen::Vector3d& place, int axis) {
    const GridCell cell(forward.geometry.size, forward.geometry.to_index(place));
    return cell.interpolate([&](std::size_t voxel) { return forward.voxels[voxel][static_cast<std::size_t>(axis)]; });
  });
  if (run.jacobian) {
    add_field(data, "ratio", 0.002, 1, grid, [&](auto& place, int) { return value_at(*run.jacobian, place); });
  }
  add_nodal(data, "error", run.solution->estimated_error, run, grid);
  add_nodal(data, "deviation", run.deviation, run, grid);
  const discretise::Scanlines body(*run.brain);
  const auto inside = [&body](const Eigen::Vector3d& place) { return body.inside(place); };
  data.arrays.push_back({"brain", packed_numbers(on_voxels<std::uint8_t>(grid, inside))});
}

// The rows of the matrix from voxel indices to places, and its inverse's.
json described_grid(const ImageGeometry& grid) {
  json forth = json::array(), back = json::array();
  const Eigen::Vector3d shift = -(grid.direction.transpose() * grid.origin).cwiseQuotient(grid.spacing);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      forth.push_back(grid.direction(row, column) * grid.spacing[column]);
      back.push_back(grid.direction(column, row) / grid.spacing[row]);
    }
    forth.push_back(grid.origin[row]);
    back.push_back(shift[row]);
  }
  return {{"size", {grid.size.x(), grid.size.y(), grid.size.z()}}, {"to_world", forth}, {"to_index", back}};
}

json described_colours(ColourMap map) {
  json list = json::array();
  std::ranges::copy(ColourScale{.map = map}.nodes(), std::back_inserter(list));
  return list;
}

}  // namespace

ViewerData viewer_data(const RunData& run, const View& view, std::size_t room) {
  const std::vector<double> focus(view.focus.data(), view.focus.data() + 3);
  const std::vector<double> inward(view.inward.data(), view.inward.data() + 3);
  ViewerData data{.facts = {{"focus", focus},
                            {"inward", inward},
                            {"largest", view.shift.high},
                            {"sequential", described_colours(ColourMap::sequential)},
                            {"diverging", described_colours(ColourMap::diverging)},
                            {"load", run.load},
                            {"uncertainty", run.uncertainty}}};
  const ImageGeometry& t1 = run.t1->geometry;
  const ImageGeometry fields = part_around(*run.brain, t1, (field_voxel / t1.spacing.array()).max(1));
  data.facts["fields"] = described_grid(fields);
  add_fields(data, run, fields);
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vertices = run.brain->vertices.cast<float>();
  const std::span<const float> places(vertices.data(), static_cast<std::size_t>(vertices.size()));
  const std::span<const std::int32_t> corners(run.brain->triangles.data(),
                                              static_cast<std::size_t>(run.brain->triangles.size()));
  data.arrays.push_back({"vertices", packed_numbers(places)});
  data.arrays.push_back({"triangles", packed_numbers(corners)});

  const std::size_t taken = letters_of(data.arrays);
  for (double longer = 1; data.facts["images"].is_null(); longer *= std::cbrt(2.0)) {
    const ImageGeometry grid = part_around(*run.brain, t1, Eigen::Array3d::Constant(longer));
    if (static_cast<double>(grid.voxel_count()) > most_voxels) {
      continue;
    }
    std::vector<PackedBytes> images = images_on(grid, run, view);
    if (taken + letters_of(images) <= room || grid.voxel_count() < least_voxels) {
      data.facts["images"] = described_grid(grid);
      std::ranges::move(images, std::back_inserter(data.arrays));
    }
  }
  return data;
}

std::size_t letters_of(const std::vector<PackedBytes>& all) {
  return std::accumulate(all.begin(), all.end(), std::size_t{0},
                         [](std::size_t sum, const PackedBytes& one) { return sum + one.text.size(); });
}

std::string packed(std::string_view bytes) {
  auto size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               static_cast<uLong>(bytes.size())) != Z_OK) {
    throw std::bad_alloc();
  }
  result.resize(size);
  return encode_base64(result);
}

}  // namespace brainshift::pipelines
