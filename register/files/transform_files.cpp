// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/transform_files.hpp"

#include <string>
#include <string_view>

#include "register/field/moving_part.hpp"
#include "register/files/out_stream.hpp"
#include "register/files/write_slicer_field.hpp"
#include "register/files/write_transform.hpp"

namespace brainshift::registration {

namespace {

constexpr std::string_view image_note = R"json({
  "From": "preop",
  "To": "intraop",
  "Mode": "image",
  "Moves": "preop images and label maps to the intraop brain; in 3D Slicer everything, points and surfaces, too",
  "Values": "at an intraop place: the displacement to where that tissue lay preop",
  "Frame": "LPS",
  "Unit": "mm",
  "Files": {
    "from-preop_to-intraop_mode-image_xfm.h5": "ITK DisplacementFieldTransform, cut to the part that moves",
    "from-preop_to-intraop_mode-image_xfm.nrrd": "the same as a displacement field of 3D Slicer, type resampling",
    "intraop_to_preop.nii.gz": "the same on the grid of the T1, as ANTs, elastix and plastimatch read it"
  },
  "Commands": {
    "brainshift": "brainshift warp RUN FILE --out DIR",
    "3D Slicer": "load the .h5 or the .nrrd, put the data under it",
    "ANTs": "antsApplyTransforms -d 3 -i t1.nii.gz -r t1.nii.gz -t from-preop_to-intraop_mode-image_xfm.h5 -o OUT",
    "SimpleITK": "Resample(t1, t1, ReadTransform('from-preop_to-intraop_mode-image_xfm.h5'))"
  }
}
)json";

constexpr std::string_view point_note = R"json({
  "From": "preop",
  "To": "intraop",
  "Mode": "points",
  "Moves": "preop points, surfaces and tracts to the intraop brain; not for 3D Slicer, which takes mode-image for all",
  "Values": "at a preop place: the displacement to where that tissue lies intraop",
  "Frame": "LPS",
  "Unit": "mm",
  "Files": {
    "from-preop_to-intraop_mode-points_xfm.h5": "ITK DisplacementFieldTransform, cut to the part that moves",
    "preop_to_intraop.nii.gz": "the same on the grid of the T1, as ANTs, elastix and plastimatch read it"
  },
  "Commands": {
    "brainshift": "brainshift warp RUN FILE --out DIR",
    "ANTs": "antsApplyTransformsToPoints -d 3 -i points.csv -t from-preop_to-intraop_mode-points_xfm.h5 -o OUT",
    "SimpleITK": "ReadTransform('from-preop_to-intraop_mode-points_xfm.h5').TransformPoint(p)"
  }
}
)json";

void write_note(const std::filesystem::path& file, std::string_view note) {
  OutStream out(file);
  out.write(note.data(), note.size());
  out.finish();
}

}  // namespace

void write_transform_files(const std::filesystem::path& folder, const VectorImage& resampling,
                           const VectorImage& forward) {
  const auto file = [&folder](const char* name, const char* ending) { return folder / (std::string(name) + ending); };
  const VectorImage part = moving_part(resampling);
  write_transform(file(image_transform, ".h5"), part);
  write_slicer_field(file(image_transform, ".nrrd"), part);
  write_note(file(image_transform, ".json"), image_note);
  write_transform(file(point_transform, ".h5"), moving_part(forward));
  write_note(file(point_transform, ".json"), point_note);
}

}  // namespace brainshift::registration
