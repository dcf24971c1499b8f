// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkPointData.h>

#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "discretise/vtu/vtu_file.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

void write_steps(const std::filesystem::path& folder, const Points& positions, const std::vector<Snapshot>& snapshots) {
  std::filesystem::create_directories(folder / "steps");
  const std::filesystem::path collection = folder / "steps.pvd";
  std::ofstream out(collection);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const Snapshot& snapshot : snapshots) {
    std::ostringstream name;
    name << "steps/" << std::setw(6) << std::setfill('0') << snapshot.step << ".vtu";
    const auto grid = vtu::vertex_grid(snapshot.positions.rows() > 0 ? snapshot.positions : positions);
    const Points& u = snapshot.displacement;
    vtu::add_array(*grid->GetPointData(), "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
    vtu::write(folder / name.str(), *grid);
    out << "<DataSet timestep=\"" << snapshot.step << "\" file=\"" << name.str() << "\"/>\n";
  }
  out << "</Collection>\n</VTKFile>\n";
  if (!out.flush()) {
    throw std::runtime_error(collection.string() + ": cannot be written; is the disk full or the folder read-only?");
  }
}

}  // namespace brainshift::solve
