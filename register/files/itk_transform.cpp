// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/files/itk_transform.hpp"

#include <hdf5.h>
#include <itkBSplineBaseTransform.h>
#include <itkCompositeTransform.h>
#include <itkDisplacementFieldTransform.h>
#include <itkHDF5TransformIO.h>
#include <itkMatlabTransformIO.h>
#include <itkTransformFileReader.h>
#include <itkTxtTransformIO.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift::registration {

namespace {

namespace fs = std::filesystem;
using Transform = itk::Transform<double, 3, 3>;
using Spline = itk::BSplineBaseTransform<double, 3, 3>;
using Point = Transform::InputPointType;

/// Where one transform takes a place.
std::optional<Point> taken(const Transform& transform, const Point& place) {
  if (const auto* several = dynamic_cast<const itk::CompositeTransform<double, 3>*>(&transform)) {
    std::optional<Point> at = place;
    for (itk::SizeValueType n = several->GetNumberOfTransforms(); n > 0 && at; --n) {  // the last one acts first
      at = taken(*several->GetNthTransformConstPointer(n - 1), *at);
    }
    return at;
  }
  if (const auto* field = dynamic_cast<const itk::DisplacementFieldTransform<double, 3>*>(&transform)) {
    itk::ContinuousIndex<double, 3> index;
    if (!field->GetDisplacementField()->TransformPhysicalPointToContinuousIndex(place, index)) {
      return std::nullopt;
    }
    const Point to = field->TransformPoint(place);
    const bool known = std::none_of(to.Begin(), to.End(), [](double along) { return std::isnan(along); });
    return known ? std::optional(to) : std::nullopt;
  }
  if (const auto* spline = dynamic_cast<const Spline*>(&transform)) {
    Point to;
    bool inside = false;
    Spline::WeightsType weights(spline->GetNumberOfWeights());
    Spline::ParameterIndexArrayType indices(spline->GetNumberOfWeights());
    spline->TransformPoint(place, to, weights, indices, inside);
    return inside ? std::optional(to) : std::nullopt;
  }
  return transform.TransformPoint(place);
}

itk::TransformIOBaseTemplate<double>::Pointer reader_of(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".mat") {
    return itk::MatlabTransformIOTemplate<double>::New().GetPointer();
  }
  if (ending == ".h5" || ending == ".hdf5") {
    return itk::HDF5TransformIOTemplate<double>::New().GetPointer();
  }
  return itk::TxtTransformIOTemplate<double>::New().GetPointer();
}

/// A composite transform has no parameters of its own. Where a text file gives it some, or empty ones, ITK crashes.
void refuse_parameters_of_composite(const fs::path& file) {
  std::ifstream in(file);
  bool composite = false;
  for (std::string line; std::getline(in, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    if (line.starts_with("Transform:")) {
      composite = line.find("CompositeTransform") != std::string::npos;
    } else if (composite && (line.starts_with("Parameters:") || line.starts_with("FixedParameters:"))) {
      refuse(file, "gives its composite transform the line '" + line.substr(0, line.find(':') + 1) +
                       "', but that has no parameters of its own; take Parameters and FixedParameters out there");
    }
  }
}

Transform::ConstPointer read_itk(const fs::path& file) {
  if (const std::string ending = ending_of(file); ending == ".tfm" || ending == ".txt") {
    refuse_parameters_of_composite(file);
  }
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what goes wrong is thrown, not printed
  const auto reader = itk::TransformFileReaderTemplate<double>::New();
  try {
    reader->SetTransformIO(reader_of(file));
    reader->SetFileName(file.string());
    reader->Update();
  } catch (...) {  // not all that HDF5 throws is a std::exception
    refuse(file, "is no ITK transform (.h5, .tfm, .txt, .mat), damaged, or of a kind that is not known");
  }
  if (reader->GetTransformList()->size() != 1) {
    refuse(file, "holds " + std::to_string(reader->GetTransformList()->size()) +
                     " transforms side by side; write one composite transform");
  }
  const auto* transform = dynamic_cast<const Transform*>(reader->GetTransformList()->front().GetPointer());
  if (transform == nullptr) {
    refuse(file, "holds a transform that is not of three dimensions");
  }
  return transform;
}

}  // namespace

bool is_transform_file(const fs::path& file) {
  constexpr std::array<const char*, 5> endings = {".h5", ".hdf5", ".tfm", ".txt", ".mat"};
  return std::ranges::find(endings, ending_of(file)) != endings.end();
}

std::function<std::optional<std::array<double, 3>>(const std::array<double, 3>&)> read_itk_transform(
    const fs::path& file) {
  const Transform::ConstPointer transform = read_itk(file);
  return [transform](const std::array<double, 3>& place) -> std::optional<std::array<double, 3>> {
    const std::optional<Point> to = taken(*transform, Point(place.data()));
    return to ? std::optional(std::array{(*to)[0], (*to)[1], (*to)[2]}) : std::nullopt;
  };
}

}  // namespace brainshift::registration
