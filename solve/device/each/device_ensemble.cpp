// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/device/each/device_ensemble.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>

#include "solve/device/device_body.hpp"
#include "solve/device/each/pieces.hpp"
#include "solve/device/rows.hpp"
#include "solve/force/firmness.hpp"

namespace brainshift::solve::device {

namespace {

constexpr Eigen::Index most_conditions_of_each = 1024;  // of a component: at most 256 MB of inverses each

bool is_of_the_library(const ElasticLaw& law) {
  return std::visit([](const auto& one) { return std::is_constructible_v<Law, decltype(one)>; }, law);
}

/// Of the library's.
Law law_of(const ElasticLaw& elastic) {
  std::optional<Law> result;
  std::visit(
      [&](const auto& law) {
        if constexpr (std::is_constructible_v<Law, decltype(law)>) {
          result.emplace(law);
        }
      },
      elastic);
  return result.value();
}

/// Where the i-th number of a member lies.
std::size_t index_of(std::size_t i, std::size_t member) {
  return i * most_members + member;
}

void set_vectors(const NodalVectors& values, std::size_t member, std::vector<double>& of_each) {
  for (std::size_t a = 0; a < values.size() / 4; ++a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      of_each[index_of(3 * a + axis, member)] = values[4 * a + axis];
    }
  }
}

}  // namespace

NodalVectors vectors_of_member(const std::vector<double>& of_each, std::size_t member) {
  NodalVectors values(of_each.size() / (3 * most_members) * 4, 0.0);
  for (std::size_t a = 0; a < values.size() / 4; ++a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values[4 * a + axis] = of_each[index_of(3 * a + axis, member)];
    }
  }
  return values;
}

std::string why_not_together(const Body& body, std::span<const Member> loads) {
  for (const Member& load : loads) {
    if (!std::all_of(load.laws.elastic.begin(), load.laws.elastic.end(), is_of_the_library)) {
      return "has a material with a law of its own";
    }
  }
  for (const EssentialConditions::Component& c : body.essential.components()) {
    if (c.prescribed.size() > most_conditions_of_each) {
      return "has more than " + std::to_string(most_conditions_of_each) +
             " nodes with a prescribed displacement, too many for many loads at once";
    }
  }
  return why_not(body);
}

template <class Scalar>
DeviceEnsemble<Scalar>::DeviceEnsemble(const Backend& backend, const Body& body, bool with_forces)
    : backend_(backend), body_(body), memory_(backend) {
  put_points();
  put_motion(with_forces);
  if (body.contact) {
    put_contact(*body.contact);
  }
  put_conditions();
}

template <class Scalar>
void DeviceEnsemble<Scalar>::put_points() {
  const PointBlocks& points = body_.points;
  const Pieces<Scalar> made = make_pieces<Scalar>(points, backend_.blocks);
  const std::size_t slots = made.of.slot_node.size(), patches = made.patches.size(), touches = made.of.touches.size();
  ViewOfEach<Scalar>& v = view_;
  v.nodes = static_cast<std::int32_t>(points.nodes());
  v.pieces = static_cast<std::int32_t>(made.pieces.size());
  v.patches = static_cast<std::int32_t>(patches);
  v.shares = static_cast<std::int32_t>(made.share_begin.size()) - 1;
  v.slots = static_cast<std::int32_t>(slots);
  v.piece = memory_.put(made.pieces);
  v.patch = memory_.put(made.patches);
  v.volume = memory_.put(points.volume);
  v.mode = points.mode.empty() ? nullptr : memory_.put(points.mode);
  v.pair_begin = memory_.put(made.of.pair_begin);
  v.pair = memory_.put(made.of.pairs);
  v.share_begin = memory_.put(made.share_begin);
  v.slot_begin = memory_.put(made.of.slot_begin);
  v.slot_pair = memory_.put(made.of.slot_pairs);
  v.slot_node = memory_.put(made.of.slot_node);
  v.node_begin = memory_.put(made.of.node_begin);
  v.node_slot = memory_.put(made.of.node_slot);
  v.touches = static_cast<std::int64_t>(touches);
  v.touch_begin = memory_.put(made.of.touch_begin);
  v.touch = memory_.put(made.of.touches);
  v.touch_reach = memory_.put(made.touch_reach);
  v.patch_touch_begin = memory_.put(made.of.patch_touch_begin);
  v.patch_touch = memory_.put(made.of.patch_touch);
  v.patch_touch_node = memory_.put(made.of.patch_touch_node);
  v.tensor = memory_.template room<Scalar>(9 * points.points() * most_members);
  v.seen = memory_.template room<double>(4 * made.pieces.size() * most_members);
  v.slot_force = memory_.template room<Scalar>(3 * slots * most_members);
  v.touch_norm = memory_.template room<double>(4 * touches * most_members);
  v.point_bound = memory_.template room<double>(3 * points.points() * most_members);
  v.patch_bound = memory_.template room<double>(3 * patches * most_members);
  v.patch_total = memory_.template room<double>(4 * patches * most_members);
  v.slot_bound = memory_.template room<double>(slots * most_members);
}

template <class Scalar>
void DeviceEnsemble<Scalar>::put_motion(bool with_forces) {
  ViewOfEach<Scalar>& v = view_;
  const std::size_t laws = body_.laws.elastic.size() * most_members, numbers = nodes() * most_members;
  v.law = memory_.template room<Law>(laws);
  v.is_plain = memory_.template room<std::int32_t>(body_.laws.elastic.size());
  v.shear_modulus = memory_.template room<double>(laws);
  v.bulk_modulus = memory_.template room<double>(laws);
  for (double** of_nodes : {&v.firmness, &v.mass, &v.inverse_mass, &v.stiffer_mass}) {
    *of_nodes = memory_.template room<double>(numbers);
  }
  for (double** vectors :
       {&v.displacement[0], &v.displacement[1], &v.displacement[2], &v.force_at[0], &v.force_at[1], &v.mode_of_body,
        &v.place_at_look, &v.force_at_look, &v.span_state[0], &v.span_state[1], &v.span_state[2]}) {
    *vectors = memory_.template room<double>(values());
  }
  v.fraction = memory_.template room<double>((most_steps + 1) * most_members);
  v.external = with_forces ? memory_.template room<double>(values()) : nullptr;
  v.partial =
      memory_.template room<double>(static_cast<std::size_t>(backend_.blocks) * LookOfEach::count * most_members);
  v.record = memory_.template room<RecordOfEach>(1);
}

template <class Scalar>
void DeviceEnsemble<Scalar>::put_contact(const Contact& contact) {
  ContactOfEach& c = view_.contact;
  put_nodes(contact, nodes(), memory_, c);
  const std::size_t count = contact.nodes().size();
  c.inverse_row_sum = memory_.template room<double>(count * most_members);
  c.touching = memory_.template room<Members>(count);
  c.push = memory_.template room<double>(3 * count * most_members);
  c.skull = contact.skull()->grid();
  c.skull.sample = memory_.put(contact.skull()->samples().value);
}

template <class Scalar>
void DeviceEnsemble<Scalar>::put_conditions() {
  for (const EssentialConditions::Component& c : body_.essential.components()) {
    conditions_ += static_cast<std::size_t>(c.prescribed.size());
  }
  const auto room = [&] { return memory_.template room<double>(conditions_ * most_members); };
  double* const of_all[] = {room(), room(), room(), room()};
  std::size_t before = 0;
  std::optional<CompressedRows> rows_before;
  std::vector<double> compliance_before;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const EssentialConditions::Component& from = body_.essential.components()[axis];
    ConditionsOfEach& c = view_.condition[axis];
    const CompressedRows rows = rows_of(from.shape);
    const auto count = static_cast<std::size_t>(from.prescribed.size());
    const std::vector<double> compliance = entries_of(from.compliance);
    put_rows(rows, memory_, c);
    c.compliance = compliance.empty() ? nullptr : memory_.put(compliance);
    c.prescribed = of_all[0] + before;
    c.residual = of_all[1] + before;
    c.multiplier[0] = of_all[2] + before;
    c.multiplier[1] = of_all[3] + before;
    c.own = !rows_before || !(rows == *rows_before) || compliance != compliance_before;
    c.inverse = c.own ? memory_.template room<double>(count * count * most_members) : view_.condition[axis - 1].inverse;
    c.column = c.own ? memory_.template room<double>(3 * count * most_members) : nullptr;
    before += count * most_members;
    rows_before = rows;
    compliance_before = compliance;
  }
}

template <class Scalar>
void DeviceEnsemble<Scalar>::load(std::span<const Member> loads) {
  const ViewOfEach<Scalar>& v = view_;
  load_laws(loads);
  load_conditions(loads);
  for (double* vectors : {v.displacement[0], v.displacement[1], v.displacement[2], v.force_at[0], v.force_at[1],
                          v.place_at_look, v.force_at_look, v.span_state[0], v.span_state[1], v.span_state[2]}) {
    backend_.clear(vectors, values() * sizeof(double));
  }
  backend_.clear(v.mass, nodes() * most_members * sizeof(double));
  for (double* multipliers : v.condition[0].multiplier) {
    backend_.clear(multipliers, conditions_ * most_members * sizeof(double));
  }
  if (v.external != nullptr) {
    std::vector<double> external(values(), 0.0);
    for (std::size_t m = 0; m < loads.size(); ++m) {
      if (!loads[m].external.empty()) {
        set_vectors(loads[m].external.full(), m, external);
      }
    }
    put(external, v.external);
  }
}

template <class Scalar>
void DeviceEnsemble<Scalar>::load_laws(std::span<const Member> loads) {
  const std::size_t rows = body_.laws.elastic.size();
  std::vector<Law> laws;
  std::vector<std::int32_t> is_plain(rows, 1);
  std::vector<double> shear(rows * most_members), bulk(rows * most_members);
  std::vector<double> firmness(nodes() * most_members, 1.0);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t m = 0; m < most_members; ++m) {  // those that are not there have the laws of the first
      const ElasticLaw& elastic = loads[m < loads.size() ? m : 0].laws.elastic[row];
      laws.push_back(law_of(elastic));
      is_plain[row] = is_plain[row] != 0 && std::holds_alternative<NeoHookean>(elastic) ? 1 : 0;
      std::visit(
          [&](const auto& law) {
            shear[index_of(row, m)] = law.shear_modulus;
            bulk[index_of(row, m)] = law.bulk_modulus;
          },
          elastic);
    }
  }
  for (std::size_t m = 0; m < loads.size(); ++m) {
    const std::vector<double> of_member = node_firmness(body_.points, shear_moduli(loads[m].laws));
    for (std::size_t a = 0; a < of_member.size(); ++a) {
      firmness[index_of(a, m)] = of_member[a];
    }
  }
  put(laws, view_.law);
  put(is_plain, view_.is_plain);
  put(shear, view_.shear_modulus);
  put(bulk, view_.bulk_modulus);
  put(firmness, view_.firmness);
}

/// As EachConditions has it.
template <class Scalar>
void DeviceEnsemble<Scalar>::load_conditions(std::span<const Member> loads) {
  std::vector<double> prescribed(conditions_ * most_members, 0.0);
  double* of_component = prescribed.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const EssentialConditions::Component& c = body_.essential.components()[axis];
    for (std::size_t m = 0; m < loads.size(); ++m) {
      Eigen::VectorXd of_member = c.prescribed;
      if (loads[m].prescribed.rows() > 0) {
        of_member.head(std::ssize(c.node)) =
            (c.extension * loads[m].prescribed.col(static_cast<Eigen::Index>(axis))).head(std::ssize(c.node));
      }
      for (Eigen::Index i = 0; i < of_member.size(); ++i) {
        of_component[index_of(static_cast<std::size_t>(i), m)] = of_member[i];
      }
    }
    of_component += c.prescribed.size() * most_members;
  }
  put(prescribed, view_.condition[0].prescribed);
}

template <class Scalar>
std::vector<double> DeviceEnsemble<Scalar>::starts(std::span<const Member> loads) const {
  std::vector<double> start(values(), 0.0);
  for (std::size_t m = 0; m < loads.size(); ++m) {
    set_vectors(loads[m].start, m, start);
  }
  return start;
}

template <class Scalar>
std::vector<double> DeviceEnsemble<Scalar>::read(const double* from, std::size_t count) const {
  std::vector<double> result(count);
  backend_.from_device(result.data(), from, count * sizeof(double));
  return result;
}

template <class Scalar>
void DeviceEnsemble<Scalar>::write(const std::vector<double>& values, double* to) const {
  put(values, to);
}

template class DeviceEnsemble<float>;
template class DeviceEnsemble<double>;

}  // namespace brainshift::solve::device
