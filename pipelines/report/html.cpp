// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/report/html.hpp"

#include <array>

#include "pipelines/report/canvas.hpp"

namespace brainshift::pipelines {

namespace {

using nlohmann::json;

std::string value_text(const json& value) {
  if (value.is_number_float()) {
    return readable(value.get<double>());
  }
  if (value.is_number()) {
    return readable(value.get<double>() + 0.0);
  }
  if (value.is_boolean()) {
    return value.get<bool>() ? "yes" : "no";
  }
  return value.is_string() ? escape(value.get<std::string>()) : escape(value.dump());
}

// "nodes 12,000, cells 24,000"
std::string pairs(const json& values) {
  std::string text;
  for (const auto& [name, value] : values.items()) {
    if (value.is_string() && value.get_ref<const std::string&>().empty()) {
      continue;
    }
    const bool nested = value.is_object();
    text += text.empty() ? "" : nested ? "<br/>" : ", ";
    text += "<span class=\"name\">" + escape(name) + "</span> ";
    text += nested ? pairs(value) : "<b>" + value_text(value) + "</b>";
  }
  return text;
}

std::string stage_row(const std::string& name, const json& entry) {
  const auto cell = [&](const char* key) {
    return "<td class=\"number\">" + (entry.contains(key) ? value_text(entry[key]) : "") + "</td>";
  };
  return "<tr><td>" + escape(name) + "</td><td>" + escape(entry.value("status", "")) + "</td>" + cell("seconds") +
         cell("peak_memory_mb") + "<td>" + pairs(entry.value("sizes", json::object())) + "</td></tr>\n";
}

}  // namespace

std::string escape(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string image_element(const PageFigure& figure) {
  return "<img id=\"" + escape(figure.name) + "\" style=\"flex-grow:" + std::to_string(figure.width) + "\" alt=\"" +
         escape(figure.alt) + "\" src=\"data:image/png;base64," + encode_base64(figure.png) + "\"/>";
}

std::string measures_html(std::span<const MeasureRow> rows) {
  constexpr std::array<const char*, 3> cells = {"<td class=\"good\">within</td>", "<td class=\"bad\">OUTSIDE</td>",
                                                "<td></td>"};
  std::string html =
      "<table><thead><tr><th>stage</th><th>what it means</th><th>value</th><th>bound</th><th></th></tr></thead>"
      "<tbody>\n";
  for (const auto& row : rows) {
    html += "<tr><td>" + escape(row.stage) + "</td><td>" + escape(row.meaning) + "</td><td class=\"number\">" +
            escape(row.value) + "</td><td>" + escape(row.bound) + "</td>" +
            cells[static_cast<std::size_t>(row.verdict)] + "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string stages_html(const json& record) {
  std::string html =
      "<table><thead><tr><th>stage</th><th>state</th><th>seconds</th><th>peak memory, MB</th><th>sizes</th></tr>"
      "</thead><tbody>\n";
  const json stages = record.value("stages", json::object());
  for (const char* name : {"segment", "discretise", "solve", "register"}) {
    if (stages.contains(name)) {
      html += stage_row(name, stages[name]);
    }
  }
  return html + "</tbody></table>\n";
}

std::string options_html(const json& record) {
  std::string html = "<table><tbody>\n";
  const json elements = record.value("options", json::object());
  for (const auto& [element, options] : elements.items()) {
    html += "<tr><td>" + escape(element) + "</td><td>" + (options.is_object() ? pairs(options) : value_text(options)) +
            "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string all_measures_html(const json& record) {
  std::string html = "<table><tbody>\n";
  const json stages = record.value("stages", json::object());
  for (const auto& [stage, entry] : stages.items()) {
    html += "<tr><td>" + escape(stage) + "</td><td>" + pairs(entry.value("measures", json::object())) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string style_sheet() {
  return R"(
:root { --ink: #20242a; --soft: #5c646e; --line: #dde2e8; --accent: #1f5fa8; }
body { margin: 0 auto; max-width: 1280px; padding: 28px 24px 60px; font: 16px/1.5 system-ui, "Segoe UI", Roboto,
  "Helvetica Neue", Arial, sans-serif; color: var(--ink); background: #fff; }
h1 { font-size: 30px; margin: 0; letter-spacing: -0.01em; }
h2 { font-size: 21px; margin: 44px 0 6px; padding-top: 14px; border-top: 1px solid var(--line); }
p { margin: 6px 0 12px; max-width: 62em; }
.soft, figcaption, .name { color: var(--soft); }
.notice { background: #fff6dd; border-left: 5px solid #e0a800; padding: 10px 16px; margin: 18px 0; }
.failure { background: #fde8e6; border-left: 5px solid #b3261e; padding: 10px 16px; margin: 18px 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(165px, 1fr)); gap: 12px; margin: 22px 0; }
.tile { border: 1px solid var(--line); border-radius: 8px; padding: 12px 16px; }
.tile b { display: block; font-size: 25px; font-weight: 600; white-space: nowrap; }
.row { display: flex; gap: 8px; align-items: stretch; background: #000; padding: 8px; border-radius: 6px;
  margin: 10px 0; }
.row img { flex-basis: 0; min-width: 0; width: 0; height: auto; align-self: center; }
figure { margin: 12px 0; }
figure img { max-width: 100%; height: auto; }
table { border-collapse: collapse; width: 100%; font-size: 15px; margin: 10px 0; }
th, td { text-align: left; padding: 6px 12px 6px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { font-weight: 600; color: var(--soft); }
.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
.good { color: #1a7f37; font-weight: 600; }
.bad { color: #b3261e; font-weight: 700; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 18px; }
.key { display: inline-block; width: 22px; height: 4px; margin: 0 6px 3px 14px; vertical-align: middle; }
.blink { position: relative; background: #000; border-radius: 6px; display: inline-block; }
.blink { width: min(100%, 760px); }
.blink img { display: block; width: 100%; }
.blink img + img { position: absolute; left: 0; top: 0; }
input[type=range] { width: 320px; vertical-align: middle; }
summary { cursor: pointer; color: var(--accent); }
footer { margin-top: 48px; font-size: 14px; color: var(--soft); }
)";
}

}  // namespace brainshift::pipelines
