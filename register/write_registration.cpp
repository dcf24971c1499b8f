// SPDX-License-Identifier: GPL-3.0-or-later

#include "register/registration.hpp"

#include <omp.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <future>
#include <iomanip>
#include <string>
#include <vector>

#include "register/files/register_fields.hpp"
#include "register/files/transform_files.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/text_lines.hpp"

namespace brainshift::registration {

namespace {

/// A field of a .csv, on one line; one that began with # would be a comment.
std::string field_of(std::string name) {
  if (name.find_first_of(",\"\n\r#") == std::string::npos) {
    return name;
  }
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return quoted_field(name);
}

/// Its name, or where it has none of its own its number, unless another is called so.
std::string label_of(const std::vector<std::string>& names, std::size_t landmark) {
  const bool named = landmark < names.size() && !names[landmark].empty() &&
                     std::count(names.begin(), names.end(), names[landmark]) == 1;
  std::string label = named ? names[landmark] : std::to_string(landmark + 1);
  while (!named && std::count(names.begin(), names.end(), label) > 0) {
    label.insert(0, "landmark ");
  }
  return field_of(label);
}

void write_landmarks(const std::filesystem::path& file, const Registration& registration) {
  const Points &preop = registration.preop_landmarks, &intraop = registration.landmarks;
  const std::vector<double>& error = registration.landmark_error;
  std::ofstream out(file);
  out << "# frame: LPS\n# unit: mm\nlabel,x,y,z,intraop_x,intraop_y,intraop_z,ux,uy,uz"
      << (error.empty() ? "\n" : ",estimated_error\n") << std::fixed << std::setprecision(6);
  for (Eigen::Index p = 0; p < preop.rows(); ++p) {
    out << label_of(registration.landmark_names, static_cast<std::size_t>(p));
    const Eigen::RowVector3d moved = intraop.row(p) - preop.row(p);
    for (const Eigen::RowVector3d& triple :
         {Eigen::RowVector3d(preop.row(p)), Eigen::RowVector3d(intraop.row(p)), moved}) {
      out << ',' << triple.x() << ',' << triple.y() << ',' << triple.z();
    }
    if (!error.empty()) {
      out << ',';
      if (const double known = error[static_cast<std::size_t>(p)]; !std::isnan(known)) {
        out << known;
      }
    }
    out << '\n';
  }
  if (!out.flush()) {
    fail_to_write(file);
  }
}

}  // namespace

void write_registration(const std::filesystem::path& folder, const Registration& registration) {
  // The transforms go beside the images: each has parts on one thread, which the other's fill up. Not beside each
  // other: HDF5 knows no threads.
  const int threads = omp_get_max_threads();
  const auto when = threads > 1 ? std::launch::async : std::launch::deferred;
  std::future<void> transforms = std::async(when, [&folder, &registration, threads] {
    omp_set_num_threads(threads);  // OpenMP keeps it for each thread
    write_transform_files(folder, registration.resampling, registration.forward);
  });
  write_image(folder / "intraop_to_preop.nii.gz", registration.resampling);
  write_image(folder / "preop_to_intraop.nii.gz", registration.forward);
  if (!registration.warped.voxels.empty()) {
    write_image(folder / "warped.nii.gz", registration.warped);
  }
  write_image(folder / "jacobian.nii.gz", registration.jacobian);
  if (registration.warped_labels) {
    write_image(folder / "warped_labels.nii.gz", *registration.warped_labels);
  }
  if (registration.removed) {
    write_image(folder / removed_name, *registration.removed);
  }
  if (registration.landmarks.rows() > 0) {
    write_landmarks(folder / "landmarks.csv", registration);
  }
  transforms.get();
}

}  // namespace brainshift::registration
