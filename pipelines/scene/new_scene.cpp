// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/new_scene.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "pipelines/scene/scene_labels.hpp"
#include "pipelines/scene/tissue_table.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/surface_file.hpp"
#include "segmentation/files/whole_path.hpp"
#include "segmentation/image/image_ending.hpp"
#include "segmentation/interface/options.hpp"
#include "segmentation/labels/label_table.hpp"
#include "segmentation/labels/segmentation_file.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
namespace sg = segmentation;
namespace own = segmentation::default_label;

constexpr double least_brain = 300e3;  // mm³; a tumour is smaller, the parenchyma of a brain larger

std::string in_whole_millilitres(double volume) {
  return std::to_string(std::lround(volume / 1000)) + " ml";
}

/// Zeros around a brain or a head that was cut out. Which of the two does not show: both may hold 1.5 l.
bool has_empty_background(const ScalarImage& t1) {
  const auto zeros = std::count(t1.voxels.begin(), t1.voxels.end(), 0.0F);
  return 2 * static_cast<std::size_t>(zeros) > t1.voxels.size();
}

/// A table that lies beside a label map under the map's name: of BIDS, or of 3D Slicer. Empty without one.
fs::path table_beside(const fs::path& labels) {
  std::string stem = labels.string();
  stem.resize(stem.size() - image_ending(labels).size());
  for (const char* ending : {".tsv", ".ctbl", "_ColorTable.ctbl"}) {
    std::error_code unknown;
    if (fs::is_regular_file(stem + ending, unknown)) {
      return stem + ending;
    }
  }
  return {};
}

bool is_table_name(const std::string& text) {
  return std::ranges::find(sg::label_table_names(), text) != sg::label_table_names().end();
}

class Writer {
 public:
  explicit Writer(const FilesAtHand& files) : files_(files) {}

  NewScene write() {
    look_at_images();
    xml_.OpenElement("scene");
    xml_.PushAttribute("version", "1");
    write_image();
    write_tissues();
    write_load();
    xml_.OpenElement("contact");
    xml_.CloseElement();
    xml_.CloseElement();
    return {comments() + xml_.CStr() + "\n", std::move(taken_)};
  }

 private:
  void look_at_images() {
    if (!files_.labels.empty() && !files_.brain_mask.empty()) {
      throw std::invalid_argument("give --labels or --brain-mask, not both: " + files_.labels.string() + " or " +
                                  files_.brain_mask.string());
    }
    if (files_.labels.empty() && !files_.labels_are.empty()) {
      throw std::invalid_argument("--labels-are says what the numbers of a label map are; give the map by --labels");
    }
    mask_ = files_.brain_mask;
    if (!files_.t1.empty()) {
      look_at_t1();
    }
    if (!files_.labels.empty()) {
      look_at_labels();
    }
    if (files_.labels.empty() && mask_.empty()) {
      throw std::invalid_argument(
          (files_.t1.empty() ? "no image is given" : files_.t1.string() + ": says not which voxels are brain") +
          "; give --labels, a label map such as FreeSurfer's aseg.mgz, or --brain-mask");
    }
    if (files_.t1.empty() && files_.labels.empty()) {
      refuse(mask_, "a brain mask says not what the tissues are; give the T1 as well, by --t1");
    }
    if (!files_.tumour.empty()) {
      const auto volumes = sg::label_volumes(read_label_map(files_.tumour));
      double volume = 0;
      for (const auto& [number, part] : volumes) {
        volume += part;
      }
      take(files_.tumour, "a tumour's map of " + in_whole_millilitres(volume) +
                              (volumes.contains(2) && volumes.size() > 1 ? ", whose number 2 is oedema" : ""));
    }
  }

  void look_at_t1() {
    const ScalarImage t1 = read_image(files_.t1);
    take(files_.t1, "the T1, " + described(t1.geometry));
    if (has_empty_background(t1) && files_.labels.empty() && mask_.empty()) {
      refuse(files_.t1,
             "says not which voxels are brain, and no label map is given; it is 0 outside: if it is without "
             "its skull, give it a second time, as --brain-mask, else a mask of the brain");
    }
  }

  /// Of a map whose numbers a table tells, or whose segments have names.
  void look_at_classes(const ImageInputs& image, const std::string& table) {
    const auto volumes = sg::label_volumes(read_labels(image, {.by_class = true, .joined = {}}).map);
    std::string classes;
    for (const auto& [label, name] : sg::classes_in_skull) {
      if (const auto found = volumes.find(label); found != volumes.end()) {
        classes += std::string(classes.empty() ? "" : ", ") + name + " " + in_whole_millilitres(found->second);
      }
    }
    take(files_.labels, "a label map " + table + ": " + classes);
  }

  void look_at_labels() {
    ImageInputs image;
    image.labels = files_.labels;
    image.labels_are = files_.labels_are.empty() ? table_beside(files_.labels).string() : files_.labels_are;
    labels_are_ = image.labels_are;
    if (!labels_are_.empty()) {
      look_at_classes(image, "whose numbers are those of " + labels_are_);
      return;
    }
    if (sg::names_tell(read_segments(files_.labels))) {
      look_at_classes(image, "of 3D Slicer, by the names of its segments");
      return;
    }
    volumes_ = sg::label_volumes(sg::read_by_numbers(files_.labels).map);
    if (sg::is_freesurfer(volumes_)) {
      take(files_.labels, "a label map in FreeSurfer's numbers (" + std::to_string(volumes_.size()) + " of them)");
      labels_are_ = "freesurfer";
      return;
    }
    const bool small_numbers =
        !volumes_.empty() && volumes_.begin()->first > 0 && volumes_.rbegin()->first <= own::skin;
    const auto brain = volumes_.find(own::parenchyma);
    const bool of_a_head = volumes_.contains(own::skull) || volumes_.contains(own::skin);
    own_ = small_numbers && brain != volumes_.end() && (of_a_head || brain->second >= least_brain);
    if (!own_) {
      refuse(files_.labels, small_numbers ? "holds no brain, but maybe a tumour; give it as --tumour, and a label map "
                                            "of the brain or a brain mask"
                                          : "its numbers are not FreeSurfer's; give --labels-are with a table of "
                                            "them, or write a scene with a <tissue labels=...> for each tissue");
    }
    constexpr double largest_ventricles = 250e3;  // mm³; segmentations with 1 grey and 2 white matter have more there
    if (const auto found = volumes_.find(own::ventricles);
        found != volumes_.end() && found->second > largest_ventricles) {
      refuse(files_.labels, "its label 2 holds " + in_whole_millilitres(found->second) +
                                ", rare for ventricles and usual for white matter, so its numbers may be others than "
                                "the program's own; give --labels-are with a table of them");
    }
    take(files_.labels,
         "a label map with 1 parenchyma, 2 ventricles, 3 tumour, 4 fluid, 5 skull, 6 skin; correct the "
         "tissues if it is another");
  }

  void write_image() {
    xml_.OpenElement("image");
    for (const auto& [name, file] : {std::pair<const char*, const fs::path&>("t1", files_.t1),
                                     {"labels", files_.labels},
                                     {"brain_mask", mask_},
                                     {"tumour", files_.tumour}}) {
      push_file(name, file);
    }
    if (is_table_name(labels_are_)) {
      xml_.PushAttribute("labels_are", labels_are_.c_str());
    } else {
      push_file("labels_are", labels_are_);
    }
    if (own_ && volumes_.contains(own::skull)) {
      xml_.PushAttribute("skull_label", int{own::skull});
    }
    xml_.CloseElement();
  }

  /// Tissues of known classes need no words.
  void write_tissues() {
    if (!own_) {
      return;
    }
    xml_.OpenElement("tissues");
    for (const auto& [label, name] : sg::brain_classes) {
      if (volumes_.contains(label) || (label == own::tumour && !files_.tumour.empty())) {
        xml_.OpenElement("tissue");
        xml_.PushAttribute("label", int{label});
        xml_.PushAttribute("material", usual_material(label).c_str());
        xml_.CloseElement();
      }
    }
    xml_.CloseElement();
  }

  void write_load() {
    xml_.OpenElement("load");
    if (files_.points.size() == 1 && ending_of(files_.points[0]) != ".csv") {
      throw std::invalid_argument(files_.points[0].string() +
                                  ": markups and surfaces come in pairs, before and after; give both to --points");
    }
    if (files_.points.size() == 1) {
      const auto load = solve::read_craniotomy_csv(files_.points[0]);
      take(files_.points[0], std::to_string(load.positions.rows()) + " measured displacements");
      xml_.OpenElement("craniotomy");
      push_file("file", files_.points[0]);
    } else if (files_.points.size() == 2) {
      write_pair(files_.points[0], files_.points[1]);
    } else {
      throw std::invalid_argument(
          "nothing would move the brain; give --points with markups or surfaces before and after, or craniotomy.csv");
    }
    xml_.CloseElement();
    xml_.CloseElement();
  }

  void write_pair(const fs::path& before, const fs::path& after) {
    if (std::ranges::count(surface_endings, ending_of(before)) > 0) {
      read_surface(before);
      read_surface(after);
      take(before, "the exposed cortex before, with " + after.string() + " after");
      xml_.OpenElement("surfaces");
    } else {
      const auto load = solve::read_markups(before, after);
      take(before, std::to_string(load.positions.rows()) + " points before, with " + after.string() +
                       " after; they moved by up to " +
                       std::to_string(std::lround(load.displacement.rowwise().norm().maxCoeff())) + " mm");
      xml_.OpenElement("markups");
    }
    push_file("before", before);
    push_file("after", after);
  }

  void push_file(const char* name, const fs::path& file) {
    if (!file.empty()) {
      xml_.PushAttribute(name, whole_path(file).c_str());
    }
  }

  void take(const fs::path& file, const std::string& what) { taken_.push_back(file.string() + ": taken for " + what); }

  /// A comment of XML must not hold two dashes.
  std::string comments() const {
    std::string text;
    for (const std::string& sentence : taken_) {
      std::string safe = sentence;
      for (std::size_t at = safe.find("--"); at != std::string::npos; at = safe.find("--")) {
        safe.replace(at, 2, "- -");
      }
      text += "<!-- " + safe + " -->\n";
    }
    return text;
  }

  const FilesAtHand& files_;
  tinyxml2::XMLPrinter xml_;
  fs::path mask_;
  sg::LabelVolumes volumes_;
  std::string labels_are_;
  bool own_ = false;  ///< the label map has the numbers of default_label
  std::vector<std::string> taken_;
};

}  // namespace

NewScene new_scene(const FilesAtHand& files) {
  return Writer(files).write();
}

}  // namespace brainshift::pipelines
