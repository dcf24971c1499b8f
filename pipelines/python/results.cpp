// SPDX-License-Identifier: GPL-3.0-or-later
//
// What goes into the stages beside images, and what comes out of them, as classes of Python.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <stdexcept>

#include "pipelines/python/convert.hpp"
#include "pipelines/runner/measures.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift::python {
namespace {

py::object measures_of(const pipelines::StageReport& report) {
  return py::module_::import("json").attr("loads")(report.measures.dump());
}

solve::CraniotomyLoad load_of(const RowMajor<double>& positions, const RowMajor<double>& displacement,
                              const std::optional<RowMajor<double>>& sigma) {
  solve::CraniotomyLoad load{points_of(positions, "positions"), points_of(displacement, "displacement")};
  if (sigma) {
    load.sigma = points_of(*sigma, "sigma");
  }
  if (load.displacement.rows() != load.positions.rows() || (sigma && load.sigma.rows() != load.positions.rows())) {
    throw std::invalid_argument("positions, displacement and sigma must have as many rows");
  }
  if (sigma && load.sigma.size() > 0 && load.sigma.minCoeff() < solve::smallest_noise) {
    throw std::invalid_argument("sigma must be positive, mm; leave it out for a load that is held exactly");
  }
  return load;
}

void add_load(py::module_& m) {
  using solve::CraniotomyLoad;
  py::class_<CraniotomyLoad>(
      m, "Load",
      "Displacements measured on the exposed cortex, mm, LPS.\n\n  Load(positions, displacement, "
      "sigma=None): (n, 3) each; sigma: standard deviations along the axes. Without sigma the "
      "load is held exactly.")
      .def(py::init(&load_of), py::arg("positions"), py::arg("displacement"), py::arg("sigma") = py::none())
      .def_property_readonly("positions", viewed<CraniotomyLoad>(&CraniotomyLoad::positions), "(n, 3) preop, mm")
      .def_property_readonly("displacement", viewed<CraniotomyLoad>(&CraniotomyLoad::displacement), "(n, 3) mm")
      .def_property_readonly("sigma", viewed<CraniotomyLoad>(&CraniotomyLoad::sigma), "(n, 3) mm, or (0, 3)");
  m.def("read_load", &solve::read_craniotomy_csv, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
        "Reads a craniotomy.csv, x,y,z,ux,uy,uz with '# frame: LPS' or RAS before it, as a Load.");
}

void add_segmentation(py::module_& m) {
  using segmentation::Segmentation;
  py::class_<Segmentation>(m, "Segmentation", "What segment() found. Surfaces are closed, outward, mm, LPS.")
      .def_readonly("labels", &Segmentation::labels, "LabelMap; None where a surface came in")
      .def_readonly("brain", &Segmentation::brain, "Surface of all the brain's tissues")
      .def_readonly("skull", &Segmentation::skull, "Surface of the skull's inside")
      .def_readonly("tissues", &Segmentation::tissues, "{label: Surface}, with tissue_surfaces=True")
      .def_readonly("notes", &Segmentation::notes, "sentences: what was dropped, filled or not reached")
      .def_property_readonly("measures", [](const Segmentation& s) { return measures_of(pipelines::report_of(s)); });
}

void add_body(py::module_& m) {
  using discretise::Discretisation;
  const auto of_cloud = [](auto member) {
    return [member](const py::object& self) { return view(self, self.cast<Discretisation&>().cloud.*member); };
  };
  const auto of_cells = [](auto member) {
    return [member](const py::object& self) { return view(self, self.cast<Discretisation&>().cells.*member); };
  };
  py::class_<Discretisation>(m, "Body", "Nodes and background cells of a brain; n nodes, m cells, mm, LPS.")
      .def_property_readonly("nodes", of_cloud(&NodeCloud::positions), "(n, 3) float64")
      .def_property_readonly("spacing", of_cloud(&NodeCloud::spacing), "(n,) float64, to the neighbours, mm")
      .def_property_readonly("on_surface", of_cloud(&NodeCloud::on_surface), "(n,) uint8, 1 on the brain's surface")
      .def_property_readonly("vertices", of_cells(&BackgroundCells::vertices), "(k, 3) float64, of the cells")
      .def_property_readonly(
          "cells",
          [](const py::object& self) {
            const BackgroundCells& cells = self.cast<Discretisation&>().cells;
            return view(self, cells.connectivity, cells.corners());
          },
          "(m, 8) or (m, 4) int32, rows of vertices in VTK's order")
      .def_property_readonly("inside_fraction", of_cells(&BackgroundCells::inside_fraction), "(m,) float64, 0 to 1")
      .def_property_readonly("cell_label", of_cells(&BackgroundCells::label), "(m,) int32")
      .def_property_readonly("measures",
                             [](const Discretisation& d) { return measures_of(pipelines::report_of(d.measures)); });
}

void add_solution(py::module_& m) {
  using solve::SolveResult;
  const auto of_solution = [](auto member) {
    return [member](const py::object& self) { return view(self, self.cast<SolveResult&>().solution.*member); };
  };
  py::class_<SolveResult>(m, "Solution", "Displacements at the n nodes, mm, LPS.")
      .def_property_readonly("positions", of_solution(&Solution::positions), "(n, 3) float64, undeformed, mm")
      .def_property_readonly("displacement", of_solution(&Solution::displacement), "(n, 3) float64, mm")
      .def_property_readonly("reaction_force", of_solution(&Solution::reaction_force), "(n, 3) float64, N")
      .def_property_readonly("estimated_error", of_solution(&Solution::estimated_error),
                             "(n,) float64, mm, of the displacement for want of nodes; (0,) without an estimate")
      .def_property_readonly("converged", [](const SolveResult& r) { return r.failure.empty(); })
      .def_readonly("failure", &SolveResult::failure, "why it did not converge; empty where it did")
      .def_property_readonly("measures", [](const SolveResult& r) {
        const bool transient = r.measures.critical_step > 0;
        return measures_of(
            pipelines::report_of(r, transient ? solve::Dynamics::transient : solve::Dynamics::relaxation));
      });
}

void add_registration(py::module_& m) {
  using registration::Registration;
  py::class_<Registration>(m, "Registration", "Fields and images on the T1's grid.")
      .def_readonly("forward", &Registration::forward, "VectorImage at preop places: moves points, warp_points()")
      .def_readonly("resampling", &Registration::resampling, "VectorImage at intraop places: moves images, warp()")
      .def_readonly("warped", &Registration::warped, "ScalarImage: the T1 as the operated brain would show")
      .def_readonly("warped_labels", &Registration::warped_labels, "LabelMap, or None")
      .def_readonly("jacobian", &Registration::jacobian, "ScalarImage: how much the volume grows there")
      .def_property_readonly("landmarks", viewed<Registration>(&Registration::landmarks), "(n, 3) mm, LPS, intraop")
      .def_property_readonly("measures", [](const Registration& r) { return measures_of(pipelines::report_of(r)); });
}

}  // namespace

void add_results(py::module_& module) {
  add_load(module);
  add_segmentation(module);
  add_body(module);
  add_solution(module);
  add_registration(module);
}

}  // namespace brainshift::python
