// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Between numpy and our structs. A view is an array on the memory of a struct, which lives as long as the array does.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "segmentation/geometry/surface.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::python {

namespace py = pybind11;

template <class T>
using RowMajor = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// A view of n values, or of rows of `columns` values.
template <class T>
py::array_t<T> view(const py::object& owner, const std::vector<T>& values, py::ssize_t columns = 0) {
  const auto count = static_cast<py::ssize_t>(values.size());
  if (columns == 0) {
    return py::array_t<T>({count}, values.data(), owner);
  }
  return py::array_t<T>({count / columns, columns}, values.data(), owner);
}

/// A view of rows of three.
template <class T>
py::array_t<T> view(const py::object& owner, const Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
  return py::array_t<T>({static_cast<py::ssize_t>(rows.rows()), py::ssize_t{3}}, rows.data(), owner);
}

/// A property that is a view of a member.
template <class T, class Member>
auto viewed(Member member) {
  return [member](const py::object& self) { return view(self, std::invoke(member, self.cast<const T&>())); };
}

/// Rows of three finite numbers. Throws std::invalid_argument, with `name` in it.
Points points_of(const RowMajor<double>& array, const std::string& name);

/// Triangles whose corners are rows of `vertices`. Throws std::invalid_argument.
Surface surface_of(const RowMajor<double>& vertices, const py::object& triangles);

/// The grid of an image of nx × ny × nz voxels from its 4 × 4 matrix: voxel index to LPS, mm. Throws
/// std::invalid_argument on axes that are not at right angles to each other.
ImageGeometry geometry_of(const Eigen::Array3i& size, const RowMajor<double>& affine);
py::array_t<double> affine_of(const ImageGeometry& geometry);

/// Adds ScalarImage, LabelMap, VectorImage and Surface to the module, with their readers and writers.
void add_images(py::module_& module);

/// Adds Load, and what the stages return: Segmentation, Body, Solution, Registration.
void add_results(py::module_& module);

/// A Python value as the text of an option: True is "yes", a list "1 2 3", None nothing.
std::string option_text(const py::handle& value);

/// Sets options by name. Throws TypeError on an unknown name, std::invalid_argument on a value that is not allowed.
template <class T>
void set_options(const OptionTable<T>& table, const py::kwargs& named, T& options) {
  for (const auto& [key, value] : named) {
    const auto name = py::cast<std::string>(key);
    const Option<T>* option = find_option(table, name);
    if (option == nullptr) {
      throw py::type_error("there is no option '" + name + "'; there are: " + option_names(table));
    }
    if (const std::string text = option_text(value); !set_option(*option, options, text)) {
      throw std::invalid_argument(refusal(*option, text));
    }
  }
}

/// "\n\nOptions:\n  edge_length: a number >= 0.5, mm; target edge of the remeshed surfaces; ...\n  ...".
template <class T>
std::string options_help(const OptionTable<T>& table, const T& defaults) {
  std::string text = "\n\nOptions, by name:\n";
  for (const Option<T>& option : table) {
    const std::string standard = option.get(defaults);
    text += "  " + option.name + ": " + option.allowed + (option.unit.empty() ? "" : ", " + option.unit) + "; " +
            option.help + (standard.empty() ? "" : " [" + standard + "]") + "\n";
  }
  return text;
}

}  // namespace brainshift::python
