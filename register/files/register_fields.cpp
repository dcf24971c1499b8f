// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/register_fields.hpp"

#include "segmentation/files/refuse.hpp"

namespace brainshift::registration {

namespace {

constexpr const char* forward_name = "preop_to_intraop.nii.gz";
constexpr const char* resampling_name = "intraop_to_preop.nii.gz";

}  // namespace

RegisterFields::RegisterFields(std::filesystem::path folder, Towards towards)
    : folder_(std::move(folder)), towards_(towards) {
  for (const char* name : {forward_name, resampling_name}) {
    if (!std::filesystem::exists(folder_ / name)) {
      refuse(folder_, std::string("there is no ") + name + " in it; give the --out folder of a finished run");
    }
  }
}

const VectorImage& RegisterFields::read(bool forward) {
  std::optional<VectorImage>& field = forward ? forward_ : resampling_;
  if (!field) {
    field = read_vector_image(folder_ / (forward ? forward_name : resampling_name));
  }
  return *field;
}

}  // namespace brainshift::registration
