// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkPointData.h>

#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "discretise/vtu/vtu_file.hpp"
#include "solve/cut/cut_surface.hpp"
#include "solve/solve.hpp"

namespace brainshift::solve {

namespace {

/// What the solution was at a snapshot. Nodes that were added since are the last ones.
Solution state_at(const Snapshot& snapshot, const Solution& end) {
  Solution state = end;
  state.displacement = snapshot.displacement;
  if (snapshot.positions.rows() > 0) {
    state.positions = snapshot.positions;
    state.cut = snapshot.cut;
    state.spacing.resize(static_cast<std::size_t>(snapshot.positions.rows()));
  }
  return state;
}

void write_nodes(const std::filesystem::path& file, const Solution& state) {
  const auto grid = vtu::vertex_grid(state.positions);
  const Points& u = state.displacement;
  vtu::add_array(*grid->GetPointData(), "displacement", {u.data(), static_cast<std::size_t>(u.size())}, 3);
  vtu::write(file, *grid);
}

}  // namespace

void write_steps(const std::filesystem::path& folder, const SolveResult& result) {
  std::filesystem::create_directories(folder / "steps");
  const std::filesystem::path collection = folder / "steps.pvd";
  std::ofstream out(collection);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const Snapshot& snapshot : result.snapshots) {
    const Solution state = state_at(snapshot, result.solution);
    std::ostringstream name;
    name << "steps/" << std::setw(6) << std::setfill('0') << snapshot.step;
    write_nodes(folder / (name.str() + ".vtu"), state);
    out << "<DataSet timestep=\"" << snapshot.step << "\" file=\"" << name.str() << ".vtu\"/>\n";
    if (!state.cut.empty()) {
      write_cut_surface(folder / (name.str() + "_cut.vtp"), cut_surface(state, *result.inside));
      out << "<DataSet timestep=\"" << snapshot.step << "\" part=\"1\" file=\"" << name.str() << "_cut.vtp\"/>\n";
    }
  }
  out << "</Collection>\n</VTKFile>\n";
  if (!out.flush()) {
    throw std::runtime_error(collection.string() + ": cannot be written; is the disk full or the folder read-only?");
  }
}

}  // namespace brainshift::solve
