// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl/filesystem.h>

#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

#include "pipelines/python/convert.hpp"
#include "segmentation/files/surface_file.hpp"

namespace brainshift::python {
namespace {

template <class T>
constexpr py::ssize_t components = 1;
template <>
constexpr py::ssize_t components<std::array<float, 3>> = 3;

template <class T>
struct Number {
  using type = T;
};
template <>
struct Number<std::array<float, 3>> {
  using type = float;
};

template <class T>
std::vector<py::ssize_t> shape_of(const Image<T>& image) {
  const Eigen::Array3i& size = image.geometry.size;
  std::vector<py::ssize_t> shape = {size.x(), size.y(), size.z()};
  if (components<T> != 1) {
    shape.push_back(components<T>);
  }
  return shape;
}

/// Bytes from a voxel to the next along each axis: x is the fastest, the components of a voxel lie together.
template <class T>
std::vector<py::ssize_t> strides_of(const Image<T>& image) {
  const Eigen::Array3i& size = image.geometry.size;
  const py::ssize_t voxel = sizeof(T), row = voxel * size.x(), slice = row * size.y();
  std::vector<py::ssize_t> strides = {voxel, row, slice};
  if (components<T> != 1) {
    strides.push_back(sizeof(typename Number<T>::type));
  }
  return strides;
}

template <class T>
py::array_t<typename Number<T>::type> voxels_of(Image<T>& image, const py::object& owner) {
  using Value = typename Number<T>::type;
  return py::array_t<Value>(shape_of(image), strides_of(image), reinterpret_cast<Value*>(image.voxels.data()), owner);
}

void check_values(const Image<float>& image, const py::array&, const py::object&) {
  for (const float value : image.voxels) {
    if (!std::isfinite(value)) {
      throw std::invalid_argument("a voxel of the image is not finite; give it a number");
    }
  }
}

void check_values(const Image<std::array<float, 3>>& image, const py::array&, const py::object&) {
  for (const auto& u : image.voxels) {
    if (!std::isfinite(u[0]) || !std::isfinite(u[1]) || !std::isfinite(u[2])) {
      throw std::invalid_argument("a displacement of the field is not finite; give it a number");
    }
  }
}

/// What numpy wrapped or rounded is not what was given.
bool same_numbers(const py::array& given, const py::object& taken) {
  return py::module_::import("numpy").attr("array_equal")(given, taken).cast<bool>();
}

void check_values(const LabelMap&, const py::array& given, const py::object& taken) {
  if (!same_numbers(given, taken)) {
    throw std::invalid_argument("labels must be whole numbers from 0 to 65535; round the label map, or map its labels");
  }
}

/// The one copy that is made: numpy converts and orders the values where they are not as they are wanted.
template <class T>
Image<T> image_of(const py::array& voxels, const RowMajor<double>& affine) {
  constexpr py::ssize_t dimensions = components<T> == 1 ? 3 : 4;
  if (voxels.ndim() != dimensions || (dimensions == 4 && voxels.shape(3) != components<T>)) {
    throw std::invalid_argument(dimensions == 3 ? "voxels must be an array of three dimensions, (nx, ny, nz)"
                                                : "a field's voxels must be an array of (nx, ny, nz, 3)");
  }
  if (voxels.size() == 0) {
    throw std::invalid_argument("the image has no voxels");
  }
  if (voxels.dtype().kind() == 'c') {
    throw std::invalid_argument("the voxels are complex numbers; give their real part or their size");
  }
  if (voxels.dtype().kind() == 'V') {
    throw std::invalid_argument("the voxels are records, as colours are; give one number a voxel");
  }
  Image<T> image;
  const Eigen::Array3i size(static_cast<int>(voxels.shape(0)), static_cast<int>(voxels.shape(1)),
                            static_cast<int>(voxels.shape(2)));
  image.geometry = geometry_of(size, affine);
  image.voxels.resize(image.geometry.voxel_count());
  const py::object target = voxels_of(image, py::none());  // no longer than this function
  py::module_::import("numpy").attr("copyto")(target, voxels, py::arg("casting") = "unsafe");
  check_values(image, voxels, target);
  return image;
}

template <class T>
void add_image(py::module_& module, const char* name, const std::string& voxels) {
  py::class_<Image<T>>(module, name,
                       ("An image in memory: " + voxels + "\n\n  " + name +
                        "(voxels, affine): affine is 4 x 4, from voxel indices to LPS, mm. The values "
                        "are copied once.\n  from_nibabel() makes one of a nibabel image, to_nibabel() the way back.")
                           .c_str())
      .def(py::init(&image_of<T>), py::arg("voxels"), py::arg("affine"))
      .def_property_readonly(
          "voxels", [](const py::object& self) { return voxels_of(self.cast<Image<T>&>(), self); },
          "numpy array on the image's own memory, index [i, j, k]")
      .def_property_readonly(
          "affine", [](const Image<T>& image) { return affine_of(image.geometry); },
          "(4, 4): voxel index (i, j, k, 1) to LPS, mm")
      .def("__repr__", [name = std::string(name)](const Image<T>& image) {
        return "<brainshift." + name + ": " + described(image.geometry) + ">";
      });
}

template <class T>
void add_writer(py::module_& module) {
  module.def(
      "write_image", [](const std::filesystem::path& file, const Image<T>& image) { write_image(file, image); },
      py::arg("file"), py::arg("image"), py::call_guard<py::gil_scoped_release>(),
      "Writes .nii.gz, .nii, .nrrd or .mha. A VectorImage becomes an ITK displacement field.");
}

void add_surface(py::module_& module) {
  py::class_<Surface>(module, "Surface",
                      "A triangulated surface, mm, LPS.\n\n  Surface(vertices, triangles): (n, 3) numbers and (m, 3) "
                      "rows of them, counter-clockwise seen from outside.")
      .def(py::init(&surface_of), py::arg("vertices"), py::arg("triangles"))
      .def_property_readonly("vertices", viewed<Surface>(&Surface::vertices), "(n, 3) float64, mm, LPS")
      .def_property_readonly("triangles", viewed<Surface>(&Surface::triangles), "(m, 3) int32, rows of vertices")
      .def_property_readonly("volume", &volume, "enclosed, mm3")
      .def("__repr__", [](const Surface& surface) {
        return "<brainshift.Surface: " + std::to_string(surface.vertices.rows()) + " vertices, " +
               std::to_string(surface.triangles.rows()) + " triangles>";
      });
}

}  // namespace

Points points_of(const RowMajor<double>& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw std::invalid_argument(name + " must be an array of (n, 3) numbers");
  }
  const Points points = Eigen::Map<const Points>(array.data(), array.shape(0), 3);
  for (Eigen::Index row = 0; row < points.rows(); ++row) {
    if (!points.row(row).allFinite()) {
      throw std::invalid_argument("row " + std::to_string(row) + " of " + name + " is not finite");
    }
  }
  return points;
}

Surface surface_of(const RowMajor<double>& vertices, const py::object& corners) {
  Surface surface{points_of(vertices, "vertices"), {}};
  const py::array given = py::module_::import("numpy").attr("asarray")(corners);
  if (given.ndim() != 2 || given.shape(1) != 3) {
    throw std::invalid_argument("triangles must be an array of (m, 3) rows of vertices");
  }
  const auto triangles = given.cast<RowMajor<std::int32_t>>();
  if (!same_numbers(given, triangles)) {
    throw std::invalid_argument("triangles must be whole numbers, rows of vertices");
  }
  surface.triangles = Eigen::Map<const Triangles>(triangles.data(), triangles.shape(0), 3);
  if (surface.triangles.size() > 0 &&
      (surface.triangles.minCoeff() < 0 || surface.triangles.maxCoeff() >= surface.vertices.rows())) {
    throw std::invalid_argument("a corner of a triangle is no row of vertices: they count from 0 to " +
                                std::to_string(surface.vertices.rows() - 1));
  }
  return surface;
}

ImageGeometry geometry_of(const Eigen::Array3i& size, const RowMajor<double>& affine) {
  if (affine.ndim() != 2 || affine.shape(0) != 4 || affine.shape(1) != 4) {
    throw std::invalid_argument("affine must be an array of (4, 4) numbers");
  }
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(affine.data());
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    throw std::invalid_argument("affine must have 0 0 0 1 as its last row");
  }
  ImageGeometry geometry{.size = size,
                         .spacing = matrix.topLeftCorner<3, 3>().colwise().norm().transpose(),
                         .origin = matrix.topRightCorner<3, 1>()};
  if (!matrix.allFinite() || !(geometry.spacing.minCoeff() > 0)) {
    throw std::invalid_argument("affine must hold finite numbers, and three axes that are not zero");
  }
  const Eigen::Matrix3d axes = matrix.topLeftCorner<3, 3>() * geometry.spacing.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  geometry.direction = svd.matrixU() * svd.matrixV().transpose();
  constexpr double rounding = 1e-3;  // of single precision in a header, with room
  if (!((geometry.direction - axes).cwiseAbs().maxCoeff() < rounding)) {
    throw std::invalid_argument("the image's axes are not at right angles to each other; resample it first");
  }
  return geometry;
}

py::array_t<double> affine_of(const ImageGeometry& geometry) {
  py::array_t<double> affine({4, 4});
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(affine.mutable_data());
  matrix.setIdentity();
  matrix.topLeftCorner<3, 3>() = geometry.direction * geometry.spacing.asDiagonal();
  matrix.topRightCorner<3, 1>() = geometry.origin;
  return affine;
}

std::string option_text(const py::handle& value) {
  if (value.is_none()) {
    return "";
  }
  if (py::isinstance<py::array>(value)) {
    return option_text(value.attr("tolist")());
  }
  if (py::isinstance<py::bool_>(value) || py::isinstance(value, py::module_::import("numpy").attr("bool_"))) {
    return value.cast<bool>() ? "yes" : "no";
  }
  if (py::isinstance<py::str>(value)) {
    return value.cast<std::string>();
  }
  if (py::isinstance<py::sequence>(value)) {
    std::string text;
    for (const py::handle item : value) {
      text += (text.empty() ? "" : " ") + option_text(item);
    }
    return text;
  }
  return py::str(value);
}

void add_images(py::module_& module) {
  add_image<float>(module, "ScalarImage", "voxels float32 (nx, ny, nz).");
  add_image<std::uint16_t>(module, "LabelMap", "voxels uint16 (nx, ny, nz), 0 is background.");
  add_image<std::array<float, 3>>(module, "VectorImage",
                                  "voxels float32 (nx, ny, nz, 3), displacements, mm, LPS, in the last axis.");
  add_surface(module);
  const auto free = py::call_guard<py::gil_scoped_release>();
  module.def("read_image", &read_image, py::arg("file"), free,
             "Reads .nii, .nii.gz, .nrrd, .mha, .mgz or a DICOM folder as a ScalarImage.");
  module.def("read_label_map", &read_label_map, py::arg("file"), free, "The same as a LabelMap.");
  module.def("read_field", &read_vector_image, py::arg("file"), free,
             "Reads a displacement field, as register/preop_to_intraop.nii.gz of a run, as a VectorImage.");
  add_writer<float>(module);
  add_writer<std::uint16_t>(module);
  add_writer<std::array<float, 3>>(module);
  module.def("read_surface", &read_surface, py::arg("file"), free, "Reads .vtp, .stl, .ply or .obj as a Surface, LPS.");
  module.def("write_surface", &write_surface, py::arg("file"), py::arg("surface"), free,
             "Writes .vtp, .stl, .ply or .obj.");
}

}  // namespace brainshift::python
