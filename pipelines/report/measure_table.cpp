// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/measure_table.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <type_traits>

namespace brainshift::pipelines {

namespace {

using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();

// What is measured, where run.json has it, and between which bounds it should lie (inclusive unless strict).
struct Rule {
  const char* pointer;  ///< under /stages
  const char* unit;
  double low;
  double high;
  bool strict;
  const char* bound;
  const char* meaning;
};

constexpr const char* constraint_error = "/solve/measures/constraint_error_mm";

constexpr Rule rules[] = {
    {"/segment/measures/brain/boundary_distance_95_mm", "mm", -infinity, 1, false, "at most 1 mm",
     "distance of the brain's surface from the edge of its label, 95 % of the surface"},
    {"/solve/measures/error_bound_mm", "mm", -infinity, infinity, false, "",
     "bound of what further steps could still move a node"},
    {"/solve/measures/estimated_error_95_mm", "mm", -infinity, infinity, false, "",
     "estimated error of the displacement from the spacing of the nodes, 95 % of the brain"},
    {constraint_error, "mm", -infinity, 0.05, false, "at most 0.05 mm",
     "largest miss of the measured displacement at a node of the opening"},
    {"/solve/measures/largest_penetration_mm", "mm", -infinity, 0.5, false, "at most 0.5 mm",
     "how far the worst node lies outside the skull"},
    {"/solve/measures/smallest_jacobian", "", 0, infinity, true, "above 0",
     "smallest local volume ratio in the solver; below 0 tissue is turned inside out"},
    {"/solve/measures/largest_displacement_mm", "mm", -infinity, infinity, false, "", "largest displacement of a node"},
    {"/solve/measures/largest_stretch", "", -infinity, infinity, false, "", "largest stretch of the tissue"},
    {"/solve/measures/compressed_share", "", -infinity, 0.01, false, "at most 0.01",
     "share of the tissue pressed so far, below 56 % of a length, that free faces of it would fold"},
    {"/register/measures/jacobian_min", "", 0, infinity, true, "above 0",
     "smallest local volume ratio of the field in the brain; below 0 the image is folded"},
    {"/register/measures/inverse_mean_mm", "mm", -infinity, 0.05, false, "at most 0.05 mm",
     "to the operation and back: mean distance from where one began"},
    {"/register/measures/inverse_999_mm", "mm", -infinity, 0.5, false, "at most 0.5 mm",
     "the same, for 99.9 % of the brain"},
    {"/register/measures/fit_error_mm", "mm", -infinity, infinity, false, "",
     "largest difference between the field and the solution at a node"},
};

// A number or a flag; absent where there is none.
template <class Value>
std::optional<Value> found_at(const json& record, const std::string& pointer) {
  const json::json_pointer place("/stages" + pointer);
  if (!record.contains(place)) {
    return std::nullopt;
  }
  const json& value = record.at(place);
  const bool fits = std::is_same_v<Value, bool> ? value.is_boolean() : value.is_number();
  return fits ? std::optional(value.get<Value>()) : std::nullopt;
}

std::string stage_of(const std::string& pointer) {
  return pointer.substr(1, pointer.find('/', 1) - 1);
}

std::string with_unit(std::string number, const std::string& unit) {
  if (!unit.empty()) {
    number.append(" ").append(unit);
  }
  return number;
}

Verdict judge(bool good) {
  return good ? Verdict::within : Verdict::outside;
}

// Without a measured displacement there is none to miss.
bool concerns(const Rule& rule, const json& record) {
  return std::string_view(rule.pointer) != constraint_error ||
         found_at<double>(record, "/solve/sizes/loaded_nodes").value_or(1) > 0;
}

void add_rule(std::vector<MeasureRow>& rows, const json& record, const Rule& rule) {
  const auto value = found_at<double>(record, rule.pointer);
  if (!value || !concerns(rule, record)) {
    return;
  }
  const std::string bound = rule.bound;
  const bool good = rule.strict ? *value > rule.low && *value < rule.high : *value >= rule.low && *value <= rule.high;
  rows.push_back({stage_of(rule.pointer), rule.meaning, with_unit(readable(*value), rule.unit), bound,
                  bound.empty() ? Verdict::no_bound : judge(good)});
}

void add_volume(std::vector<MeasureRow>& rows, const json& record, const std::string& made, const std::string& wanted,
                double percent, const std::string& meaning) {
  const auto a = found_at<double>(record, made);
  const auto b = found_at<double>(record, wanted);
  if (!a || !b || *b == 0) {
    return;
  }
  const double difference = 100 * (*a - *b) / *b;
  rows.push_back({stage_of(made), meaning, with_unit(readable(difference), "%"),
                  with_unit(readable(percent), "% either way"), judge(std::abs(difference) <= percent)});
}

void add_flag(std::vector<MeasureRow>& rows, const json& record, const std::string& pointer, bool wanted,
              const std::string& meaning) {
  if (const auto flag = found_at<bool>(record, pointer)) {
    rows.push_back({stage_of(pointer), meaning, std::string(*flag ? "yes" : "no"), std::string(wanted ? "yes" : "no"),
                    judge(*flag == wanted)});
  }
}

}  // namespace

std::vector<MeasureRow> quality_measures(const json& record) {
  std::vector<MeasureRow> rows;
  add_flag(rows, record, "/segment/measures/brain/closed", true, "the brain's surface is closed");
  add_flag(rows, record, "/segment/measures/brain/self_intersecting", false, "the brain's surface cuts itself");
  add_volume(rows, record, "/segment/measures/brain/volume_mm3", "/segment/measures/brain/label_volume_mm3", 1,
             "volume of the surface against that of the brain's voxels");
  add_volume(rows, record, "/discretise/measures/cells_inside_volume_mm3", "/discretise/measures/surface_volume_mm3",
             0.5, "volume that is integrated against that of the surface");
  add_flag(rows, record, "/solve/measures/converged", true, "the solver reached its tolerance or, in time, its end");
  for (const Rule& rule : rules) {
    add_rule(rows, record, rule);
  }
  return rows;
}

std::string readable(double value) {
  if (!std::isfinite(value)) {
    return "not known";
  }
  char text[400];
  const bool whole = value == std::round(value);
  if (!whole && std::abs(value) < 999.5) {
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  std::snprintf(text, sizeof text, "%.0f", value);
  std::string digits = text;
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t place = digits.size(); place > first + 3;) {
    place -= 3;
    digits.insert(place, 1, ',');
  }
  return digits;
}

}  // namespace brainshift::pipelines
