// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "segmentation/files/refuse.hpp"
#include "segmentation/image/bytes.hpp"
#include "segmentation/image/gzip_file.hpp"
#include "segmentation/image/image_header.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t nifti_header_size = 348;
constexpr std::size_t first_voxel = 352;
constexpr int scanners = 1;  // the code of a form that the scanner told

/// The 348 bytes of a NIfTI-1 header, in either byte order.
struct NiftiFields {
  ByteView bytes;
  bool swapped;

  int whole(std::size_t place) const { return number_at<std::int16_t>(bytes, place, swapped); }
  double real(std::size_t place) const { return number_at<float>(bytes, place, swapped); }
  int dimension(int axis) const { return whole(40 + 2 * static_cast<std::size_t>(axis)); }
  double step(int axis) const { return real(76 + 4 * static_cast<std::size_t>(axis)); }
  int qform_code() const { return whole(252); }
  int sform_code() const { return whole(254); }
};

std::uint64_t nifti_value_size(const fs::path& file, int datatype) {
  switch (datatype) {
    case 2:    // uint8
    case 256:  // int8
      return 1;
    case 4:    // int16
    case 512:  // uint16
      return 2;
    case 8:    // int32
    case 16:   // float
    case 768:  // uint32
      return 4;
    case 64:    // double
    case 1024:  // int64
    case 1280:  // uint64
      return 8;
    default:
      refuse(file, "holds values of NIfTI's type " + std::to_string(datatype) +
                       "; integers of 8 to 64 bits and floats of 32 or 64 are read");
  }
}

// The fifth axis holds the components of a vector.
void read_nifti_size(const fs::path& file, const NiftiFields& fields, ImageHeader& header) {
  const int dimensions = fields.dimension(0);
  if (dimensions < 1 || dimensions > 7) {
    refuse(file, "the header says " + std::to_string(dimensions) + " dimensions; repair the header");
  }
  for (int axis = 1; axis <= dimensions; ++axis) {
    const int along = axis > 3 ? std::max(1, fields.dimension(axis)) : fields.dimension(axis);
    if (along < 1) {
      refuse(file, "the header says " + std::to_string(along) + " voxels along axis " + std::to_string(axis) +
                       "; repair the header");
    }
    (axis == 5 ? header.components : header.size.emplace_back()) = static_cast<std::uint64_t>(along);
  }
}

Eigen::Matrix<double, 3, 4> sform(const NiftiFields& fields) {
  Eigen::Matrix<double, 3, 4> result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      result(row, column) = fields.real(280 + 4 * static_cast<std::size_t>(4 * row + column));
    }
  }
  return result;
}

// NaN where one of them is not finite.
template <class Matrix>
double largest_of(const Matrix& values) {
  return values.allFinite() ? values.cwiseAbs().maxCoeff() : std::nan("");
}

// Not finite where the three numbers of the quaternion are of no rotation.
Eigen::Matrix3d qform_direction(const NiftiFields& fields) {
  const Eigen::Vector3d axis(fields.real(256), fields.real(260), fields.real(264));
  constexpr double tolerance = 1e-3;
  if (!(axis.squaredNorm() <= 1 + tolerance)) {
    return Eigen::Matrix3d::Constant(std::nan(""));
  }
  const double real_part = std::sqrt(std::max(0.0, 1 - axis.squaredNorm()));
  Eigen::Matrix3d direction =
      Eigen::Quaterniond(real_part, axis.x(), axis.y(), axis.z()).normalized().toRotationMatrix();
  direction.col(2) *= fields.step(0) < 0 ? -1.0 : 1.0;
  return direction;
}

// ITK's matrices end the program on what is not finite, in single precision.
void check_finite_form(const fs::path& file, const char* name, double largest) {
  constexpr double longest = 1e6;  // mm
  if (!(largest < longest)) {
    refuse(file, std::string("the header's ") + name + " is not finite or beyond a kilometre; repair the header");
  }
}

void read_qform(const fs::path& file, const NiftiFields& fields, ImageHeader& header) {
  header.direction = qform_direction(fields);
  header.origin = Eigen::Vector3d(fields.real(268), fields.real(272), fields.real(276));
  check_finite_form(file, "qform", largest_of(header.direction));
  check_finite_form(file, "qform", largest_of(header.origin));
}

// ITK takes the spacing from pixdim, and the sform where there is no other form or it is the scanner's.
void read_sform(const fs::path& file, const NiftiFields& fields, ImageHeader& header) {
  const auto form = sform(fields);
  check_finite_form(file, "sform", largest_of(form));
  constexpr double smallest =
      1e-30;  // below it ITK's decomposition of single numbers fails, and says so on the terminal
  if ((form.array() != 0 && form.array().abs() < smallest).any()) {
    refuse(file, "the header's sform holds a number that is next to nothing but not 0; repair the header");
  }
  if (fields.qform_code() > 0 && fields.sform_code() != scanners) {
    return;
  }
  ImageHeader by_sform;
  set_axes(by_sform, form.leftCols<3>());
  constexpr double itk_tolerance = 1e-4;
  const bool sheared = !is_orthonormal(by_sform.direction, itk_tolerance);
  if (sheared && fields.qform_code() > 0) {
    return;
  }
  if (sheared) {
    refuse(file, "the header's sform is sheared or singular; resample the image onto a grid at right angles");
  }
  const Eigen::Vector3d off = (by_sform.spacing - header.spacing).cwiseAbs();
  constexpr double as_itk = 4.5e-4;  // beyond it ITK reads no such file
  const bool same_size = (off.array() <= as_itk * header.spacing.array()).all();
  if (!same_size) {
    refuse(file, "the header's sform and pixdim differ on the size of a voxel; repair the header");
  }
  header.direction = by_sform.direction;
  header.origin = form.col(3);
}

// Of a corner of the image: how far apart two headers place it, mm.
double apart(const ImageHeader& a, const ImageHeader& b, const Eigen::Vector3d& index) {
  const auto place = [&](const ImageHeader& header) -> Eigen::Vector3d {
    return header.origin + header.direction * header.spacing.cwiseProduct(index);
  };
  return (place(a) - place(b)).norm();
}

// Which of two forms that place the voxels differently was taken.
std::string note_forms(const NiftiFields& fields, const ImageHeader& by_qform, const ImageHeader& taken) {
  ImageHeader by_sform = taken;
  const auto form = sform(fields);
  set_axes(by_sform, form.leftCols<3>());
  by_sform.origin = form.col(3);
  double most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d index = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = (corner >> axis & 1) != 0 ? std::max(0, fields.dimension(axis + 1) - 1) : 0;
    }
    most = std::max(most, apart(by_qform, by_sform, index));
  }
  constexpr double worth_saying = 0.5;  // mm
  if (!(most > worth_saying)) {
    return {};
  }
  const bool took_sform = taken.direction != by_qform.direction || taken.origin != by_qform.origin;
  return "its sform and qform place voxels up to " + std::to_string(std::lround(most)) + " mm apart; the " +
         (took_sform ? "sform" : "qform") + " was taken";
}

// ITK takes the voxels' size to mm, but not their place.
void check_unit(const fs::path& file, int unit) {
  constexpr int unknown = 0, millimetres = 2;
  if (unit != unknown && unit != millimetres) {
    refuse(file, "the header's unit of length is not the millimetre; save the image in mm");
  }
}

double seconds_of(int unit) {
  constexpr int milliseconds = 16, microseconds = 24;
  return unit == milliseconds ? 1e-3 : unit == microseconds ? 1e-6 : 1;
}

void read_nifti_geometry(const fs::path& file, const NiftiFields& fields, ImageHeader& header) {
  constexpr int of_length = 7, of_time = 56;  // of the bits of xyzt_units
  check_unit(file, fields.bytes[123] & of_length);
  header.seconds = seconds_of(fields.bytes[123] & of_time);
  header.spacing = Eigen::Vector3d(fields.step(1), fields.step(2), fields.step(3));
  if (header.spacing.minCoeff() < 0) {
    refuse(file,
           "its voxels have a negative size (pixdim), which NIfTI does not allow and programs take for different "
           "frames; save the image anew, with positive sizes");
  }
  if (fields.qform_code() > 0) {
    read_qform(file, fields, header);
  }
  const ImageHeader by_qform = header;
  if (fields.sform_code() > 0) {
    read_sform(file, fields, header);
  }
  if (fields.qform_code() > 0 && fields.sform_code() > 0) {
    header.frame_note = note_forms(fields, by_qform, header);
  } else if (fields.qform_code() == 0 && fields.sform_code() == 0) {
    header.frame_note = std::string(no_frame) + "neither sform nor qform is set; " + taken_as_stored;
  }
}

// ITK leaves vectors as they are stored, crashes on whole ones, and adds the intercept where the standard has no
// scaling.
void check_scale(const fs::path& file, const NiftiFields& fields, std::uint64_t components) {
  const double slope = fields.real(112), intercept = fields.real(116);
  if (slope == 0 && intercept != 0) {
    refuse(file, "its header has scl_slope 0 but a scl_inter, which programs take differently; set scl_inter to 0");
  }
  const bool scaled = std::isfinite(slope) && slope != 0 && (slope != 1 || intercept != 0);
  if (components > 1 && scaled) {
    refuse(file, "its vectors are scaled (scl_slope, scl_inter), which is not read; save them as they are, as floats");
  }
}

}  // namespace

ImageHeader read_nifti_header(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = first_uncompressed(file, nifti_header_size);
  if (bytes.size() < nifti_header_size) {
    refuse(file, "truncated within the header; copy the file again");
  }
  constexpr std::int32_t second_size = 540;
  if (number_at<std::int32_t>(bytes, 0) == second_size || number_at<std::int32_t>(bytes, 0, true) == second_size) {
    refuse(file, "a NIfTI-2 image, which is not read; save it as NIfTI-1");
  }
  const bool swapped = number_at<std::int32_t>(bytes, 0) != static_cast<std::int32_t>(nifti_header_size);
  const NiftiFields fields{bytes, swapped};
  const std::string_view magic(reinterpret_cast<const char*>(bytes.data()) + 344, 3);
  if (number_at<std::int32_t>(bytes, 0, swapped) != static_cast<std::int32_t>(nifti_header_size) || magic != "n+1") {
    refuse(file, "is no NIfTI-1 image in one file, or its header is damaged; convert it to .nii.gz");
  }
  ImageHeader header;
  const int datatype = fields.whole(70);
  header.bytes_a_value = nifti_value_size(file, datatype);
  header.floating = datatype == 16 || datatype == 64;
  header.swapped = swapped;
  read_nifti_size(file, fields, header);
  check_scale(file, fields, header.components);
  read_nifti_geometry(file, fields, header);
  const double offset = fields.real(108);
  if (!(offset >= 0 && offset < 1e9)) {
    refuse(file, "the header's offset of the voxels is " + std::to_string(offset) + "; repair the header");
  }
  header.voxels_at = std::max(first_voxel, static_cast<std::size_t>(offset));
  header.compressed = is_gzip(file);
  return header;
}

}  // namespace brainshift
