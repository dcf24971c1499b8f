// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/warp_gii.hpp"

#include <gifti_io.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "register/files/gii_claims.hpp"
#include "register/files/warped_name.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/unfinished_file.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;

using GiftiFile = std::unique_ptr<gifti_image, decltype(&gifti_free_image)>;

GiftiFile read_gifti(const fs::path& file, bool with_data) {
  gifti_set_verb(0);  // our sentence is what the user reads
  return {gifti_read_image(file.c_str(), with_data ? 1 : 0), gifti_free_image};
}

std::optional<double> number_in(const giiMetaData& metadata, const std::string& name) {
  const char* const text = gifti_get_meta_value(&metadata, name.c_str());
  return text == nullptr ? std::nullopt : std::optional(std::strtod(text, nullptr));
}

/// FreeSurfer's surface coordinates: those of a volume whose axes point to the left, down and to the front and whose
/// middle is the origin. The metadata tell how the real volume lies: the directions of its axes and its middle, RAS.
std::optional<Eigen::Affine3d> by_freesurfers_volume(const giiMetaData& metadata) {
  Eigen::Matrix<double, 3, 4> volume;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      const auto number = number_in(metadata, std::string("VolGeom") + "XYZC"[column] + "_" + "RAS"[row]);
      if (!number) {
        return std::nullopt;
      }
      volume(row, column) = *number;
    }
  }
  const Eigen::Matrix3d of_surface = (Eigen::Matrix3d() << -1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() = volume.leftCols<3>() * of_surface.transpose();
  result.translation() = volume.col(3);
  return result;
}

/// From the coordinates of the points to the scanner's RAS, mm.
Eigen::Affine3d to_scanner(const giiDataArray& points) {
  const std::string scanner = "NIFTI_XFORM_SCANNER_ANAT";
  const auto is_scanner = [&](const char* space) { return space != nullptr && scanner == space; };
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (int c = 0; c < points.numCS; ++c) {
    if (is_scanner(points.coordsys[c]->dataspace)) {
      return result;
    }
  }
  for (int c = 0; c < points.numCS; ++c) {
    if (is_scanner(points.coordsys[c]->xformspace)) {
      result.matrix() =
          Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&points.coordsys[c]->xform[0][0]);
      return result;
    }
  }
  return by_freesurfers_volume(points.meta).value_or(result);
}

/// The coordinates of a point, whatever their order in memory.
template <class Number>
struct Coordinates {
  Number* values;
  Eigen::Index points;
  bool by_columns;

  Number& at(Eigen::Index point, Eigen::Index axis) const {
    return by_columns ? values[axis * points + point] : values[3 * point + axis];
  }
};

/// A template's space is nobody's: what lies there would be moved by the patient's field as if it lay in the patient.
void check_no_template(const fs::path& file, const giiDataArray& points) {
  for (int c = 0; c < points.numCS; ++c) {
    const char* const space = points.coordsys[c]->dataspace;
    if (space != nullptr && std::string("NIFTI_XFORM_MNI_152") == space) {
      refuse(
          file,
          "its points lie in the space of a template (NIFTI_XFORM_MNI_152); bring the surface into the patient's, or "
          "where the patient's image lies there itself, say NIFTI_XFORM_SCANNER_ANAT");
    }
  }
}

/// Moves them and appends where they were, LPS.
template <class Number>
void move_array(const fs::path& file, giiDataArray& array, PointMover& mover, Points& places) {
  const Coordinates<Number> x{static_cast<Number*>(array.data), array.dims[0],
                              array.ind_ord == GIFTI_IND_ORD_COL_MAJOR};
  const Eigen::Affine3d to_lps = Eigen::Scaling(-1.0, -1.0, 1.0) * to_scanner(array);
  if (!to_lps.matrix().allFinite() || !(std::abs(to_lps.linear().determinant()) > 0)) {
    refuse(file, "the matrix of its coordinate system cannot be inverted; repair the file");
  }
  const Eigen::Matrix3d turned_back = to_lps.linear().inverse();
  const Eigen::Index before = places.rows();
  places.conservativeResize(before + x.points, 3);
  for (Eigen::Index p = 0; p < x.points; ++p) {
    const Eigen::Vector3d place = to_lps * Eigen::Vector3d(x.at(p, 0), x.at(p, 1), x.at(p, 2));
    if (!place.allFinite()) {
      refuse(file, "point " + std::to_string(p + 1) + " is not finite; repair the file");
    }
    places.row(before + p) = place;
    const Eigen::Vector3d u = turned_back * mover.displacement(place);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      x.at(p, axis) = static_cast<Number>(x.at(p, axis) + u[axis]);
    }
  }
}

Points move_arrays(const fs::path& file, gifti_image& surface, PointMover& mover) {
  Points places(0, 3);
  for (int a = 0; a < surface.numDA; ++a) {
    giiDataArray& array = *surface.darray[a];
    if (array.intent != NIFTI_INTENT_POINTSET) {
      continue;
    }
    check_no_template(file, array);
    const bool single = array.datatype == NIFTI_TYPE_FLOAT32;
    if (array.num_dim != 2 || array.dims[1] != 3 || (!single && array.datatype != NIFTI_TYPE_FLOAT64)) {
      refuse(file, "its points must be rows of three floating-point numbers; save the surface again");
    }
    single ? move_array<float>(file, array, mover, places) : move_array<double>(file, array, mover, places);
  }
  if (places.rows() == 0) {
    refuse(file, "holds no points (NIFTI_INTENT_POINTSET); give the surface itself, as lh.pial.surf.gii");
  }
  return places;
}

void write_gifti(const fs::path& file, gifti_image& image) {
  // The library does not look whether the disk took all of it.
  UnfinishedFile unfinished(file, ".gii");
  if (gifti_write_image(&image, unfinished.path().c_str(), 1) != 0 || !read_gifti(unfinished.path(), false)) {
    fail_to_write(file);
  }
  unfinished.finish();
}

/// One value a vertex, as NIFTI_INTENT_SHAPE.
void write_shape(const fs::path& file, const PointValues& values) {
  const std::array<int, 2> size = {static_cast<int>(values.values.size()), 1};
  const GiftiFile shape(gifti_create_image(1, NIFTI_INTENT_SHAPE, NIFTI_TYPE_FLOAT32, 1, size.data(), 1),
                        gifti_free_image);
  if (!shape) {
    throw std::bad_alloc();
  }
  std::copy(values.values.begin(), values.values.end(), static_cast<float*>(shape->darray[0]->data));
  gifti_add_to_meta(&shape->darray[0]->meta, "Name", values.name.c_str(), 1);
  write_gifti(file, *shape);
}

}  // namespace

void warp_gii(const fs::path& in, PointMover& mover, const fs::path& out) {
  check_readable(in);
  check_gii_claims(in);
  const GiftiFile surface = read_gifti(in, true);
  if (!surface || gifti_image_has_data(surface.get()) == 0) {
    refuse(in, "is damaged or truncated; copy it again");
  }
  const Points places = move_arrays(in, *surface, mover);
  write_gifti(out, *surface);
  for (const PointValues& each : mover.finite_values(places)) {
    write_shape(values_name(each.name, out), each);
  }
}

}  // namespace brainshift::registration
