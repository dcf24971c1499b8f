// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/track_scalars.hpp"

#include <bit>
#include <limits>
#include <sstream>

#include "register/files/byte_order.hpp"
#include "register/files/warped_name.hpp"

namespace brainshift::registration {

namespace {

std::string scalar_header(const std::string& of_tracts) {
  std::string text = "mrtrix track scalars\n";
  std::istringstream lines(of_tracts);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("datatype:") && !line.starts_with("file:")) {
      text += line + "\n";
    }
  }
  text += "datatype: Float32LE\nfile: . ";
  constexpr std::size_t room = 32;  // for the place of the numbers, and END
  const std::size_t numbers_at = text.size() + room;
  text += std::to_string(numbers_at) + "\nEND\n";
  text.resize(numbers_at);
  return text;
}

}  // namespace

TrackScalars::TrackScalars(const std::filesystem::path& tck, const std::string& header, const PointMover& mover)
    : mover_(mover) {
  const std::string text = scalar_header(header);
  for (const PointValues& each : mover.finite_values(Points(0, 3))) {
    files_.push_back(std::make_unique<OutStream>(values_name(each.name, tck)));
    files_.back()->write(text.data(), text.size());
  }
}

void TrackScalars::write(std::size_t file, float value) {
  const float little = std::endian::native == std::endian::little ? value : with_bytes_swapped(value);
  files_[file]->write(&little, sizeof(little));
}

void TrackScalars::add(const Eigen::Vector3d& place) {
  if (!files_.empty()) {
    places_.push_back(place);
  }
}

void TrackScalars::end_tract() {
  Points places(static_cast<Eigen::Index>(places_.size()), 3);
  for (std::size_t p = 0; p < places_.size(); ++p) {
    places.row(static_cast<Eigen::Index>(p)) = places_[p];
  }
  places_.clear();
  const std::vector<PointValues> values = files_.empty() ? std::vector<PointValues>{} : mover_.finite_values(places);
  for (std::size_t file = 0; file < files_.size(); ++file) {
    for (const double value : values[file].values) {
      write(file, static_cast<float>(value));
    }
    write(file, std::numeric_limits<float>::quiet_NaN());
  }
}

void TrackScalars::finish() {
  if (!places_.empty()) {
    end_tract();
  }
  for (std::size_t file = 0; file < files_.size(); ++file) {
    write(file, std::numeric_limits<float>::infinity());
    files_[file]->finish();
  }
}

}  // namespace brainshift::registration
