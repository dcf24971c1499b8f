// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/extremes/row.hpp"

namespace brainshift::extremes {

/// A block between frictionless plates, its height changed by the factor `stretch` along z, its sides free: the
/// stretches are uniform, whatever the law.
struct Block {
  Eigen::Vector3d size;  ///< mm; from the origin
  double stretch;
  solve::Material material = {3000, 0.49, 1000};

  solve::Model model(NodeCloud cloud, BackgroundCells cells) const;

  /// Strain energy on paper, mJ.
  double energy() const;

  /// Of an answer against the one on paper: the largest error of a displacement, in percent of what is imposed, and
  /// that of the force.
  std::vector<Measured> errors(const solve::SolveResult& result, double most_displacement, double most_force) const;

 private:
  Eigen::Matrix3d exact() const;
};

inline const std::string on_paper = "uniform stretch, on paper";

}  // namespace brainshift::extremes
