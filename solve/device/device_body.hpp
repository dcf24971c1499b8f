// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "solve/body/body.hpp"
#include "solve/device/clusters.hpp"
#include "solve/device/memory.hpp"
#include "solve/dynamics/relaxation_rules.hpp"

namespace brainshift::solve::device {

/// A body in the memory of a device, at rest.
template <class Scalar>
class DeviceBody {
 public:
  /// body: one that why_not() has nothing against. window: steps between two looks. Throws DeviceFault.
  DeviceBody(const Backend& backend, const Body& body, int window = usual_window);

  /// Takes the conditions and the contact of the same body under another load. Where the same nodes are held exactly as
  /// before, their rows are taken to be the same, and so is the contact.
  void load(const Body& body);

  /// What the steps of an earlier way to rest have left is gone.
  void forget_steps() const;

  const Backend& backend() const { return backend_; }
  const View<Scalar>& view() const { return view_; }
  std::size_t nodes() const { return static_cast<std::size_t>(view_.nodes); }

  /// Of the device's memory that it takes.
  std::size_t bytes() const { return memory_.bytes(); }

  void perform(Task task, const Order& order) const { backend_.perform(task, view_, order); }
  Record record() const;

  NodalVectors read(const double* vectors) const;
  void write(const NodalVectors& values, double* vectors) const;
  std::vector<double> masses() const;

  /// Of which masses, one a node, Task::weigh was done last, for the conditions and the contact that it has; none: it
  /// is to be done. Whoever does it notes that here.
  const std::vector<double>& weighed() const { return weighed_; }
  void note_weighed(std::vector<double> mass) { weighed_ = std::move(mass); }

  /// Multipliers of both parities lie one after the other, and in each those of the three components.
  const double* multipliers(int parity) const { return view_.condition[0].multiplier[parity]; }
  std::size_t conditions() const { return conditions_; }

  /// Room to keep û and multipliers in.
  double* kept_displacement;
  double* kept_multipliers;

 private:
  void put_points(const PointBlocks& points);
  void put_laws(const Body& body);
  void put_motion(const Body& body, int window);
  void put_skull(const SignedDistance& skull);
  void put_contact(const Contact& contact);
  void put_conditions(const EssentialConditions& essential);

  const Backend& backend_;
  Memory memory_;
  View<Scalar> view_{};
  std::size_t of_body_ = 0;                                       ///< pieces of memory that no load changes
  std::optional<std::array<std::vector<std::int32_t>, 3>> held_;  ///< nodes of each component; absent: springs
  std::size_t conditions_ = 0;                                    ///< of the three components
  std::vector<double> weighed_;
};

/// Why a body cannot be relaxed on a device, as the end of a sentence; empty: it can.
std::string why_not(const Body& body);

}  // namespace brainshift::solve::device
