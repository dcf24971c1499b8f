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
#include "segmentation/files/ply_claims.hpp"
#include "segmentation/files/points_file.hpp"
#include "segmentation/files/read_obj.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/vtk_claims.hpp"
#include "segmentation/image/dicom_slice.hpp"
#include "segmentation/image/image_header.hpp"
#include "solve/interface/load_curve.hpp"
#include "solve/load/craniotomy_load.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

struct Reader {
  std::string ending;
  std::function<void(const fs::path& file)> read;
};

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all = {
      {"curve", {".csv", [](const fs::path& file) { solve::read_load_curve(file, solve::LoadCurve::Join::smooth); }}},
      {"dicom", {".dcm", [](const fs::path& file) { read_dicom_slice(file); }}},
      {"fcsv", {".fcsv", [](const fs::path& file) { PointsFile{file}; }}},
      {"gii", {".gii", [](const fs::path& file) { registration::check_gii_claims(file); }}},
      {"load", {".csv", [](const fs::path& file) { solve::read_craniotomy_csv(file); }}},
      {"markups", {".mrk.json", [](const fs::path& file) { PointsFile{file}; }}},
      {"meta", {".mha", [](const fs::path& file) { check_header(file, read_meta_header(file), 1); }}},
      {"nifti", {".nii", [](const fs::path& file) { check_header(file, read_nifti_header(file), 1); }}},
      {"nifti_gz", {".nii.gz", [](const fs::path& file) { check_header(file, read_nifti_header(file), 1); }}},
      {"nrrd", {".nrrd", [](const fs::path& file) { check_header(file, read_nrrd_header(file), 1); }}},
      {"obj", {".obj", [](const fs::path& file) { read_obj(file); }}},
      {"ply", {".ply", [](const fs::path& file) { check_ply_claims(file); }}},
      {"points", {".csv", [](const fs::path& file) { PointsFile{file}; }}},
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
