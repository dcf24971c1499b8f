// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/device_body.hpp"

#include <type_traits>

#include "solve/device/device_fault.hpp"
#include "solve/device/rows.hpp"
#include "solve/device/slices.hpp"
#include "solve/dynamics/span_bound.hpp"
#include "solve/force/firmness.hpp"

namespace brainshift::solve::device {

namespace {

constexpr Eigen::Index most_conditions = 4096;  // of a component: their dense inverse is read in each step
constexpr std::int32_t fewest_points = 32;      // of a cluster

std::vector<Law> laws_of(const PointLaws& laws) {
  std::vector<Law> result;
  for (const ElasticLaw& elastic : laws.elastic) {
    std::visit(
        [&](const auto& law) {
          if constexpr (std::is_constructible_v<Law, decltype(law)>) {
            result.emplace_back(law);
          }
        },
        elastic);
  }
  return result;
}

template <class Scalar>
std::int32_t most_patches(const Clusters<Scalar>& clusters) {
  std::int32_t most = 0;
  for (const Cluster& c : clusters.clusters) {
    most = std::max(most, c.patches);
  }
  return most;
}

/// Of a block, bytes, without pairs that stay there.
template <class Scalar>
std::size_t room_of(const Clusters<Scalar>& clusters) {
  return Room<Scalar>::size(clusters.most_slots, clusters.most_points, most_patches(clusters), 0);
}

/// As many clusters as there are blocks, or a multiple, so that they fit.
template <class Scalar>
Clusters<Scalar> make_fitting_clusters(const PointBlocks& points, const Backend& backend) {
  const auto all = static_cast<std::int32_t>(points.points());
  const std::size_t room_of_points = Room<Scalar>::size(0, all, 0, 0) / static_cast<std::size_t>(backend.blocks);
  for (auto rounds = static_cast<std::int32_t>(room_of_points / backend.room) + 1;; ++rounds) {
    const std::int32_t wanted = std::clamp(all / fewest_points, 1, rounds * backend.blocks);
    Clusters<Scalar> made = make_clusters<Scalar>(points, wanted);
    if (room_of(made) <= backend.room) {
      return made;
    }
    if (wanted < rounds * backend.blocks) {
      throw DeviceFault(
          "a part of this body, as large patches or supports make it, is larger than what a multiprocessor of the GPU "
          "holds; take device cpu");
    }
  }
}

template <class Scalar>
std::int32_t turns_that_fit(const Slices<Scalar>& slices, std::size_t bytes) {
  std::int64_t most = 0;
  for (std::size_t c = 1; c < slices.cluster_begin.size(); ++c) {
    const auto turn = [&](std::size_t of) {
      return slices.turn_begin[static_cast<std::size_t>(slices.cluster_begin[of])];
    };
    most = std::max(most, turn(c) - turn(c - 1));
  }
  return static_cast<std::int32_t>(
      std::min<std::int64_t>(most, static_cast<std::int64_t>(bytes / Room<Scalar>::turn_size(1))));
}

std::vector<double> values_of(const Eigen::VectorXd& vector) {
  return {vector.begin(), vector.end()};
}

}  // namespace

std::string why_not(const Body& body) {
  const PointLaws& laws = body.laws;
  if (body.face_contact || body.wall_contact || body.septum_contact) {
    return "has a cut, a cavity or a septum";
  }
  if (!body.stiff_parts.empty()) {
    return "has a stiff part that soft tissue holds alone";
  }
  if (laws.plane_stress || laws.in_time || !laws.prony.empty() || !laws.swelling.empty()) {
    return "is in plane stress, moves in time or swells";
  }
  if (laws_of(laws).size() < laws.elastic.size()) {
    return "has a material with a law of its own";
  }
  if (laws.elastic.size() > most_materials) {
    return "has more than " + std::to_string(most_materials) + " materials";
  }
  for (const EssentialConditions::Component& c : body.essential.components()) {
    if (c.prescribed.size() > most_conditions) {
      return "has more than " + std::to_string(most_conditions) + " nodes with a prescribed displacement";
    }
  }
  return {};
}

template <class Scalar>
DeviceBody<Scalar>::DeviceBody(const Backend& backend, const Body& body, int window)
    : backend_(backend), memory_(backend) {
  put_points(body.points);
  put_laws(body);
  put_motion(body, window);
  if (body.contact) {
    put_skull(*body.contact->skull());
  }
  perform(Task::share_bounds, {});
  of_body_ = memory_.pieces();
  load(body);
}

template <class Scalar>
void DeviceBody<Scalar>::load(const Body& body) {
  std::array<std::vector<std::int32_t>, 3> nodes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nodes[axis] = body.essential.components()[axis].node;
  }
  const bool exactly = !body.essential.give_way();
  if (exactly && held_ == nodes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const EssentialConditions::Component& from = body.essential.components()[axis];
      memory_.replace(view_.condition[axis].prescribed, values_of(from.prescribed));
      memory_.replace(view_.condition[axis].loaded, values_of(from.loaded));
    }
    return;
  }
  held_.reset();
  weighed_.clear();
  memory_.go_back(of_body_);
  if (body.contact) {
    put_contact(*body.contact);
  }
  put_conditions(body.essential);
  if (exactly) {
    held_ = std::move(nodes);
  }
}

template <class Scalar>
void DeviceBody<Scalar>::forget_steps() const {
  backend_.clear(view_.record, sizeof(Record));
  if (view_.contact.count > 0) {
    backend_.clear(view_.contact.push, 3 * static_cast<std::size_t>(view_.contact.count) * sizeof(double));
  }
  for (const int parity : {0, 1}) {
    backend_.clear(view_.force_at[parity], 4 * nodes() * sizeof(double));
    backend_.clear(view_.condition[0].multiplier[parity], conditions_ * sizeof(double));
  }
}

template <class Scalar>
void DeviceBody<Scalar>::put_points(const PointBlocks& points) {
  const Clusters<Scalar> made = make_fitting_clusters<Scalar>(points, backend_);
  const Slices<Scalar> slices = make_slices(made);
  View<Scalar>& v = view_;
  v.clusters = static_cast<std::int32_t>(made.clusters.size());
  v.nodes = static_cast<std::int32_t>(points.nodes());
  v.most_slots = made.most_slots;
  v.most_points = made.most_points;
  v.most_patches = most_patches(made);
  v.resident = turns_that_fit(slices, backend_.room - room_of(made));
  v.cluster = memory_.put(made.clusters);
  v.patch = memory_.put(made.patches);
  v.patch_of = memory_.put(made.patch_of);
  std::vector<std::int32_t> material;
  for (const PatchPoints& patch : made.patches) {
    material.insert(material.end(), static_cast<std::size_t>(patch.points), patch.material);
  }
  v.material = memory_.put(material);
  v.volume = memory_.put(points.volume);
  v.mode = points.mode.empty() ? nullptr : memory_.put(points.mode);
  v.slice_begin = memory_.put(slices.cluster_begin);
  v.turn_begin = memory_.put(slices.turn_begin);
  v.slice_point = memory_.put(slices.point);
  v.slice_pair = memory_.put(slices.pairs);
  v.reach = memory_.put(slices.reach);
  v.slot_node = memory_.put(made.slot_node);
  v.slot_begin = memory_.put(made.slot_begin);
  v.slot_pair = memory_.put(made.slot_pairs);
  v.node_begin = memory_.put(made.node_begin);
  v.node_slot = memory_.put(made.node_slot);
  v.touch_begin = memory_.put(made.touch_begin);
  v.touch = memory_.put(made.touches);
  v.patch_touch_begin = memory_.put(made.patch_touch_begin);
  v.patch_touch = memory_.put(made.patch_touch);
  v.patch_touch_node = memory_.put(made.patch_touch_node);
  v.touch_norm = memory_.template room<SlotVector<double>>(made.touches.size());
  v.touch_reach = memory_.template room<double>(made.touches.size());
  v.point_bound = memory_.template room<SharedBound>(points.points());
  v.point_tangent = memory_.template room<double>(points.points());
  v.patch_bound = memory_.template room<SharedBound>(made.patches.size());
  v.patch_total = memory_.template room<SlotVector<double>>(made.patches.size());
  v.slot_force = memory_.template room<SlotVector<Scalar>>(made.slot_node.size());
  v.slot_bound = memory_.template room<double>(made.slot_node.size());
}

template <class Scalar>
void DeviceBody<Scalar>::put_laws(const Body& body) {
  view_.law = memory_.put(laws_of(body.laws));
  std::vector<double> firmness = node_firmness(body.points, shear_moduli(body.laws));
  firmness.resize(body.nodes(), 1.0);
  view_.firmness = memory_.put(firmness);
}

template <class Scalar>
void DeviceBody<Scalar>::put_motion(const Body& body, int window) {
  View<Scalar>& v = view_;
  const std::size_t values = 4 * body.nodes();
  for (double** vectors : {&v.displacement[0], &v.displacement[1], &v.displacement[2], &v.force_at[0], &v.force_at[1],
                           &v.mode_of_body, &v.place_at_look, &v.force_at_look, &kept_displacement}) {
    *vectors = memory_.template room<double>(values);
  }
  v.span_state =
      memory_.template room<double>(values * (2 * static_cast<std::size_t>(SpanBound::windows_of(window)) + 1));
  for (double** numbers : {&v.mass, &v.inverse_mass, &v.stiffer_mass}) {
    *numbers = memory_.template room<double>(body.nodes());
  }
  std::vector<double> external;
  for (const NodalVectors& at : body.external.at_fractions()) {
    external.insert(external.end(), at.begin(), at.end());
  }
  v.external_count = static_cast<std::int32_t>(external.size() / values);
  v.external = memory_.put(external);
  v.partial = memory_.template room<double>(static_cast<std::size_t>(backend_.blocks) * LookSums::count);
  v.record = memory_.template room<Record>(1);
}

template <class Scalar>
void DeviceBody<Scalar>::put_skull(const SignedDistance& skull) {
  view_.contact.skull = skull.grid();
  view_.contact.skull.sample = memory_.put(skull.samples().value);
}

template <class Scalar>
void DeviceBody<Scalar>::put_contact(const Contact& contact) {
  TouchingNodes& c = view_.contact;
  put_nodes(contact, nodes(), memory_, c);
  const std::size_t count = contact.nodes().size();
  c.inverse_row_sum = memory_.template room<double>(count);
  c.push = memory_.template room<double>(3 * count);
  c.pushed = memory_.template room<double>(4 * nodes());
}

template <class Scalar>
void DeviceBody<Scalar>::put_conditions(const EssentialConditions& essential) {
  conditions_ = 0;
  for (const EssentialConditions::Component& c : essential.components()) {
    conditions_ += static_cast<std::size_t>(c.prescribed.size());
  }
  double* multipliers[] = {memory_.template room<double>(conditions_), memory_.template room<double>(conditions_)};
  kept_multipliers = memory_.template room<double>(conditions_);
  double* const residual = memory_.template room<double>(conditions_);
  std::size_t before = 0;
  std::optional<CompressedRows> rows_before;
  std::vector<double> compliance_before;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const EssentialConditions::Component& from = essential.components()[axis];
    Conditions& c = view_.condition[axis];
    const CompressedRows rows = rows_of(from.shape);
    const auto count = static_cast<std::size_t>(from.prescribed.size());
    const std::vector<double> compliance = entries_of(from.compliance);
    put_rows(rows, memory_, c);
    c.prescribed = memory_.put(values_of(from.prescribed));
    c.loaded = memory_.put(values_of(from.loaded));
    c.compliance = compliance.empty() ? nullptr : memory_.put(compliance);
    c.residual = residual + before;
    c.multiplier[0] = multipliers[0] + before;
    c.multiplier[1] = multipliers[1] + before;
    c.own = !rows_before || !(rows == *rows_before) || compliance != compliance_before;
    c.inverse = c.own ? memory_.template room<double>(count * count) : view_.condition[axis - 1].inverse;
    c.panel = memory_.template room<double>(2 * pivots_at_once * count);
    c.diagonal = memory_.template room<double>(count);
    before += count;
    rows_before = rows;
    compliance_before = compliance;
  }
}

template <class Scalar>
Record DeviceBody<Scalar>::record() const {
  Record record;
  backend_.from_device(&record, view_.record, sizeof record);
  return record;
}

template <class Scalar>
NodalVectors DeviceBody<Scalar>::read(const double* vectors) const {
  NodalVectors values(4 * nodes());
  backend_.from_device(values.data(), vectors, values.size() * sizeof(double));
  return values;
}

template <class Scalar>
void DeviceBody<Scalar>::write(const NodalVectors& values, double* vectors) const {
  backend_.to_device(vectors, values.data(), values.size() * sizeof(double));
}

template <class Scalar>
std::vector<double> DeviceBody<Scalar>::masses() const {
  std::vector<double> values(nodes());
  backend_.from_device(values.data(), view_.mass, values.size() * sizeof(double));
  return values;
}

template class DeviceBody<float>;
template class DeviceBody<double>;

}  // namespace brainshift::solve::device
