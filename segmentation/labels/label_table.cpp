// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/label_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <sstream>

#include "segmentation/image/voxels.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {
namespace {

constexpr std::size_t all_numbers = 65536;

struct Numbers {
  std::uint16_t first;
  std::uint16_t last;
};

void add(LabelTable& table, std::span<const Numbers> ranges, std::uint16_t tissue) {
  for (const auto& [first, last] : ranges) {
    for (int number = first; number <= last; ++number) {
      table.classes[static_cast<std::uint16_t>(number)] = tissue;
    }
  }
}

LabelTable make_freesurfer() {
  constexpr Numbers parenchyma[] = {{2, 3},   {7, 8},     {10, 13},     {16, 18},     {25, 28},      {30, 30},
                                    {41, 42}, {46, 47},   {49, 54},     {57, 60},     {62, 62},      {77, 80},
                                    {85, 85}, {251, 255}, {1000, 2035}, {3000, 5002}, {11100, 12175}};
  constexpr Numbers ventricles[] = {{4, 5}, {14, 15}, {31, 31}, {43, 44}, {63, 63}, {72, 72}, {213, 213}, {221, 221}};
  constexpr Numbers fluid[] = {{24, 24}, {257, 257}};
  constexpr Numbers skull[] = {{165, 165}};
  LabelTable table{"FreeSurfer's", {}};
  add(table, parenchyma, default_label::parenchyma);
  add(table, ventricles, default_label::ventricles);
  add(table, fluid, default_label::csf);
  add(table, skull, default_label::skull);
  return table;
}

LabelTable make_brats() {
  LabelTable table{"those of BraTS", {}};
  for (const int number : {1, 3, 4}) {
    table.classes[static_cast<std::uint16_t>(number)] = default_label::tumour;
  }
  table.classes[2] = default_label::parenchyma;
  return table;
}

}  // namespace

std::string in_millilitres(double volume) {
  std::ostringstream text;
  text << std::round(volume / 100) / 10 << " ml";
  return text.str();
}

const LabelTable& freesurfer_table() {
  static const LabelTable table = make_freesurfer();
  return table;
}

const LabelTable& brats_table() {
  static const LabelTable table = make_brats();
  return table;
}

const std::vector<std::string>& label_table_names() {
  static const std::vector<std::string> names = {"brats", "freesurfer"};
  return names;
}

LabelTable find_label_table(const std::string& name_or_file) {
  if (name_or_file == "freesurfer") {
    return freesurfer_table();
  }
  return name_or_file == "brats" ? brats_table() : read_label_table(name_or_file);
}

LabelVolumes label_volumes(const LabelMap& labels) {
  std::vector<std::size_t> counts(all_numbers);
  for (const std::uint16_t number : labels.voxels) {
    ++counts[number];
  }
  LabelVolumes volumes;
  for (std::size_t number = 1; number < all_numbers; ++number) {
    if (counts[number] > 0) {
      volumes[static_cast<std::uint16_t>(number)] =
          static_cast<double>(counts[number]) * labels.geometry.voxel_volume();
    }
  }
  return volumes;
}

bool is_freesurfer(const LabelVolumes& volumes) {
  constexpr std::array structures = {2,  4,  7,  8,  10, 11, 12, 13, 16, 17, 18,  28, 41,
                                     43, 46, 47, 49, 50, 51, 52, 53, 54, 60, 251, 255};
  constexpr Numbers left_out[] = {{1, 1}, {6, 6}, {9, 9}, {19, 23}, {32, 40}, {45, 45}, {48, 48}, {55, 56}, {61, 61}};
  constexpr int enough = 8;
  const auto found = std::count_if(structures.begin(), structures.end(),
                                   [&](int number) { return volumes.contains(static_cast<std::uint16_t>(number)); });
  const bool cortex = volumes.contains(3) || volumes.contains(42) ||
                      std::any_of(volumes.begin(), volumes.end(), [](const auto& v) { return v.first >= 1000; });
  return found >= enough && cortex && std::none_of(std::begin(left_out), std::end(left_out), [&](const Numbers& gap) {
           const auto next = volumes.lower_bound(gap.first);
           return next != volumes.end() && next->first <= gap.last;
         });
}

void renumber(LabelMap& labels, const std::map<std::uint16_t, std::uint16_t>& numbers, Unnamed unnamed) {
  std::vector<std::uint16_t> becomes(all_numbers);
  if (unnamed == Unnamed::stay) {
    std::iota(becomes.begin(), becomes.end(), std::uint16_t{0});
  }
  for (const auto& [from, to] : numbers) {
    becomes[from] = to;
  }
  for (std::uint16_t& voxel : labels.voxels) {
    voxel = becomes[voxel];
  }
}

std::string unknown_labels(const LabelVolumes& volumes, const LabelTable& table) {
  std::vector<std::pair<double, std::uint16_t>> unknown;
  for (const auto& [number, volume] : volumes) {
    if (!table.classes.contains(number)) {
      unknown.emplace_back(-volume, number);
    }
  }
  std::sort(unknown.begin(), unknown.end());
  constexpr std::size_t most = 30;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, unknown.size()); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(unknown[i].second) + " (" + in_millilitres(-unknown[i].first) + ")";
  }
  return unknown.size() > most ? text + " and " + std::to_string(unknown.size() - most) + " more" : text;
}

std::vector<std::uint16_t> enclosed_labels(const LabelMap& labels,
                                           const std::map<std::uint16_t, std::uint16_t>& brain) {
  std::vector<std::uint8_t> touches_brain(all_numbers), touches_else(all_numbers);
  const auto note_face = [&](std::uint16_t number, std::uint16_t beside) {
    if (number != beside) {
      (brain.contains(beside) ? touches_brain : touches_else)[number] = 1;
    }
  };
  const Eigen::Array3i size = labels.geometry.size;
  for_each_voxel(size, [&](int i, int j, int k) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Array3i next(i, j, k);
      if (++next[axis] < size[axis]) {
        const std::uint16_t here = labels.at(i, j, k), there = labels.at(next.x(), next.y(), next.z());
        note_face(here, there);
        note_face(there, here);
      }
    }
  });
  std::vector<std::uint16_t> enclosed;
  for (std::size_t number = 1; number < all_numbers; ++number) {
    if (touches_brain[number] != 0 && touches_else[number] == 0 &&
        !brain.contains(static_cast<std::uint16_t>(number))) {
      enclosed.push_back(static_cast<std::uint16_t>(number));
    }
  }
  return enclosed;
}

}  // namespace brainshift::segmentation
