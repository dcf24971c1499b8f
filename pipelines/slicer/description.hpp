// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "segmentation/options/values.hpp"

namespace brainshift::pipelines {

/// A parameter of 3D Slicer's command-line module.
struct SlicerParameter {
  std::string flag;  ///< without dashes; of what is returned, its name in the file of return parameters
  std::string tag;   ///< of the Slicer Execution Model: image, pointfile, double, ...
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string label;
  std::string description;
  std::string default_value = {};
  std::vector<std::string> choices = {};
  Range range = {};
  enum class Kind : std::uint8_t { input, output, returned, option } kind = Kind::option;
  std::string path = {};  ///< of an option: in the scene, as --set has it; of an output: the file in the run's folder
};

struct SlicerGroup {
  std::string label;
  std::string description;
  bool advanced = false;
  std::vector<SlicerParameter> parameters;
};

/// The parameters. Those that are options of a scene have help, range and default of the table of options.
const std::vector<SlicerGroup>& slicer_groups();

template <class Visit>
void for_each_parameter(SlicerParameter::Kind kind, const Visit& visit) {
  for (const SlicerGroup& group : slicer_groups()) {
    for (const SlicerParameter& parameter : group.parameters) {
      if (parameter.kind == kind) {
        visit(parameter);
      }
    }
  }
}

/// The module's description, XML of the Slicer Execution Model; `as_files` for hosts that know its images, files and
/// numbers alone, in the dialect of CTK's schema.
std::string slicer_description(bool as_files);

}  // namespace brainshift::pipelines
