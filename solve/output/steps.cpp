// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/output/steps.hpp"

#include <vtkPointData.h>

#include <fstream>
#include <iomanip>
#include <sstream>

#include "segmentation/files/make_folder.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "solve/output/cut_surface.hpp"

namespace brainshift::solve {

namespace {

void write_state(const std::filesystem::path& file, const Snapshot& state) {
  const auto grid = vtu::vertex_grid(state.positions);
  const Points& u = state.displacement;
  vtu::add_array(*grid->GetPointData(), "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
  vtu::write(file, *grid);
}

}  // namespace

void write_steps(const std::filesystem::path& folder, const SolveResult& result) {
  const std::filesystem::path steps = folder / "steps";
  make_folder(steps);
  const std::filesystem::path collection = folder / "steps.pvd";
  std::ofstream out(collection);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  out.precision(9);
  const bool in_time = result.measures.critical_step > 0;  // relaxation has no time once its load has come
  for (const Snapshot& snapshot : result.snapshots) {
    const double when = in_time ? snapshot.time : snapshot.step;
    std::ostringstream name;
    name << "steps/" << std::setw(6) << std::setfill('0') << snapshot.step;
    write_state(folder / (name.str() + ".vtu"), snapshot);
    out << "<DataSet timestep=\"" << when << "\" file=\"" << name.str() << ".vtu\"/>\n";
    if (snapshot.faces.vertices.rows() > 0) {
      write_cut_surface(folder / (name.str() + "_cut.vtp"), snapshot.faces);
      out << "<DataSet timestep=\"" << when << "\" part=\"1\" file=\"" << name.str() << "_cut.vtp\"/>\n";
    }
  }
  out << "</Collection>\n</VTKFile>\n";
  if (!out.flush()) {
    fail_to_write(collection);
  }
}

}  // namespace brainshift::solve
