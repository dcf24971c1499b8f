// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/labels/segmentation_file.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "segmentation/files/refuse.hpp"
#include "segmentation/labels/label_table.hpp"

namespace brainshift::segmentation {
namespace {

namespace fs = std::filesystem;

// From the lowest to the one that lies over all others.
constexpr std::array<std::uint16_t, 6> order = {0,
                                                default_label::skull,
                                                default_label::parenchyma,
                                                default_label::csf,
                                                default_label::ventricles,
                                                default_label::tumour};

struct Known {
  std::uint16_t label;  ///< of the map that is made
  std::ptrdiff_t rank;
  std::size_t segment;
};

// Of one layer: by the number of a voxel.
using KnownNumbers = std::map<std::uint16_t, Known>;

// Voxels in which one segment lies over all others, and over which: the upper, the lower.
using Overlaps = std::map<std::pair<std::size_t, std::size_t>, std::size_t>;

std::vector<KnownNumbers> known_numbers(std::span<const Segment> segments, std::size_t layers, bool by_names) {
  std::vector<KnownNumbers> known(layers);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const std::uint16_t tissue = class_of_name(segments[s].name);
    const auto rank = std::find(order.begin(), order.end(), tissue) - order.begin();
    known[segments[s].layer][segments[s].label] = {by_names ? tissue : segments[s].label, rank, s};
  }
  return known;
}

std::string overlap_note(const fs::path& file, const Overlaps& overlaps, std::span<const Segment> segments,
                         const ImageGeometry& grid) {
  constexpr std::size_t most = 12;
  std::string text = file.string() + ": its segments overlap:";
  std::size_t told = 0;
  for (const auto& [pair, voxels] : overlaps) {
    if (++told > most) {
      text += " and others;";
      break;
    }
    text += " '" + segments[pair.first].name + "' lies over '" + segments[pair.second].name + "' in " +
            in_millilitres(static_cast<double>(voxels) * grid.voxel_volume()) + ";";
  }
  return text + " tumour lies over ventricles, fluid, brain and skull, in this order, else the later segment";
}

// Lays the segments over each other, voxel by voxel. unnamed: numbers of the map that no segment has, and how often.
LabelMap overlay(const std::vector<LabelMap>& layers, const std::vector<KnownNumbers>& known, Overlaps& overlaps,
                 std::map<std::uint16_t, std::size_t>& unnamed) {
  LabelMap map{layers.front().geometry, std::vector<std::uint16_t>(layers.front().voxels.size())};
  std::vector<Known> here;
  for (std::size_t i = 0; i < map.voxels.size(); ++i) {
    here.clear();
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      const std::uint16_t number = layers[layer].voxels[i];
      if (const auto found = known[layer].find(number); found != known[layer].end()) {
        here.push_back(found->second);
      } else if (number != 0) {
        ++unnamed[number];
      }
    }
    if (here.empty()) {
      continue;
    }
    const auto below = [](const Known& a, const Known& b) {
      return std::pair(a.rank, a.segment) < std::pair(b.rank, b.segment);
    };
    const Known top = *std::max_element(here.begin(), here.end(), below);
    map.voxels[i] = top.label;
    for (const Known& other : here) {
      if (other.segment != top.segment) {
        ++overlaps[{top.segment, other.segment}];
      }
    }
  }
  return map;
}

Overlaid overlaid(const fs::path& file, std::span<const Segment> segments, bool by_names) {
  const std::vector<LabelMap> layers = read_layers(file);
  Overlaps overlaps;
  std::map<std::uint16_t, std::size_t> unnamed;
  Overlaid result;
  result.map = overlay(layers, known_numbers(segments, layers.size(), by_names), overlaps, unnamed);
  if (!overlaps.empty()) {
    result.notes.push_back(overlap_note(file, overlaps, segments, result.map.geometry));
  }
  for (const auto& [number, voxels] : unnamed) {
    result.notes.push_back(file.string() + ": no segment has the number " + std::to_string(number) + "; its " +
                           in_millilitres(static_cast<double>(voxels) * result.map.geometry.voxel_volume()) +
                           " are left out");
  }
  return result;
}

// "parenchyma (Brain), tumour (Core, Oedema)".
std::string classes_of(std::span<const Segment> segments) {
  std::string text;
  for (std::size_t rank = order.size(); rank-- > 0;) {
    std::string of_class;
    for (const Segment& segment : segments) {
      if (class_of_name(segment.name) == order[rank]) {
        of_class += (of_class.empty() ? "" : ", ") + segment.name;
      }
    }
    if (!of_class.empty()) {
      const auto known = std::ranges::find(label_classes, order[rank], &LabelClass::number);
      text += std::string(text.empty() ? "" : ", ") + (known == label_classes.end() ? "not brain" : known->name) +
              " (" + of_class + ")";
    }
  }
  return text;
}

void check_numbers(const fs::path& file, std::span<const Segment> segments) {
  for (const Segment& one : segments) {
    for (const Segment& other : segments) {
      if (one.label == other.label && one.layer < other.layer) {
        refuse(file, "its segments '" + one.name + "' and '" + other.name + "' both have the number " +
                         std::to_string(one.label) +
                         "; name the segments after what they are (brain, ventricles, tumour) and leave numbers and "
                         "labels_are out, or export the segmentation as a label map");
      }
    }
  }
}

}  // namespace

bool names_tell(std::span<const Segment> segments) {
  return !segments.empty() && std::all_of(segments.begin(), segments.end(),
                                          [](const Segment& segment) { return name_tells_class(segment.name); });
}

Overlaid read_by_names(const fs::path& file) {
  const auto segments = read_segments(file);
  Overlaid result = overlaid(file, segments, true);
  result.notes.insert(result.notes.begin(), file.string() + ": by their names its segments are taken for " +
                                                classes_of(segments) + "; rename one that is something else");
  return result;
}

Overlaid read_by_numbers(const fs::path& file) {
  const auto segments = read_segments(file);
  const bool overlap = std::any_of(segments.begin(), segments.end(), [](const Segment& s) { return s.layer > 0; });
  if (!overlap) {
    return {read_label_map(file), {}};
  }
  check_numbers(file, segments);
  return overlaid(file, segments, false);
}

}  // namespace brainshift::segmentation
