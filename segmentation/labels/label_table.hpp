// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "segmentation/image/image.hpp"
#include "segmentation/interface/options.hpp"

namespace brainshift::segmentation {

/// A class of default_label, and its name.
struct LabelClass {
  std::uint16_t number;
  const char* name;
};
inline constexpr std::array<LabelClass, 6> label_classes = {{{default_label::parenchyma, "parenchyma"},
                                                             {default_label::ventricles, "ventricles"},
                                                             {default_label::tumour, "tumour"},
                                                             {default_label::csf, "fluid"},
                                                             {default_label::skull, "skull"},
                                                             {default_label::skin, "skin"}}};
/// Those of the brain, and those with the skull and the fluid in it.
inline constexpr std::span<const LabelClass> brain_classes(label_classes.data(), 3);
inline constexpr std::span<const LabelClass> classes_in_skull(label_classes.data(), 5);

/// What the numbers of a label map stand for: a class of default_label, or 0 for what is not brain.
struct LabelTable {
  std::string name;  ///< as a sentence calls it: "FreeSurfer's"
  std::map<std::uint16_t, std::uint16_t> classes;
};

/// Of FreeSurfer's aseg and aparc+aseg, which FastSurfer and SynthSeg write, too.
const LabelTable& freesurfer_table();

/// Of the BraTS challenge: core and enhancing tumour; oedema (2) is parenchyma. The healthy brain has no number in it.
const LabelTable& brats_table();

/// Names that find_label_table() takes in place of a file.
const std::vector<std::string>& label_table_names();

/// Of a file: lines `number name ...` (FreeSurferColorLUT.txt, 3D Slicer's .ctbl) or `number ... "name"` (ITK-SNAP),
/// tab-separated columns `index` and `name` (BIDS _dseg.tsv) or `ID` and `LabelName` (FastSurfer), or the segments of a
/// .seg.nrrd. The class follows from the words in the name: ventricle, CSF, skull, tumour, background and so on; any
/// other name is parenchyma. 0 is background, whatever its name. Throws std::invalid_argument, naming file and line,
/// when it is no such table or names a number twice.
LabelTable read_label_table(const std::filesystem::path& file);

/// The class that the words in a tissue's name tell, in upper or lower case; parenchyma where they tell none. A word
/// ends where its letters do, or where a capital begins another: "LateralVentricles", "CSFSpace".
std::uint16_t class_of_name(const std::string& name);

/// Whether a name says anything: "Segment_1", as 3D Slicer names what nobody named, does not.
bool name_tells_class(const std::string& name);

/// By name ("freesurfer", "brats") or from a file.
LabelTable find_label_table(const std::string& name_or_file);

/// "12.7 ml" of a volume in mm³.
std::string in_millilitres(double volume);

/// Volume of each number of a label map but 0, mm³.
using LabelVolumes = std::map<std::uint16_t, double>;
LabelVolumes label_volumes(const LabelMap& labels);

/// Whether the numbers are FreeSurfer's beyond doubt: many of its structures, none of the numbers that it leaves out.
bool is_freesurfer(const LabelVolumes& volumes);

/// The map with other numbers; a number without an entry stays, or becomes 0.
enum class Unnamed { stay, become_background };
void renumber(LabelMap& labels, const std::map<std::uint16_t, std::uint16_t>& numbers, Unnamed unnamed);

/// "136 (1.4 ml), 137 (0.2 ml)" of the numbers that a table lacks, the largest first; empty where it has them all.
std::string unknown_labels(const LabelVolumes& volumes, const LabelTable& table);

/// Numbers, not among those of the brain, whose voxels border on these alone. brain: its keys are the brain's numbers.
std::vector<std::uint16_t> enclosed_labels(const LabelMap& labels, const std::map<std::uint16_t, std::uint16_t>& brain);

}  // namespace brainshift::segmentation
