// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solve/body/body.hpp"
#include "solve/device/clusters.hpp"
#include "solve/device/memory.hpp"

namespace brainshift::solve::device {

/// A body in the memory of a device, at rest.
template <class Scalar>
class DeviceBody {
 public:
  /// body: one that why_not() has nothing against. Throws DeviceFault.
  DeviceBody(const Backend& backend, const Body& body);

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

  /// Multipliers of both parities lie one after the other, and in each those of the three components.
  const double* multipliers(int parity) const { return view_.condition[0].multiplier[parity]; }
  std::size_t conditions() const { return conditions_; }

  /// Room to keep û and multipliers in.
  double* kept_displacement;
  double* kept_multipliers;

 private:
  void put_points(const PointBlocks& points);
  void put_laws(const Body& body);
  void put_motion(const Body& body);
  void put_rows(const CompressedRows& rows, SparseRows& to);
  void put_contact(const Contact& contact);
  void put_conditions(const EssentialConditions& essential);

  const Backend& backend_;
  Memory memory_;
  View<Scalar> view_{};
  std::size_t conditions_ = 0;  ///< of the three components
};

/// Why a body cannot be relaxed on a device, as the end of a sentence; empty: it can.
std::string why_not(const Body& body);

}  // namespace brainshift::solve::device
