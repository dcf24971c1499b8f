// SPDX-License-Identifier: GPL-3.0-or-later
#include <hdf5.h>
#include <itkVersion.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "register/files/out_stream.hpp"
#include "register/files/write_transform.hpp"

namespace brainshift::registration {

namespace {

constexpr const char* parameters = "TransformParameters";

/// What HDF5 opened, closed in the end. Throws when it could not be opened.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) { check(id); }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

  static void check(hid_t status) {
    if (status < 0) {
      throw std::bad_alloc();  // in memory nothing else can be refused
    }
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle new_dataset(hid_t parent, const char* name, hid_t type, hsize_t count, hsize_t chunk = 0) {
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  Handle::check(H5Pset_obj_track_times(properties, false));  // equal fields make equal files
  if (chunk > 0) {
    Handle::check(H5Pset_chunk(properties, 1, &chunk));
    Handle::check(H5Pset_shuffle(properties));
    Handle::check(H5Pset_deflate(properties, Z_BEST_SPEED));
  }
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  return {H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose};
}

void write_text(hid_t parent, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  Handle::check(H5Tset_size(type, H5T_VARIABLE));
  const char* const characters = text.c_str();
  Handle::check(H5Dwrite(new_dataset(parent, name, type, 1), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters));
}

/// Size, origin, spacing and direction, as ITK orders them.
void write_grid(hid_t parent, const ImageGeometry& g) {
  std::vector<double> numbers;
  for (const Eigen::Vector3d& three : {Eigen::Vector3d(g.size.cast<double>()), g.origin, g.spacing}) {
    numbers.insert(numbers.end(), three.begin(), three.end());
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      numbers.push_back(g.direction(row, column));
    }
  }
  const Handle set = new_dataset(parent, "TransformFixedParameters", H5T_IEEE_F64LE, numbers.size());
  Handle::check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()));
}

/// A chunk as HDF5's filters make it: shuffled (the first bytes of all numbers, then the second, ...), which brings the
/// alike bytes of neighbours together, and deflated. The last chunk is filled up with zeros. Empty when zlib fails.
std::vector<Bytef> packed(std::span<const float> numbers, std::size_t chunk) {
  constexpr std::size_t width = sizeof(float);
  std::vector<Bytef> shuffled(width * chunk);
  const auto* bytes = reinterpret_cast<const Bytef*>(numbers.data());
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    for (std::size_t b = 0; b < width; ++b) {
      shuffled[b * chunk + n] = bytes[width * n + b];
    }
  }
  uLong size = compressBound(static_cast<uLong>(shuffled.size()));
  std::vector<Bytef> result(size);
  const int status =
      compress2(result.data(), &size, shuffled.data(), static_cast<uLong>(shuffled.size()), Z_BEST_SPEED);
  result.resize(status == Z_OK ? size : 0);
  result.shrink_to_fit();
  return result;
}

/// HDF5 would compress on one thread.
void write_packed(hid_t parent, std::span<const float> numbers) {
  const std::size_t chunk = std::min(std::size_t{1} << 18, numbers.size());
  const Handle set = new_dataset(parent, parameters, H5T_IEEE_F32LE, numbers.size(), chunk);
  std::vector<std::vector<Bytef>> chunks((numbers.size() + chunk - 1) / chunk);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    chunks[c] = packed(numbers.subspan(c * chunk, std::min(chunk, numbers.size() - c * chunk)), chunk);
  }
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const hsize_t begin = c * chunk;
    Handle::check(chunks[c].empty() ? -1 : 0);
    Handle::check(H5Dwrite_chunk(set, H5P_DEFAULT, 0, &begin, chunks[c].size(), chunks[c].data()));
  }
}

void write_plain(hid_t parent, std::span<const float> numbers) {
  const Handle set = new_dataset(parent, parameters, H5T_IEEE_F32LE, numbers.size());
  Handle::check(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()));
}

struct Bytes {
  std::unique_ptr<char[]> first;
  std::size_t size;
};

/// The bytes of the file that ITK's reader of HDF5 transforms expects. It is made in memory: where HDF5 itself meets a
/// full disk, it keeps the file open, and crashes when the program ends.
Bytes hdf5_file(const VectorImage& field, Packing packing) {
  const std::span numbers(field.voxels.front().data(), 3 * field.voxels.size());
  constexpr std::size_t rest = std::size_t{1} << 20;  // of the file; each time it grows it is copied
  const std::size_t growth = numbers.size_bytes() + rest;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Handle::check(H5Pset_fapl_core(access, growth, false));
  const Handle out(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  write_text(out, "ITKVersion", itk::Version::GetITKVersion());
  const Handle all(H5Gcreate2(out, "TransformGroup", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const Handle one(H5Gcreate2(all, "0", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  write_text(one, "TransformType", "DisplacementFieldTransform_float_3_3");
  write_grid(one, field.geometry);
  packing == Packing::deflated ? write_packed(one, numbers) : write_plain(one, numbers);
  Handle::check(H5Fflush(out, H5F_SCOPE_LOCAL));
  const ssize_t size = H5Fget_file_image(out, nullptr, 0);
  Handle::check(size < 0 ? -1 : 0);
  Bytes bytes{.first = std::make_unique_for_overwrite<char[]>(static_cast<std::size_t>(size)),
              .size = static_cast<std::size_t>(size)};
  Handle::check(H5Fget_file_image(out, bytes.first.get(), bytes.size) < 0 ? -1 : 0);
  return bytes;
}

}  // namespace

void write_transform(const std::filesystem::path& file, const VectorImage& field, Packing packing) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what goes wrong is thrown, not printed
  const Bytes bytes = hdf5_file(field, packing);
  OutStream out(file);
  out.write(bytes.first.get(), bytes.size);
  out.finish();
}

}  // namespace brainshift::registration
