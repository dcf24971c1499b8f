// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/scene/scene_fault.hpp"

namespace brainshift::pipelines {

void fail(const Scene& scene, const std::string& path, const std::string& what) {
  throw std::invalid_argument(scene.source.file.empty() ? what : place(scene.source, path) + ": " + what);
}

}  // namespace brainshift::pipelines
