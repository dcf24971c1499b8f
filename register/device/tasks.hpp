// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "register/device/resample.hpp"
#include "register/device/view.hpp"
#include "register/field/invert_at.hpp"
#include "register/field/outside.hpp"

namespace brainshift::registration::device {

/// What a device does, each for many items that know nothing of each other.
enum class Task : std::uint8_t {
  part,         ///< of each voxel: which Part it is
  evaluate,     ///< the solver's displacement near the brain; an item a voxel, by Tiles
  grow,         ///< the same of the voxels that are left
  extend,       ///< to the fading voxels: from `field` into `next`
  smooth,       ///< one sweep outside: from `field` into `next`
  fade,         ///< outside
  invert,       ///< rows of voxels
  warp_image,   ///< linear
  warp_labels,  ///< nearest
};

BRAINSHIFT_ON_DEVICE inline std::int32_t count_up(std::int32_t& counter, std::int32_t by) {
#ifdef __CUDA_ARCH__
  return atomicAdd(&counter, by);
#else
  const std::int32_t before = counter;
  counter += by;
  return before;
#endif
}

/// Voxels in boxes of 8 × 4 × 4, 128 to a box: items next to each other see the same nodes.
struct Tiles {
  Eigen::Array3i size, tiles;

  BRAINSHIFT_ON_DEVICE explicit Tiles(const Eigen::Array3i& of)
      : size(of), tiles((of[0] + 7) / 8, (of[1] + 3) / 4, (of[2] + 3) / 4) {}
  BRAINSHIFT_ON_DEVICE std::size_t items() const {
    return 128 * static_cast<std::size_t>(tiles[0]) * static_cast<std::size_t>(tiles[1]) *
           static_cast<std::size_t>(tiles[2]);
  }
  /// Of an item: a voxel, or a place beyond the image.
  BRAINSHIFT_ON_DEVICE Eigen::Array3i place(std::size_t item) const {
    const auto in = static_cast<int>(item % 128), tile = static_cast<int>(item / 128);
    const int row = tile / tiles[0];
    return {8 * (tile % tiles[0]) + in % 8, 4 * (row % tiles[1]) + in / 8 % 4, 4 * (row / tiles[1]) + in / 32};
  }
  BRAINSHIFT_ON_DEVICE bool holds(const Eigen::Array3i& place) const { return (place < size).all(); }
};

/// How many items there are; of Task::grow: how many voxels are left.
inline std::size_t items(Task task, const View& view, std::int32_t left = 0) {
  switch (task) {
    case Task::evaluate:
      return Tiles(view.grid.size).items();
    case Task::grow:
      return static_cast<std::size_t>(left);
    case Task::invert:
      return static_cast<std::size_t>(view.grid.size[1]) * static_cast<std::size_t>(view.grid.size[2]);
    default:
      return view.grid.count();
  }
}

BRAINSHIFT_ON_DEVICE inline std::uint8_t part_of(const View& view, std::size_t offset) {
  const Zone zone = view.zone[offset];
  if (zone == Zone::beyond || zone == Zone::fading) {
    return zone == Zone::fading ? Part::outside : std::uint8_t{0};
  }
  const Eigen::Vector3d x = view.grid.world(view.grid.place(offset));
  const bool outside = zone == Zone::shell && view.outside.value(x) > view.reach;
  const bool hollow = view.wall.sample != nullptr && zone != Zone::brain && view.wall.value(x) < -view.reach;
  return static_cast<std::uint8_t>((hollow ? Part::hollow : Part::near) | (outside ? Part::outside : 0));
}

BRAINSHIFT_ON_DEVICE inline Eigen::Vector3d place_of(const View& view, const Eigen::Array3i& at, std::size_t offset) {
  const Eigen::Vector3d x = view.grid.world(at);
  return view.zone[offset] == Zone::shell ? place_in_shell(view.outside, x, view.reach) : x;
}

BRAINSHIFT_ON_DEVICE inline void evaluate(const View& view, std::size_t item) {
  const Tiles tiles(view.grid.size);
  const Eigen::Array3i at = tiles.place(item);
  if (!tiles.holds(at)) {
    return;
  }
  const std::size_t offset = view.grid.offset(at);
  if ((view.part[offset] & Part::near) == 0) {
    return;
  }
  Eigen::Vector3d u;
  if (displacement_at(view.nodes, view.rules, place_of(view, at, offset), u)) {
    view.field[offset] = stored(u);
  } else {
    view.left[count_up(view.counts->left, 1)] = static_cast<std::int32_t>(offset);
  }
}

BRAINSHIFT_ON_DEVICE inline void grow(const View& view, std::size_t item) {
  const auto offset = static_cast<std::size_t>(view.left[item]);
  Eigen::Vector3d u;
  if (displacement_by_growth(view.nodes, view.rules, place_of(view, view.grid.place(offset), offset), u)) {
    view.field[offset] = stored(u);
  } else {
    view.left[item] = -1 - view.left[item];
    count_up(view.counts->lost, 1);
  }
}

BRAINSHIFT_ON_DEVICE inline FieldGrid field_grid(const View& view) {
  return {view.grid.size, view.grid.origin, view.grid.index_from_world, view.field};
}

BRAINSHIFT_ON_DEVICE inline void extend(const View& view, std::size_t offset) {
  if (view.zone[offset] == Zone::fading) {
    const FieldGrid field = field_grid(view);
    const Eigen::Vector3d x = view.grid.world(view.grid.place(offset));
    const Eigen::Vector3d u = field.value(field.to_index(place_at_reach(view.outside, x, view.reach)));
    view.next[offset] = {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])};
  }
}

BRAINSHIFT_ON_DEVICE inline void smooth(const View& view, std::size_t offset) {
  if ((view.part[offset] & Part::outside) != 0) {
    const Neighbourhood around{view.grid.size, view.grid.spacing, view.zone, view.field};
    view.next[offset] = mean_of_neighbours(around, view.grid.place(offset), offset);
  }
}

BRAINSHIFT_ON_DEVICE inline void fade(const View& view, std::size_t offset) {
  if ((view.part[offset] & Part::outside) != 0) {
    const double distance = view.outside.value(view.grid.world(view.grid.place(offset)));
    view.field[offset] = faded(view.field[offset], distance, view.reach, view.fade);
  }
}

BRAINSHIFT_ON_DEVICE inline void invert(const View& view, std::size_t row) {
  const auto ny = static_cast<std::size_t>(view.grid.size[1]);
  const auto store = [&](std::size_t offset, const Displacement& d) { view.resampling[offset] = d; };
  const std::size_t missed =
      invert_row(field_grid(view), static_cast<int>(row % ny), static_cast<int>(row / ny), view.tolerance, store);
  if (missed > 0) {
    count_up(view.counts->not_inverted, static_cast<std::int32_t>(missed));
  }
}

/// Does an item.
template <Task task>
BRAINSHIFT_ON_DEVICE void perform(const View& view, std::size_t item) {
  if constexpr (task == Task::part) {
    view.part[item] = part_of(view, item);
  } else if constexpr (task == Task::evaluate) {
    evaluate(view, item);
  } else if constexpr (task == Task::grow) {
    grow(view, item);
  } else if constexpr (task == Task::extend) {
    extend(view, item);
  } else if constexpr (task == Task::smooth) {
    smooth(view, item);
  } else if constexpr (task == Task::fade) {
    fade(view, item);
  } else if constexpr (task == Task::invert) {
    invert(view, item);
  } else if constexpr (task == Task::warp_image) {
    view.warped[item] =
        resampled(view.grid, view.resampling, view.image, item,
                  [](const VoxelGrid& g, const float* v, const Eigen::Vector3d& x) { return interpolated(g, v, x); });
  } else {
    view.warped_labels[item] = resampled(
        view.grid, view.resampling, view.labels, item,
        [](const VoxelGrid& g, const std::uint16_t* v, const Eigen::Vector3d& x) { return nearest(g, v, x); });
  }
}

/// Calls use.template operator()<task>() of a task that is known when the program runs.
template <class Use>
void with_task(Task task, const Use& use) {
  switch (task) {
    case Task::part:
      return use.template operator()<Task::part>();
    case Task::evaluate:
      return use.template operator()<Task::evaluate>();
    case Task::grow:
      return use.template operator()<Task::grow>();
    case Task::extend:
      return use.template operator()<Task::extend>();
    case Task::smooth:
      return use.template operator()<Task::smooth>();
    case Task::fade:
      return use.template operator()<Task::fade>();
    case Task::invert:
      return use.template operator()<Task::invert>();
    case Task::warp_image:
      return use.template operator()<Task::warp_image>();
    case Task::warp_labels:
      return use.template operator()<Task::warp_labels>();
  }
}

}  // namespace brainshift::registration::device
