// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <iomanip>
#include <stdexcept>

#include "solve/solve.hpp"

namespace brainshift::solve {

void write_history(const std::filesystem::path& file, const std::vector<HistoryRow>& history) {
  std::ofstream out(file);
  out << "step,time,external_work_mJ,strain_energy_mJ,kinetic_energy_mJ,residual,error_bound_mm\n"
      << std::setprecision(9);
  for (const HistoryRow& row : history) {
    out << row.step << ',' << row.time << ',' << row.external_work << ',' << row.strain_energy << ','
        << row.kinetic_energy << ',' << row.residual << ',' << row.error_bound << '\n';
  }
  if (!out.flush()) {
    throw std::runtime_error(file.string() + ": cannot be written; is the disk full or the folder read-only?");
  }
}

}  // namespace brainshift::solve
