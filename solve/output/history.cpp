// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/history.hpp"

#include <fstream>
#include <iomanip>

#include "segmentation/files/not_written.hpp"

namespace brainshift::solve {

void write_history(const std::filesystem::path& file, const std::vector<HistoryRow>& history) {
  std::ofstream out(file);
  out << "step,time,external_work_mJ,strain_energy_mJ,kinetic_energy_mJ,residual,error_bound_mm,dissipated_energy_mJ,"
         "reaction_x_N,reaction_y_N,reaction_z_N\n"
      << std::setprecision(9);
  for (const HistoryRow& row : history) {
    out << row.step << ',' << row.time << ',' << row.external_work << ',' << row.strain_energy << ','
        << row.kinetic_energy << ',' << row.residual << ',' << row.error_bound << ',' << row.dissipated_energy << ','
        << row.reaction.x() << ',' << row.reaction.y() << ',' << row.reaction.z() << '\n';
  }
  if (!out.flush()) {
    fail_to_write(file);
  }
}

}  // namespace brainshift::solve
