// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/cut/tearing.hpp"
#include "solve/cut/touched_rows.hpp"
#include "solve/lay_out.hpp"

namespace brainshift::solve {

class Matching;
class Motion;

/// Cuts a body further while it moves. Of its shape functions only those are evaluated again whose support the new part
/// of the cut, or a node that was split or added, can change; the parameters near it are chosen such that the
/// displacement at all nodes stays what it was.
class Dissection {
 public:
  /// prepared: with its cut and pieces; outlives this.
  Dissection(const Model& model, const SolveOptions& options, Prepared& prepared);

  /// Whether the cut has come at least half a spacing further by this time of the load's curve.
  bool is_due(double time) const { return next_ < times_.size() && times_[next_] <= time; }
  bool is_done() const { return next_ == times_.size(); }
  bool may_tear() const { return tearing_.has_value(); }

  /// Cuts the body as far as the cuts have come, and carries the motion over to it; laws: of its points, with what they
  /// remember. Throws std::invalid_argument where
  /// it would leave too few nodes together; then nothing has changed.
  void cut(double time, const PointLaws& laws, Motion& motion);

  /// Lets the body tear where its criterion is met at the last internal force; whether it did. A tear that would leave
  /// too few nodes together goes no further.
  bool tear(const PointLaws& laws, Motion& motion, bool may_begin);

  const Points& positions() const { return prepared_.cut->cloud.positions; }  ///< in the cloud's order, mm
  CutFacets facets() const { return prepared_.cut->visibility ? prepared_.cut->visibility->facets() : CutFacets(); }
  const CutMeasures& measures() const { return measures_; }

 private:
  std::vector<std::int32_t> take_over_nodes(std::size_t first_pair);
  /// Returns the number before of each integration point in the order of the patches.
  std::vector<std::int32_t> update_points(const Advance& advance, const ShapeFunctions& shape, Matching& match);
  Prepared laid_out_again();
  void advance(const CutFacets& fresh, const PointLaws& laws, Motion& motion);
  void go_on(const CutFacets& fresh, const PointLaws& laws, Motion& motion);
  bool tear(const Tear& tear, const PointLaws& laws, Motion& motion);

  const Model& model_;
  const SolveOptions& options_;
  Prepared& prepared_;
  double spacing_;             ///< mean, mm
  std::vector<double> times_;  ///< at which to cut, ascending
  std::vector<Cut> cuts_;      ///< of the model, then those torn
  double until_ = 0;           ///< the cuts' time so far
  std::optional<Tearing> tearing_;
  std::vector<Eigen::Vector3d> closed_;  ///< ends at other cuts: no fronts
  std::size_t next_ = 0;
  CutMeasures measures_;
};

}  // namespace brainshift::solve
