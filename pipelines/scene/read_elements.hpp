// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tinyxml2.h>

#include <stdexcept>
#include <string>

#include "pipelines/scene/scene.hpp"

namespace brainshift::pipelines {

/// Where a value is written, as messages say it.
struct Where {
  const SceneSource& source;
  int line = 0;  ///< 0: --set
  std::string element;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string at = line == 0 ? "--set" : source.file.string() + ":" + std::to_string(line);
    throw std::invalid_argument(at + ": " + what);
  }
};

void refuse_text(const tinyxml2::XMLElement& xml, const SceneSource& source);

/// Reads an element with all that stands in it. parent: the path of the one it stands in; empty: the scene's.
void read_element(const tinyxml2::XMLElement& xml, const std::string& parent, Scene& scene);

/// Reads a scene's elements, all but <sequence>.
void read_elements(const tinyxml2::XMLElement& root, Scene& scene);

/// Reads <tissues> over those that are there, of which each keeps what is not named.
void change_tissues(const tinyxml2::XMLElement& xml, Scene& scene);

/// Puts "path=value" on top.
void apply_override(Scene& scene, const std::string& text);

}  // namespace brainshift::pipelines
