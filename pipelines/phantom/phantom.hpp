// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/phantom/head.hpp"
#include "pipelines/phantom/opening.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/options/option.hpp"

namespace brainshift::pipelines {

/// How the image's grid lies in the world. The head in the world is the same in each.
enum class PhantomFrame : std::uint8_t {
  oblique,   ///< turned by 25° about an oblique axis
  mirrored,  ///< two axes exchanged and turned round: a left-handed direction matrix
};

struct PhantomOptions {
  int size = 96;         ///< voxels along each axis
  double spacing = 2.0;  ///< of the voxels, mm; the head grows with size · spacing and is natural at 192 mm
  PhantomFrame frame = PhantomFrame::oblique;
  double csf_gap = 0;      ///< fluid between brain and skull in a head of natural size, mm; 0: they touch
  std::uint64_t seed = 1;  ///< of the texture
};

/// Name, range, unit and help of each, the frame aside.
const OptionTable<PhantomOptions>& phantom_options();

struct Landmark {
  std::string name;
  Eigen::Vector3d position;  ///< preop, mm LPS
};

/// A synthetic head with its exact shapes, the image grid that samples it, and the load.
struct Phantom {
  Head head;
  ImageGeometry geometry;
  Opening opening;
  solve::CraniotomyLoad load;
  std::vector<Landmark> landmarks;
};

/// Throws std::invalid_argument on options out of range.
Phantom make_phantom(const PhantomOptions& options);

/// The label at each voxel's centre.
LabelMap sample_labels(const Phantom& phantom);

/// The T1-like image: each voxel the mean over eight places in it.
ScalarImage sample_t1(const Phantom& phantom, std::uint64_t seed);

/// Writes t1.nii.gz, labels.nii.gz, craniotomy.csv, landmarks.mrk.json, answers.json (what is known exactly) and
/// scene.xml, ready for `brainshift run OUT/scene.xml`. Makes the folder. Throws std::invalid_argument on options out
/// of range and std::runtime_error, naming the file, when it cannot be written.
void write_phantom(const PhantomOptions& options, const std::filesystem::path& out);

}  // namespace brainshift::pipelines
