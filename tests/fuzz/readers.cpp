// SPDX-License-Identifier: GPL-3.0-or-later
//
// Our readers of files under libFuzzer: whatever a file holds, a reader takes it or refuses it by name in one line; it
// never crashes, hangs or takes memory that the file does not hold.
//
//   fuzz_readers --reader=obj corpus/obj -max_total_time=60      all options of libFuzzer
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "register/files/gii_claims.hpp"
#include "register/files/warp_tracts.hpp"
#include "register/files/warped_name.hpp"
#include "segmentation/files/legacy_vtk_claims.hpp"
#include "segmentation/files/ply_claims.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/read_obj.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/vtk_claims.hpp"
#include "segmentation/image/dicom_slice.hpp"
#include "segmentation/image/image_header.hpp"
#include "solve/interface/load_curve.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/update/archive.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

struct Reader {
  std::string ending;
  std::function<void(const fs::path& file)> read;
};

/// A field of a millimetre on few voxels: some points lie on it, others do not.
VectorImage small_field() {
  VectorImage field;
  field.geometry.size = {3, 3, 3};
  field.geometry.spacing = {20, 20, 20};
  field.voxels.assign(27, {1, -1, 0.5F});
  return field;
}

/// Warps the tracts of a file to another, which goes again. Each point has a value of its own beside.
template <class Warp>
void warp_tracts(const fs::path& file, const Warp& warp) {
  static const VectorImage field = small_field();
  registration::PointMover mover(field, [](const Points& places) {
    return std::vector<PointValues>{{"size", std::vector<double>(static_cast<std::size_t>(places.rows()), 1)}};
  });
  const fs::path moved = fs::path(file).replace_filename("moved_" + file.filename().string());
  const auto remove = [&] {
    for (const fs::path& made : {moved, registration::values_name("size", moved)}) {
      std::error_code ignored;
      fs::remove(made, ignored);
    }
  };
  try {
    warp(file, mover, moved);
  } catch (...) {
    remove();
    throw;
  }
  remove();
}

/// Arrays of three kinds in turn, to the end.
void read_archive(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  solve::ArchiveReader reader(bytes);
  try {
    while (!reader.at_end()) {
      std::uint8_t flag = 0;
      std::vector<std::int32_t> numbers;
      std::vector<double> values;
      Points points;
      reader.plain(flag);
      reader.many(numbers);
      reader.many(values);
      reader.points(points);
    }
  } catch (const std::length_error&) {
  }
}

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all = {
      {"archive", {".bin", read_archive}},
      {"curve", {".csv", [](const fs::path& file) { solve::read_load_curve(file, solve::LoadCurve::Join::smooth); }}},
      {"dicom", {".dcm", [](const fs::path& file) { read_dicom_slice(file); }}},
      {"fcsv", {".fcsv", [](const fs::path& file) { PointsFile{file}; }}},
      {"gii", {".gii", [](const fs::path& file) { registration::check_gii_claims(file); }}},
      {"legacy_vtk", {".vtk", [](const fs::path& file) { check_legacy_vtk_claims(file); }}},
      {"load", {".csv", [](const fs::path& file) { solve::read_craniotomy_csv(file); }}},
      {"markups", {".mrk.json", [](const fs::path& file) { PointsFile{file}; }}},
      {"meta", {".mha", [](const fs::path& file) { check_header(file, read_meta_header(file), 1); }}},
      {"mgh", {".mgh", [](const fs::path& file) { check_header(file, read_mgh_header(file), 1); }}},
      {"nifti", {".nii", [](const fs::path& file) { check_header(file, read_nifti_header(file), 1); }}},
      {"nifti_gz", {".nii.gz", [](const fs::path& file) { check_header(file, read_nifti_header(file), 1); }}},
      {"nrrd", {".nrrd", [](const fs::path& file) { check_header(file, read_nrrd_header(file), 1); }}},
      {"obj", {".obj", [](const fs::path& file) { read_obj(file); }}},
      {"ply", {".ply", [](const fs::path& file) { check_ply_claims(file); }}},
      {"points", {".csv", [](const fs::path& file) { PointsFile{file}; }}},
      {"tck", {".tck", [](const fs::path& file) { warp_tracts(file, registration::warp_tck); }}},
      {"trk", {".trk", [](const fs::path& file) { warp_tracts(file, registration::warp_trk); }}},
      {"vtk", {".vtp", [](const fs::path& file) { check_vtk_claims(file); }}},
  };
  return all;
}

const Reader* reader = nullptr;
fs::path file;

void choose_reader(const std::string& name) {
  const auto found = readers().find(name);
  if (found == readers().end()) {
    std::fprintf(stderr, "--reader= must be one of:");
    for (const auto& [known, unused] : readers()) {
      std::fprintf(stderr, " %s", known.c_str());
    }
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  reader = &found->second;
  file = fs::temp_directory_path() / ("brainshift-fuzz-" + std::to_string(getpid()) + reader->ending);
  std::atexit([] { std::remove(file.c_str()); });
}

/// A refusal says which file.
void check_refusal(std::string_view said) {
  if (!said.starts_with(file.string())) {
    std::fprintf(stderr, "refused without the file's name: %s\n", said.data());
    std::abort();
  }
}

}  // namespace
}  // namespace brainshift

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  std::string name;
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    name = argument.starts_with("--reader=") ? argument.substr(9) : name;
  }
  brainshift::choose_reader(name);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using brainshift::file;
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    brainshift::check_readable(file);
    brainshift::reader->read(file);
  } catch (const std::invalid_argument& fault) {
    brainshift::check_refusal(fault.what());
  }
  return 0;
}
