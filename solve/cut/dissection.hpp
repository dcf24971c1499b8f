// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solve/body/body_parts.hpp"
#include "solve/cut/cut_body.hpp"
#include "solve/cut/tearing.hpp"
#include "solve/dynamics/body_change.hpp"
#include "solve/interface/options.hpp"
#include "solve/interface/result.hpp"

namespace brainshift::solve {

class Matching;
class ShapeFunctions;
struct Advance;

/// Cuts a body further while it moves, and lets it tear. Of its shape functions only those are evaluated again whose
/// support the new part of the cut, or a node that was split or added, can change; the parameters near it are chosen
/// such that the displacement at all nodes stays what it was.
class Dissection {
 public:
  /// The body as it is cut at the start, and the parts that it was laid out from. model and options outlive this.
  Dissection(const Model& model, const SolveOptions& options, CutBody cut, BodyParts parts);

  /// What time stepping asks, see BodyChange. Throws TooFewNodes where a cut would leave too few nodes together; a tear
  /// that would goes no further instead. This outlives what it returns.
  BodyChange change();

  const CutBody& body() const { return now_.cut; }
  const CutMeasures& measures() const { return measures_; }

 private:
  /// What an advance makes anew.
  struct State {
    CutBody cut;
    BodyParts parts;
  };

  bool is_due(double time) const { return next_ < times_.size() && times_[next_] <= time; }
  std::optional<ChangedBody> next(const Moment& moment);
  ChangedBody cut(double time, const Body& body);
  std::vector<Tear> tears_at(const Moment& moment) const;
  std::optional<ChangedBody> tear(const Tear& tear, const Body& body);
  CutFacets facets_now() const;
  ChangedBody advance(const CutFacets& fresh, const Body& body);
  std::vector<std::int32_t> touched_nodes(const Advance& advance, const BodyParts& parts) const;
  void update_nodes(std::span<const std::int32_t> touched, const ShapeFunctions& shape, Matching& match,
                    BodyParts& parts) const;
  std::size_t update_points(const Advance& advance, const ShapeFunctions& shape, Matching& match,
                            BodyParts& parts) const;

  const Model& model_;
  const SolveOptions& options_;
  State now_;
  double spacing_;             ///< mean, mm
  std::vector<double> times_;  ///< at which to cut, ascending
  std::vector<Cut> cuts_;      ///< of the model, then those torn
  double until_ = 0;           ///< the cuts' time so far
  std::optional<Tearing> tearing_;
  std::optional<std::vector<Tear>> pending_;  ///< still to be made between the same two steps; absent: not looked for
  std::vector<Eigen::Vector3d> closed_;       ///< ends at other cuts: no fronts
  std::size_t next_ = 0;
  CutMeasures measures_;
};

}  // namespace brainshift::solve
