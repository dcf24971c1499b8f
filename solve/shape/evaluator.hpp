// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "solve/cut/visibility.hpp"
#include "solve/shape/moving_least_squares.hpp"
#include "solve/shape/shape_functions.hpp"
#include "solve/shape/support_search.hpp"

namespace brainshift::solve {

struct ShapeFunctions::Impl {
  Points positions;
  ShapeOptions options;
  SupportSearch search;
  std::shared_ptr<const Visibility> visibility;

  Impl(const Points& p, std::span<const double> spacing, const ShapeOptions& o, std::shared_ptr<const Visibility> v);
};

/// A point to evaluate at.
struct Place {
  Eigen::Vector3d at;
  std::int32_t point;
};

Ball ball_about(std::span<const Place> points);

/// The nodes that places in a ball may see. scale: of the supports.
Candidates candidates_near(const ShapeFunctions::Impl& impl, const Ball& ball, double scale);

/// Evaluates the shape functions at some neighbouring points, a lane each; owned by one thread.
class Evaluator {
 public:
  explicit Evaluator(const ShapeFunctions::Impl& impl);

  /// Finds admissible supports of the points, at most as many as there are lanes, growing them where needed: calls
  /// use(found) with the lanes where that was enough, as long as sights and slopes are theirs. near: all nodes near the
  /// points. Returns a lane for which there is none, or -1.
  template <class Use>
  int move_to(std::span<const Place> points, const Candidates& near, const Use& use) {
    Places places{};
    Mask wanted{};
    place(points, places, wanted);
    for (scale_ = 1; scale_ < largest_growth && any(wanted); scale_ *= growth) {
      for (int l = 0; l < lanes; ++l) {
        places.unwanted[l] = wanted[l] != 0 ? 0 : std::numeric_limits<double>::infinity();
      }
      if (grown()) {
        fit(places, candidates_near(impl_, places.ball, scale_));
      } else {
        fit(places, near);
      }
      const Mask found = wanted & fit_.admissible;
      if (any(found)) {
        use(found);
      }
      wanted &= ~found;
    }
    return first_of(wanted);
  }

  bool grown() const { return scale_ > 1; }
  std::int64_t support_size(int lane) const { return fit_.count[lane]; }
  std::span<const Sight> sights() const { return std::span(sights_).first(count_); }
  std::span<const Slope> slopes();

 private:
  static constexpr double growth = 1.1;        // of a support that is not admissible, each try
  static constexpr double largest_growth = 8;  // beyond it the cloud is degenerate

  static void place(std::span<const Place> points, Places& places, Mask& wanted);
  static int first_of(const Mask& mask);
  void fit(const Places& places, const Candidates& near);
  void look_past_cut(const Places& places);
  void look_past_cut(int lane, const Eigen::Vector3d& x);

  const ShapeFunctions::Impl& impl_;
  FitOptions options_;
  Fit fit_;
  double scale_ = 1;
  std::size_t count_ = 0;
  std::vector<Sight> sights_;  ///< count_ of them count
  std::vector<Pull> pulls_;    ///< one a sight where a cut is near, else none
  std::vector<Slope> slopes_;
};

}  // namespace brainshift::solve
