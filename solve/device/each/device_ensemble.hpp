// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "solve/body/body.hpp"
#include "solve/device/clusters.hpp"
#include "solve/device/each/perform_each.hpp"
#include "solve/device/memory.hpp"
#include "solve/ensemble/member.hpp"

namespace brainshift::solve::device {

/// A body in the memory of a device, and up to `most_members` loads of it at a time.
template <class Scalar>
class DeviceEnsemble {
 public:
  /// body: one that why_not_together() has nothing against; must outlive this. with_forces: some load has any. Throws
  /// DeviceFault.
  DeviceEnsemble(const Backend& backend, const Body& body, bool with_forces);

  /// Puts other loads in the place of those before, all undeformed and at rest, whatever their starts.
  void load(std::span<const Member> loads);

  /// These, as vectors at the nodes.
  std::vector<double> starts(std::span<const Member> loads) const;

  const Backend& backend() const { return backend_; }
  const ViewOfEach<Scalar>& view() const { return view_; }
  std::size_t nodes() const { return static_cast<std::size_t>(view_.nodes); }
  std::size_t values() const { return 3 * nodes() * most_members; }  ///< of vectors at the nodes

  /// Of the device's memory that it takes.
  std::size_t bytes() const { return memory_.bytes(); }

  /// Of each member's load, [most_steps + 1][member], for what is performed next.
  void set_fractions(const std::vector<double>& fractions) const { put(fractions, view_.fraction); }
  void perform(TaskOfEach task, const OrderOfEach& order) const { perform_each(backend_, task, view_, order); }
  void read(RecordOfEach& record) const { backend_.from_device(&record, view_.record, sizeof record); }
  std::vector<double> read(const double* from, std::size_t count) const;
  void write(const std::vector<double>& values, double* to) const;

 private:
  template <class Number>
  void put(const std::vector<Number>& values, Number* to) const {
    backend_.to_device(to, values.data(), values.size() * sizeof(Number));
  }
  void put_points();
  void put_motion(bool with_forces);
  void put_contact(const Contact& contact);
  void put_conditions();
  void load_laws(std::span<const Member> loads);
  void load_conditions(std::span<const Member> loads);

  const Backend& backend_;
  const Body& body_;
  Memory memory_;
  ViewOfEach<Scalar> view_{};
  std::size_t conditions_ = 0;  // of the three components
};

/// 4 a node as NodalVectors have it, of the member-th of vectors of each.
NodalVectors vectors_of_member(const std::vector<double>& of_each, std::size_t member);

/// Why loads cannot be stepped together on a device, as the end of a sentence about the body; empty: they can.
std::string why_not_together(const Body& body, std::span<const Member> loads);

}  // namespace brainshift::solve::device
