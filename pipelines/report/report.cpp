// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/report.hpp"

#include "pipelines/report/run_data.hpp"

namespace brainshift::pipelines {

void write_report(const std::filesystem::path& run_folder, const std::filesystem::path& out, const Progress& progress) {
  report(progress, 0, "reading the run");
  const RunData run = read_run(run_folder);
  std::filesystem::create_directories(out);
}

}  // namespace brainshift::pipelines
