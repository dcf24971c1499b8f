// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include "register/files/out_stream.hpp"
#include "register/files/text_vertex.hpp"
#include "register/files/warp_mesh.hpp"
#include "segmentation/files/model_file.hpp"
#include "segmentation/files/readable_file.hpp"

namespace brainshift::registration {

void warp_obj(const std::filesystem::path& in, PointMover& mover, const std::filesystem::path& out) {
  check_readable(in);
  const Eigen::Vector3d to_lps = axes_to_lps(frame_in_header(in));
  std::ifstream stream(in, std::ios::binary);
  OutStream moved(out);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::vector<std::string_view> words = words_in(line);
    if (!words.empty() && words.front() == "v") {
      line = with_moved_words(line, {1, 2, 3}, to_lps, mover, in, number);
    }
    line += stream.eof() ? "" : "\n";
    moved.write(line.data(), line.size());
  }
  if (mover.moved().points == 0) {
    refuse(in, "holds no vertex: no line begins with \"v \"; is it a .obj model?");
  }
  moved.finish();
}

}  // namespace brainshift::registration
