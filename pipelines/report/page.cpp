// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>

#include "pipelines/report/page_template.hpp"
#include "pipelines/report/run_data.hpp"

namespace brainshift::pipelines {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> stages_in_order = {"segment", "discretise", "solve", "register"};

std::string value_text(const json& value) {
  if (value.is_number()) {
    return readable(value.get<double>());
  }
  if (value.is_boolean()) {
    return value.get<bool>() ? "yes" : "no";
  }
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

// The name and text of each value that is not an object itself; empty texts are left out.
json pairs(const json& values) {
  json list = json::array();
  for (const auto& [name, value] : values.items()) {
    if (!value.is_object() && !(value.is_string() && value.get_ref<const std::string&>().empty())) {
      list.push_back({{"name", name}, {"value", value_text(value)}});
    }
  }
  return list;
}

// The values of an object, then those of each object in it under its name.
void add_groups(json& groups, const std::string& name, const json& values) {
  if (json list = pairs(values); !list.empty()) {
    groups.push_back({{"name", name}, {"values", std::move(list)}});
  }
  for (const auto& [inner, value] : values.items()) {
    if (value.is_object()) {
      add_groups(groups, name.empty() ? inner : name + " " + inner, value);
    }
  }
}

json row_of_groups(const std::string& name, const json& values) {
  json groups = json::array();
  if (values.is_object()) {
    add_groups(groups, "", values);
  } else {
    add_groups(groups, "", {{"", values}});
  }
  return {{"name", name}, {"groups", std::move(groups)}};
}

json failures(const json& stages) {
  json list = json::array();
  for (const auto& [name, entry] : stages.items()) {
    if (entry.contains("failure")) {
      list.push_back({{"stage", name}, {"failure", entry.value("failure", "")}});
    }
  }
  return list;
}

// Stages whose results are of an earlier run.
json outdated_of(const json& stages) {
  json list = json::array();
  for (const auto& [name, entry] : stages.items()) {
    if (entry.value("status", "") == "outdated" && name != "report") {
      list.push_back({{"stage", name}});
    }
  }
  return list;
}

struct Notes {
  json warnings = json::array();  // without their mark
  json others = json::array();
};

// What the stages say to people, each sentence once.
Notes notes_of(const json& stages) {
  constexpr std::string_view mark = "warning:";
  Notes notes;
  std::set<std::string> told;
  for (const char* stage : stages_in_order) {
    const json entry = stages.value(stage, json::object());
    for (const json& note : entry.value("notes", json::array())) {
      std::string text = note.is_string() ? note.get<std::string>() : std::string();
      if (text.empty() || !told.insert(text).second) {
        continue;
      }
      const bool warns = text.starts_with(mark);
      text.erase(0, warns ? std::min(text.find_first_not_of(' ', mark.size()), text.size()) : 0);
      (warns ? notes.warnings : notes.others).push_back({{"stage", stage}, {"text", std::move(text)}});
    }
  }
  return notes;
}

json list_of(json sentences) {
  return sentences.empty() ? json(false) : json{{"sentences", std::move(sentences)}};
}

json tiles(const PageContent& content, const json& stages, const std::vector<MeasureRow>& measures) {
  double seconds = 0;
  double memory = 0;
  for (const auto& entry : stages) {
    seconds += entry.value("seconds", 0.0);
    memory = std::max(memory, entry.value("peak_memory_mb", 0.0));
  }
  const auto size = [&](const char* name) {
    const json::json_pointer place(std::string("/solve/sizes/") + name);
    return stages.contains(place) ? readable(stages.at(place).get<double>()) : std::string("not known");
  };
  const auto tile = [](const std::string& value, const char* name) { return json{{"value", value}, {"name", name}}; };
  const bool warped = content.no_image.empty();
  const auto bounded = std::ranges::count_if(measures, [](auto& row) { return row.verdict != Verdict::no_bound; });
  const auto within = std::ranges::count_if(measures, [](auto& row) { return row.verdict == Verdict::within; });
  const bool solved = !content.displacements.empty();
  return json::array(
      {tile(solved ? readable(content.largest_displacement) + " mm" : "not known", "largest displacement"),
       tile(std::to_string(within) + " of " + std::to_string(bounded), "checks within their bounds"),
       tile(size("nodes"), "nodes"), tile(size("integration_points"), "integration points"),
       tile(readable(seconds) + " s", warped ? "from image to warped image" : "all stages that ran"),
       tile(readable(memory * 1024 * 1024 / 1e9) + " GB", "peak memory")});
}

json figures_of(std::span<Figure> figures) {
  json list = json::array();
  for (Figure& figure : figures) {
    list.push_back({{"width", std::to_string(figure.width)}, {"svg", std::move(figure.svg)}});
  }
  return list;
}

json comparison(std::vector<Figure>& figures, bool has_opening) {
  if (figures.empty()) {
    return false;
  }
  json section = {{"opening", has_opening ? json{{"depth", readable(depth_of_planes)}} : json(false)},
                  {"closed", !has_opening},
                  {"rows", json::array()}};
  for (std::size_t i = 0; i + 2 < figures.size(); i += 3) {
    section["rows"].push_back({{"figures", figures_of(std::span(figures).subspan(i, 3))}});
  }
  return section;
}

json surfaces_of(PageContent& content) {
  json list = figures_of(content.surfaces);
  for (json& figure : list) {
    figure["rim"] = content.has_opening;
  }
  return list;
}

json displacement(PageContent& content) {
  if (content.displacements.empty()) {
    return false;
  }
  return {{"arrows", content.arrow_factor == 1 ? std::string("true to scale")
                                               : "drawn " + readable(content.arrow_factor) + " times too long"},
          {"opening", content.has_opening},
          {"figures", figures_of(content.displacements)},
          {"surfaces", surfaces_of(content)}};
}

// "1.2 mm over the whole brain, 0.8 mm in tumour".
std::string said_of(const json& uncertainty) {
  std::string text = readable(uncertainty.value("brain_mm", 0.0)) + " mm over the whole brain";
  const json tissues = uncertainty.value("tissues_mm", json::object());  // items() only refers to it
  for (const auto& [name, value] : tissues.items()) {
    text += ", " + readable(value.get<double>()) + " mm in " + name;
  }
  return text;
}

json uncertainty(PageContent& content, const json& stages) {
  const json::json_pointer place("/solve/measures/uncertainty");
  if (content.uncertainties.empty() || !stages.contains(place)) {
    return false;
  }
  const json& measures = stages.at(place);
  const bool sampled = measures.contains("samples");
  return {{"said", said_of(measures)},
          {"sampled", sampled ? json{{"samples", readable(measures.value("samples", 0.0))}} : json(false)},
          {"figures", figures_of(content.uncertainties)}};
}

json smooth_motion_of(const json& measures) {
  if (!measures.contains("smooth_motion")) {
    return false;
  }
  const json& smooth = measures["smooth_motion"];
  return {{"length", readable(smooth.value("length_mm", 0.0))},
          {"along", readable(smooth.value("along_mm", 0.0))},
          {"across", readable(smooth.value("across_mm", 0.0))},
          {"fades", smooth.value("fades", false) ? json::object() : json(false)}};
}

// How far the tracker's registration was off, where it was estimated.
json registration_of(const json& stages) {
  const json::json_pointer place("/solve/measures");
  const json measures = stages.contains(place) ? stages.at(place) : json::object();
  const auto number = [&](const char* name) {
    const auto value = measures.find(name);
    return value != measures.end() && value->is_number() ? value->get<double>()
                                                         : std::numeric_limits<double>::quiet_NaN();
  };
  const double angle = number("registration_angle_deg"), shift = number("registration_shift_mm");
  const double deviation = number("registration_deviation_mm");
  if (!std::isfinite(angle) || !std::isfinite(shift)) {
    return false;
  }
  return {{"angle", readable(angle)},
          {"shift", readable(shift)},
          {"known", std::isfinite(deviation) ? json{{"deviation", readable(deviation)}} : json(false)}};
}

// What is imposed exactly, as its noise is not given: what a tracker or a camera measured, or another program.
json exact_of(const json& options) {
  const bool seen = std::ranges::any_of(std::array{"load.craniotomy", "load.markups", "load.surfaces"},
                                        [&](const char* load) { return options.contains(load); });
  const bool computed = options.contains("load.field");
  return seen || computed ? json{{"seen", seen}, {"computed", computed}} : json(false);
}

// How a measured load was weighed: the weights that were tried, or that it has no noise to be weighed by.
json weight_of(PageContent& content, const json& stages, const json& options) {
  const json::json_pointer place("/solve/measures");
  const json measures = stages.contains(place) ? stages.at(place) : json::object();
  if (measures.contains("weights")) {
    return {{"exact", false},
            {"chosen",
             {{"weight", readable(measures.value("weight_mJ", 0.0))},
              {"factor", readable(measures.value("noise_factor", 1.0))},
              {"smooth", smooth_motion_of(measures)},
              {"figures", figures_of(content.weights)}}}};
  }
  json exact = measures.empty() || measures.contains("weight_mJ") ? json(false) : exact_of(options);
  return exact.is_object() ? json{{"exact", std::move(exact)}, {"chosen", false}} : json(false);
}

json labels_of(PageContent& content) {
  return content.labels.empty() ? json(false) : json{{"figures", figures_of(content.labels)}};
}

json measures_of(const std::vector<MeasureRow>& rows) {
  constexpr std::array<const char*, 3> words = {"within", "OUTSIDE", ""};
  json list = json::array();
  for (const MeasureRow& row : rows) {
    list.push_back({{"stage", row.stage},
                    {"meaning", row.meaning},
                    {"value", row.value},
                    {"bound", row.bound},
                    {"verdict", words[static_cast<std::size_t>(row.verdict)]}});
  }
  return list;
}

json convergence(const PageContent& content) {
  if (content.viewer.facts.value("history", "").empty()) {
    return false;
  }
  const bool in_time = dynamics_of(content.record) == solve::Dynamics::transient;
  return {{"in_time", in_time}, {"relaxed", !in_time}, {"as_file", content.libraries.empty()}};
}

// What viewer_run.js unpacks, and both scripts as one module, which keeps their names; in XML, too, the page is
// well-formed.
std::string scripts(const PageContent& content) {
  std::string text;
  const auto add = [&text](const PackedBytes& bytes) {
    text += "<script type=\"text/plain\" id=\"" + bytes.name + "\">" + bytes.text + "</script>\n";
  };
  std::ranges::for_each(content.viewer.arrays, add);
  std::ranges::for_each(content.libraries, add);
  constexpr auto replace = json::error_handler_t::replace;
  add({.name = "facts", .text = packed(content.viewer.facts.dump(-1, ' ', false, replace))});
  return text + "<script type=\"module\">//<![CDATA[\n" + viewer_script() + "//]]></script>\n";
}

json stages_of(const json& stages) {
  json list = json::array();
  for (const char* name : stages_in_order) {
    if (stages.contains(name)) {
      const json& entry = stages.at(name);
      const auto text = [&](const char* key) { return entry.contains(key) ? value_text(entry[key]) : std::string(); };
      list.push_back({{"stage", name},
                      {"status", entry.value("status", "")},
                      {"seconds", text("seconds")},
                      {"memory", text("peak_memory_mb")},
                      {"sizes", pairs(entry.value("sizes", json::object()))}});
    }
  }
  return list;
}

}  // namespace

std::string make_page(PageContent content) {
  const json& record = content.record;
  const std::vector<MeasureRow> measures = quality_measures(record);
  const json stages = record.value("stages", json::object());
  Notes notes = notes_of(stages);
  json options = json::array(), all_measures = json::array();
  const json elements = record.value("options", json::object());
  const bool turns = !content.libraries.empty() && !content.viewer.arrays.empty();
  for (const auto& [element, values] : elements.items()) {
    options.push_back(row_of_groups(element, values));
  }
  for (const auto& [stage, entry] : stages.items()) {
    all_measures.push_back(row_of_groups(stage, entry.value("measures", json::object())));
  }
  std::string page =
      fill_page(page_html(), {{"scene", std::filesystem::path(record.value("scene", "")).filename().string()},
                              {"version", record.value("version", "")},
                              {"threads", readable(record.value("threads", 1))},
                              {"simulated", elements.contains("load.simulated")},
                              {"failures", failures(stages)},
                              {"warnings", list_of(std::move(notes.warnings))},
                              {"no_image", content.no_image.empty() ? json(false) : json{{"why", content.no_image}}},
                              {"outdated", outdated_of(stages)},
                              {"tiles", tiles(content, stages, measures)},
                              {"viewer", turns},
                              {"no_viewer", content.libraries.empty()},
                              {"licences", !content.libraries.empty()},
                              {"comparison", comparison(content.comparisons, content.has_opening)},
                              {"displacement", displacement(content)},
                              {"septum", elements.contains("septa") || elements.contains("septum")},
                              {"uncertainty", uncertainty(content, stages)},
                              {"registration", registration_of(stages)},
                              {"weight", weight_of(content, stages, elements)},
                              {"labels", labels_of(content)},
                              {"measures", measures_of(measures)},
                              {"convergence", convergence(content)},
                              {"stages", stages_of(stages)},
                              {"notes", list_of(std::move(notes.others))},
                              {"options", std::move(options)},
                              {"all_measures", std::move(all_measures)}});
  if (!content.libraries.empty()) {
    page.insert(page.rfind("</body>"), scripts(content));
  }
  return page;
}

}  // namespace brainshift::pipelines
