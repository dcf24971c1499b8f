// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/field/forward_field.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "register/field/field_sampler.hpp"
#include "register/field/outside.hpp"
#include "register/field/span_cavity.hpp"
#include "solve/output/solution_file.hpp"
#include "solve/shape/shape_functions.hpp"

namespace brainshift::registration {

namespace {

constexpr std::size_t chunk = 1 << 19;  // voxels evaluated between two reports of progress

using Displacement = std::array<float, 3>;

using Voxel = FieldVoxel;
using Run = FieldRun;

/// In the order of their offsets.
template <class Wanted>
std::vector<Voxel> voxels_where(const ImageGeometry& geometry, const Wanted& wanted) {
  std::vector<std::vector<Voxel>> layers(static_cast<std::size_t>(geometry.size.z()));
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < geometry.size.z(); ++k) {
    for (int j = 0; j < geometry.size.y(); ++j) {
      for (int i = 0; i < geometry.size.x(); ++i) {
        const Voxel voxel{i, j, k, geometry.offset(i, j, k)};
        if (wanted(voxel)) {
          layers[static_cast<std::size_t>(k)].push_back(voxel);
        }
      }
    }
  }
  std::vector<Voxel> voxels;
  for (const std::vector<Voxel>& layer : layers) {
    voxels.insert(voxels.end(), layer.begin(), layer.end());
  }
  return voxels;
}

double distance_at(const BrainZones& zones, const ImageGeometry& geometry, const Voxel& voxel) {
  return zones.outside.value(geometry.to_world(voxel.index()));
}

/// Where the displacement of a voxel of brain or shell is taken.
Eigen::Vector3d place_of(const BrainZones& zones, const ImageGeometry& geometry, const Voxel& voxel, double reach) {
  const Eigen::Vector3d place = geometry.to_world(voxel.index());
  return zones.zone[voxel.offset] == Zone::shell ? place_in_shell(zones.outside.grid(), place, reach) : place;
}

/// The solver's field at the voxels of brain and shell. told: the places are known where it is asked.
void evaluate(const DisplacementAt& displacement_at, const BrainZones& zones, const std::vector<Voxel>& voxels,
              double reach, bool told, VectorImage& field, const Progress& progress) {
  for (std::size_t begin = 0; begin < voxels.size(); begin += chunk) {
    report(progress, 0.8 * static_cast<double>(begin) / static_cast<double>(voxels.size()),
           "displacement at the voxels");
    const std::size_t end = std::min(begin + chunk, voxels.size());
    Points places(static_cast<Eigen::Index>(end - begin), 3);
    if (!told) {
#pragma omp parallel for schedule(static)
      for (std::size_t v = begin; v < end; ++v) {
        places.row(static_cast<Eigen::Index>(v - begin)) = place_of(zones, field.geometry, voxels[v], reach);
      }
    }
    const Points displacement = displacement_at(places);
#pragma omp parallel for schedule(static)
    for (std::size_t v = begin; v < end; ++v) {
      field.voxels[voxels[v].offset] = stored(displacement.row(static_cast<Eigen::Index>(v - begin)));
    }
  }
}

/// Numbers of voxels that are kept from field to field, or found each time.
template <class Value>
class Kept {
 public:
  /// values: as many as voxels where they are known; null: they are not kept.
  Kept(std::vector<Value>* values, std::size_t voxels)
      : values_(values), known_(values != nullptr && values->size() == voxels) {
    if (values_ != nullptr) {
      values_->resize(voxels);
    }
  }
  /// Of different voxels on many threads.
  template <class Find>
  Value of(std::size_t voxel, const Find& find) const {
    if (values_ == nullptr) {
      return find();
    }
    Value& value = (*values_)[voxel];
    return known_ ? value : value = find();
  }

 private:
  std::vector<Value>* values_;
  bool known_;
};

/// Gives the fading voxels the displacement of the brain near by.
void extend(const BrainZones& zones, const std::vector<Voxel>& fading, double reach,
            std::vector<Eigen::Vector3d>* taken_from, VectorImage& field) {
  const FieldSampler sampler(field);
  std::vector<Displacement> extended(fading.size());
  const Kept kept(taken_from, fading.size());
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t v = 0; v < fading.size(); ++v) {
    const Eigen::Vector3d place = kept.of(v, [&] {
      const Eigen::Vector3d x = field.geometry.to_world(fading[v].index());
      return sampler.to_index(place_at_reach(zones.outside.grid(), x, reach));
    });
    const Eigen::Vector3f u = sampler.value(place).cast<float>();
    extended[v] = {u.x(), u.y(), u.z()};
  }
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < fading.size(); ++v) {
    field.voxels[fading[v].offset] = extended[v];
  }
}

std::vector<Run> runs_of(const std::vector<Voxel>& voxels, const BrainZones& zones, const ImageGeometry& g) {
  const std::size_t stride[3] = {1, g.offset(0, 1, 0), g.offset(0, 0, 1)};
  const auto is_inner = [&](const Voxel& v) {
    const Eigen::Array3i place(v.i, v.j, v.k);
    return (place > 0).all() && (place + 1 < g.size).all() &&
           std::all_of(std::begin(stride), std::end(stride), [&](std::size_t step) {
             return zones.zone[v.offset - step] != Zone::beyond && zones.zone[v.offset + step] != Zone::beyond;
           });
  };
  std::vector<Run> runs;
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    const bool inner = is_inner(voxels[v]);
    if (!runs.empty() && runs.back().inner == inner && voxels[v].offset == voxels[v - 1].offset + 1) {
      ++runs.back().count;
    } else {
      runs.push_back({v, 1, inner});
    }
  }
  return runs;
}

/// mean_of_neighbours() of a run of inner voxels, number by number, as a compiler can vectorise it.
void mean_along_run(const VectorImage& field, std::size_t first, std::size_t count, Displacement* mean) {
  const ImageGeometry& g = field.geometry;
  const std::size_t y = 3 * g.offset(0, 1, 0), z = 3 * g.offset(0, 0, 1);
  const Eigen::Array3f weight = g.spacing.array().square().inverse().cast<float>();
  const float total = weight[0] + weight[0] + weight[1] + weight[1] + weight[2] + weight[2];
  const float* const u = field.voxels.front().data() + 3 * first;
  float* const result = mean->data();
  for (std::size_t n = 0; n < 3 * count; ++n) {
    const float along_x = weight[0] * *(u + n - 3) + weight[0] * u[n + 3];
    result[n] =
        (along_x + weight[1] * *(u + n - y) + weight[1] * u[n + y] + weight[2] * *(u + n - z) + weight[2] * u[n + z]) /
        total;
  }
}

/// Smooths the displacement outside where two parts of the surface are equally near and it would jump; all other voxels
/// are held.
void smooth(const BrainZones& zones, const std::vector<Voxel>& outside, const std::vector<Run>& runs,
            VectorImage& field) {
  const double sweeps = smoothing_sweeps(field.geometry.spacing);
  const Neighbourhood around{field.geometry.size, field.geometry.spacing, zones.zone.data(), field.voxels.data()};
  std::vector<Displacement> next(outside.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto [first, count, inner] = runs[r];
      if (inner) {
        mean_along_run(field, outside[first].offset, count, &next[first]);
        continue;
      }
      for (std::size_t v = first; v < first + count; ++v) {
        const Voxel& at = outside[v];
        next[v] = mean_of_neighbours(around, {at.i, at.j, at.k}, at.offset);
      }
    }
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto [first, count, inner] = runs[r];
      std::copy_n(&next[first], count, &field.voxels[outside[first].offset]);
    }
  }
}

void fade_out(const BrainZones& zones, const std::vector<Voxel>& outside, std::vector<double>* distances, double reach,
              double fade, VectorImage& field) {
  const Kept kept(distances, outside.size());
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < outside.size(); ++v) {
    const double distance = kept.of(v, [&] { return distance_at(zones, field.geometry, outside[v]); });
    Displacement& u = field.voxels[outside[v].offset];
    u = faded(u, distance, reach, fade);
  }
}

std::vector<std::size_t> offsets_of(const std::vector<Voxel>& voxels) {
  std::vector<std::size_t> offsets;
  for (const Voxel& voxel : voxels) {
    offsets.push_back(voxel.offset);
  }
  return offsets;
}

}  // namespace

VectorImage forward_field(const Solution& solution, const BrainZones& zones, const ImageGeometry& geometry, double fade,
                          const Progress& progress) {
  const solve::ShapeFunctions shape = shape_functions(solution);
  const Points parameters = solve::parameters_from_displacement(shape, solution.positions, solution.displacement);
  return forward_field([&](const Points& places) { return shape.interpolate(places, parameters); },
                       least_spacing(solution.spacing), zones, geometry, fade, progress);
}

VectorImage forward_field(const DisplacementAt& displacement_at, double spacing, const BrainZones& zones,
                          const ImageGeometry& geometry, double fade, const Progress& progress, FieldPlan* plan) {
  VectorImage field{geometry, std::vector<Displacement>(geometry.voxel_count(), Displacement{0, 0, 0})};
  const double reach = reach_of(zones.shell, spacing);
  const auto in = [&](Zone wanted) { return [&, wanted](const Voxel& v) { return zones.zone[v.offset] == wanted; }; };
  const auto hollow = [&](const Voxel& v) {
    return zones.wall && (in(Zone::cavity)(v) || in(Zone::shell)(v)) &&
           zones.wall->value(geometry.to_world(v.index())) < -reach;
  };
  const auto near = [&](const Voxel& v) {
    return (in(Zone::brain)(v) || in(Zone::shell)(v) || in(Zone::cavity)(v)) && !hollow(v);
  };
  FieldPlan own;
  FieldPlan& p = plan != nullptr ? *plan : own;
  const bool known = !p.inside.empty();
  if (!known) {
    p.inside = voxels_where(geometry, near);
  }
  evaluate(displacement_at, zones, p.inside, reach, known, field, progress);
  own = {};  // and its memory
  if (zones.wall) {
    span_cavity(
        offsets_of(voxels_where(geometry, hollow)), [&](std::size_t voxel) { return zones.zone[voxel] >= Zone::shell; },
        field);
  }
  report(progress, 0.8, "fading outside the brain");
  if (!known) {
    p.fading = voxels_where(geometry, in(Zone::fading));
  }
  extend(zones, p.fading, reach, plan != nullptr ? &p.taken_from : nullptr, field);
  if (!known) {
    p.outside = voxels_where(geometry, [&](const Voxel& v) {
      return in(Zone::fading)(v) || (in(Zone::shell)(v) && distance_at(zones, geometry, v) > reach);
    });
    p.runs = runs_of(p.outside, zones, geometry);
  }
  smooth(zones, p.outside, p.runs, field);
  fade_out(zones, p.outside, plan != nullptr ? &p.distance : nullptr, reach, fade, field);
  return field;
}

}  // namespace brainshift::registration
