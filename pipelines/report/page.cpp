// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/page.hpp"

#include <algorithm>
#include <filesystem>

#include "pipelines/report/run_data.hpp"

namespace brainshift::pipelines {

namespace {

using nlohmann::json;

std::string tile(const std::string& value, const std::string& name) {
  return "<div class=\"tile\"><b>" + value + "</b><span class=\"soft\">" + name + "</span></div>\n";
}

std::string key(const std::string& hue, const std::string& name) {
  return "<span class=\"key\" style=\"background:" + hue + "\"></span>" + name;
}

std::string header(const PageContent& content) {
  const json& record = content.record;
  const std::filesystem::path scene = record.value("scene", "");
  std::string html = "<header><h1>Brain shift</h1>\n<p class=\"soft\">scene " + escape(scene.filename().string()) +
                     ", brainshift " + escape(record.value("version", "")) + ", " +
                     readable(record.value("threads", 1)) + " threads</p></header>\n";
  if (record.value("options", json::object()).contains("load.simulated")) {
    html +=
        "<p class=\"notice\"><b>The load is simulated.</b> Nobody measured this brain: the opening and the "
        "displacement of the cortex in it were made up, to show the method. The result says nothing of a "
        "patient.</p>\n";
  }
  const json stages = record.value("stages", json::object());
  for (const auto& [name, entry] : stages.items()) {
    if (entry.contains("failure")) {
      html += "<p class=\"failure\"><b>The stage " + escape(name) + " did not finish.</b> " +
              escape(entry.value("failure", "")) + " What is shown below is its last good state.</p>\n";
    }
  }
  if (!content.has_image) {
    html += "<p class=\"notice\">This run had no image to warp: the slices show the brain's outline alone.</p>\n";
  }
  return html;
}

std::string tiles(const PageContent& content, const std::vector<MeasureRow>& measures) {
  const json stages = content.record.value("stages", json::object());
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
  const auto bounded = std::ranges::count_if(measures, [](auto& row) { return row.verdict != Verdict::no_bound; });
  const auto within = std::ranges::count_if(measures, [](auto& row) { return row.verdict == Verdict::within; });
  return "<div class=\"tiles\">\n" + tile(readable(content.largest_displacement) + " mm", "largest displacement") +
         tile(std::to_string(within) + " of " + std::to_string(bounded), "checks within their bounds") +
         tile(size("nodes"), "nodes") + tile(size("integration_points"), "integration points") +
         tile(readable(seconds) + " s", "from image to warped image") +
         tile(readable(memory / 1000) + " GB", "peak memory") + "</div>\n";
}

std::string comparison_section(const PageContent& content) {
  if (content.comparisons.empty()) {
    return {};
  }
  std::string html =
      "<h2>Before, after, difference</h2>\n<p>Axial, coronal and sagittal planes of the patient (not of the "
      "scanner's grid), 12 mm under the centre of the craniotomy. The patient's left is on the right. Lines:" +
      key("#5ac8fa", "brain's surface before") + key("#ff963c", "after") + key("#46eb6e", "craniotomy") +
      ". Outside the brain the field fades to nothing: between the bone and the sunken cortex the image is "
      "only stretched, not predicted.</p>\n";
  for (std::size_t i = 0; i + 2 < content.comparisons.size(); i += 3) {
    html += "<div class=\"row\">";
    for (std::size_t column = 0; column < 3; ++column) {
      html += image_element(content.comparisons[i + column]) + "\n";
    }
    html += "</div>\n";
  }
  PageFigure before = content.comparisons[content.blink];
  PageFigure after = content.comparisons[content.blink + 1];
  before.name += "_fade";
  after.name += "_fade";
  html +=
      "<p>Fade from before to after: <input type=\"range\" min=\"0\" max=\"100\" value=\"0\" aria-label=\"fade\" "
      "oninput=\"document.getElementById('" +
      after.name + "').style.opacity = this.value / 100\"/></p>\n<div class=\"blink\">" + image_element(before);
  std::string over = image_element(after);
  over.insert(over.find("flex-grow"), "opacity:0;");
  return html + over + "</div>\n";
}

std::string displacement_section(const PageContent& content) {
  if (content.displacements.empty()) {
    return {};
  }
  const std::string factor = content.arrow_factor == 1 ? std::string("true to scale")
                                                       : "drawn " + readable(content.arrow_factor) + " times too long";
  std::string html = "<h2>Displacement</h2>\n<p>Colours: length of the displacement. Arrows: its part in the plane, " +
                     factor + ", from where the tissue was. Lines:" + key("#5ac8fa", "brain's surface before") +
                     key("#46eb6e", "craniotomy") + ".</p>\n<div class=\"row\">";
  for (const auto& figure : content.displacements) {
    html += image_element(figure) + "\n";
  }
  html += "</div>\n";
  for (const auto& figure : content.surfaces) {
    html += "<figure>" + image_element(figure) +
            "<figcaption>The brain's surface as it lies during the operation, coloured by displacement; blue: the rim "
            "of the craniotomy. L, P, S: the patient's left, posterior, superior.</figcaption></figure>\n";
  }
  return html;
}

std::string convergence_section(const PageContent& content) {
  std::string html;
  for (const auto& plot : content.plots) {
    html += "<div>" + plot + "</div>\n";
  }
  if (html.empty()) {
    return html;
  }
  const bool in_time = dynamics_of(content.record) == solve::Dynamics::transient;
  const std::string words = in_time ? "<h2>Energies</h2>\n<p>The motion in time, with the tissue's own mass.</p>"
                                    : "<h2>How the solver converged</h2>\n<p>The load is applied smoothly, or all of "
                                      "it from a coarse cloud's solution on; then the motion is damped until the bound "
                                      "of the remaining error falls below the tolerance.</p>";
  return words + "\n<div class=\"plots\">\n" + html + "</div>\n";
}

}  // namespace

std::string make_page(const PageContent& content) {
  const std::vector<MeasureRow> measures = quality_measures(content.record);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\"/>\n<title>Brain shift</title>\n<style>" +
         style_sheet() + "</style></head>\n<body>\n" + header(content) + tiles(content, measures) +
         comparison_section(content) + displacement_section(content) + "<h2>Quality</h2>\n" + measures_html(measures) +
         convergence_section(content) + "<h2>Stages</h2>\n" + stages_html(content.record) + "<h2>Parameters</h2>\n" +
         options_html(content.record) + "<details><summary>Every measure of run.json</summary>\n" +
         all_measures_html(content.record) +
         "</details>\n<footer>Made by brainshift, for research. It is no medical device.</footer>\n</body></html>\n";
}

}  // namespace brainshift::pipelines
